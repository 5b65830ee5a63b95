//! Values for programs: CSV and JSON, errors in µm or µrad over mm or degrees.

use super::digits::{comments, decimal, number};
use super::table::Table;
use super::written::Written;
use serde_json::json;

/// Digits behind the point.
const DIGITS: usize = 6;

fn taken(table: &Table) -> [Vec<f64>; 2] {
    let unit = table.subject.quantity.deviation();
    table.errors.each_ref().map(|own| own.iter().map(|e| number(&decimal(unit.from_inner(*e), DIGITS))).collect())
}

fn written(table: &Table, taken: &[Vec<f64>; 2], text: String) -> Written {
    let unit = table.subject.quantity.deviation();
    Written { text, kept: taken.each_ref().map(|own| own.iter().map(|value| unit.to_inner(*value)).collect()) }
}

/// A header with units, then a row each; one column where the directions are the same.
pub(super) fn csv(table: &Table, notes: &[String]) -> Written {
    let (subject, taken) = (&table.subject, taken(table));
    let (iso, unit, along) = (&subject.iso, subject.quantity.deviation(), subject.along);
    let mut text = comments("#", notes);
    text += &match table.both {
        true => format!("{}_{along},{iso}_forward_{unit},{iso}_reverse_{unit}\n", subject.axis),
        false => format!("{}_{along},{iso}_{unit}\n", subject.axis),
    };
    for (at, forward, reverse) in table.rows(&taken) {
        text += &decimal(at, DIGITS);
        let values = [forward, reverse];
        for value in &values[..1 + usize::from(table.both)] {
            text += &format!(",{}", decimal(*value, DIGITS));
        }
        text.push('\n');
    }
    written(table, &taken, text)
}

/// One object.
pub(super) fn json(table: &Table, notes: &[String]) -> Written {
    let (subject, taken) = (&table.subject, taken(table));
    let rows =
        table.rows(&taken).map(|(at, forward, reverse)| json!({ "at": at, "forward": forward, "reverse": reverse }));
    let object = json!({
        "notes": notes,
        "function": subject.name,
        "iso": subject.iso,
        "axis": subject.axis,
        "coordinate_unit": subject.along.suffix(),
        "unit": subject.quantity.deviation().suffix(),
        "both_directions": table.both,
        "rows": rows.collect::<Vec<_>>(),
    });
    written(table, &taken, format!("{object:#}\n"))
}
