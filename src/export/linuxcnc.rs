//! LinuxCNC: `COMP_FILE` of type 0, `nominal forward reverse` a line.
//!
//! trim = nominal − value, and the joint is sent to commanded + trim. With value = nominal + error it arrives where it was
//! commanded: commanded − error + error. The reader ends at what is no number, so there is no comment.

use super::table::Table;
use super::written::Written;
use std::fmt::Write;

/// Digits behind the point: a ten-millionth of an arc second.
const DIGITS: usize = 10;

/// The file; `None` of a function that is not the axis' own position.
pub(super) fn write(table: &Table) -> Option<Written> {
    let unit = table.subject.quantity.coordinate();
    let sense = table.subject.own?;
    let mut text = String::new();
    let mut kept: [Vec<f64>; 2] = Default::default();
    for (at, more, less) in table.rows(&table.own()?) {
        let nominal = format!("{at:.DIGITS$}");
        let values = [more, less].map(|error| format!("{:.DIGITS$}", at + error));
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        for (kept, value) in kept.iter_mut().zip(&values) {
            let trim = (number(&nominal) - number(value)) as f32;
            kept.push(sense * unit.to_inner(-f64::from(trim)));
        }
        let _ = writeln!(text, "{nominal} {} {}", values[0], values[1]);
    }
    Some(Written { text, kept })
}
