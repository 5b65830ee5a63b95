//! Heidenhain: a compensation-value table (`.COM`), positions with the error there, and in the negative direction.
//!
//! An axis' own position has the column of its name; the other errors those of KinematicsComp, C1 to C6 for X Y Z A B C.

use super::digits::{decimal, read_back};
use super::table::Table;
use super::written::Written;

/// Digits behind the point.
const DIGITS: usize = 6;

/// The file. Its form has no comments: the first lines are `BEGIN` and the columns.
pub(super) fn write(table: &Table) -> Written {
    let axis = &table.subject.axis;
    let (column, sense) = match table.own() {
        Some(sense) => (axis.clone(), sense),
        None => (format!("C{}", table.subject.component.index() + 1), 1.0),
    };
    let values = table.scaled(sense);
    let backlash = if table.both { " BACKLASH" } else { "" };
    let mut text = format!("BEGIN {axis}.COM MM\nNR AXISPOS{backlash} {column}\n");
    for (row, (at, forward, reverse)) in table.rows(&values).enumerate() {
        text += &format!("{row} {}", decimal(at, DIGITS));
        if table.both {
            text += &format!(" {}", decimal(reverse, DIGITS));
        }
        text += &format!(" {}\n", decimal(forward, DIGITS));
    }
    text += "[END]\n";
    Written { text, kept: table.kept(&read_back(&values, DIGITS), sense) }
}
