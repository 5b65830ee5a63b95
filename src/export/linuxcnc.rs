//! LinuxCNC: `COMP_FILE` of type 0, `nominal forward reverse` a line.
//!
//! trim = nominal − value, and the joint is sent to commanded + trim. With value = nominal + error it arrives where it was
//! commanded: commanded − error + error. The reader ends at what is no number, so there is no comment.

use super::digits::{decimal, number};
use super::table::Table;
use super::written::Written;

/// Digits behind the point: less than a thousandth of an arc second's thousandth.
const DIGITS: usize = 10;

/// The file; `None` of a function that is not the axis' own position.
pub(super) fn write(table: &Table) -> Option<Written> {
    let sense = table.own()?;
    let mut text = String::new();
    let mut taken: [Vec<f64>; 2] = Default::default();
    for (at, forward, reverse) in table.rows(&table.scaled(sense)) {
        let nominal = decimal(at, DIGITS);
        let values = [forward, reverse].map(|error| decimal(at + error, DIGITS));
        for (taken, value) in taken.iter_mut().zip(&values) {
            let trim = (number(&nominal) - number(value)) as f32;
            taken.push(-f64::from(trim));
        }
        text += &format!("{nominal} {} {}\n", values[0], values[1]);
    }
    Some(Written { text, kept: table.kept(&taken, sense) })
}
