//! Location errors under their names, for a person or a program.

use super::located::Located;
use crate::export::digits::{comments, decimal};

/// Digits of µm and µrad behind the point.
const DIGITS: usize = 6;

/// A row each: the name of ISO 230-1, the unit, the value, its standard uncertainty and its expanded one of 95 %.
pub fn named(located: &Located, notes: &[String]) -> String {
    let mut text = comments("#", notes) + "error,unit,value,std,u95\n";
    for (name, own) in located.each() {
        let unit = own.quantity.deviation();
        let values = [own.value, own.std, own.u95].map(|x| decimal(unit.from_inner(x), DIGITS));
        text += &format!("{name},{unit},{}\n", values.join(","));
    }
    text
}
