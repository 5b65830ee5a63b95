//! Errors under their ISO 230-1 names, for ISG's and Beckhoff's volumetric compensation and in Etalon's exchange format: values in mm
//! or rad, coordinates in mm or degrees.

use super::digits::{comments, decimal, read_back};
use super::table::Table;
use super::written::Kept;

/// Digits behind the point: of a value, of a coordinate.
const DIGITS: [usize; 2] = [12, 6];

/// A location error that is identified: its name without the E (`Y0A`), mm or rad.
pub type Constant = (String, f64);

/// What of a table's mean of both directions is kept.
pub(super) fn kept(table: &Table) -> Kept {
    read_back(&table.mean().errors, DIGITS[0])
}

fn mean(table: &Table) -> Vec<f64> {
    let [mean, _] = table.mean().errors;
    mean
}

/// ISG's CSV: a header of names and rows of numbers for each axis, `#` between them.
pub(super) fn volcomp(tables: &[Table], constants: &[Constant], notes: &[String]) -> String {
    let mut parts: Vec<String> = Vec::new();
    if !constants.is_empty() {
        let names: Vec<&str> = constants.iter().map(|(name, _)| name.as_str()).collect();
        let values: Vec<String> = constants.iter().map(|(_, value)| decimal(*value, DIGITS[0])).collect();
        parts.push(format!("{}\n{}\n", names.join(" "), values.join(" ")));
    }
    let mut left: Vec<&Table> = tables.iter().collect();
    while let Some(first) = left.first().copied() {
        let same = |table: &&Table| table.subject.axis == first.subject.axis && table.grid == first.grid;
        let (own, others): (Vec<&Table>, Vec<&Table>) = left.into_iter().partition(same);
        left = others;
        let names: Vec<&str> = own.iter().map(|table| table.subject.iso.as_str()).collect();
        // The argument is the axis of the errors' names: EAA is one of A.
        let argument = first.subject.iso.get(2..).unwrap_or_default();
        let mut part = format!("{argument} {}\n", names.join(" "));
        let columns: Vec<Vec<f64>> = own.iter().map(|table| mean(table)).collect();
        for (row, at) in first.grid.points().enumerate() {
            let values = columns.iter().map(|column| format!(" {}", decimal(column[row], DIGITS[0])));
            part += &format!("{}{}\n", decimal(at, DIGITS[1]), values.collect::<String>());
        }
        parts.push(part);
    }
    comments("//", notes) + &parts.join("#\n")
}

/// Etalon's: a block for each error.
pub(super) fn etalon(tables: &[Table], constants: &[Constant], notes: &[String]) -> String {
    let mut text = comments("//", notes);
    for (name, value) in constants {
        text += &format!("[{name}]\nVALUE = {}\n", decimal(*value, DIGITS[0]));
    }
    for table in tables {
        text += &format!("[{}]\nGridpoints = {{\n", table.subject.iso);
        for (at, value) in table.grid.points().zip(mean(table)) {
            text += &format!("{} {}\n", decimal(at, DIGITS[1]), decimal(value, DIGITS[0]));
        }
        text += "}\n";
    }
    text
}
