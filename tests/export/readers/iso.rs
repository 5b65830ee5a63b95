//! Errors under their ISO 230-1 names.

use super::{Read, Rows, Trim, Unread, number, numbers, without_comments};
use std::collections::BTreeMap;

/// Errors by their ISO names: over degrees or mm, in rad or mm.
pub type Errors = BTreeMap<String, Vec<(f64, f64)>>;

/// Headers and rows; `#` begins another header, a block without an argument is of constants.
pub fn volcomp(text: &str) -> Read<Errors> {
    let mut errors = Errors::new();
    let lines: Vec<&str> = without_comments(text, "//").collect();
    for block in lines.split(|line| *line == "#") {
        let [header, rows @ ..] = block else { return Err(Unread::Lacks("header")) };
        let names: Vec<&str> = header.split_whitespace().collect();
        let has_argument = names.first().is_some_and(|name| name.len() == 1);
        for row in rows {
            let numbers = numbers(row)?;
            if numbers.len() != names.len() {
                return Err(Unread::Rows);
            }
            let at = if has_argument { numbers[0] } else { 0.0 };
            for (name, value) in names.iter().zip(&numbers).skip(usize::from(has_argument)) {
                errors.entry((*name).to_owned()).or_default().push((at, *value));
            }
        }
    }
    Ok(errors)
}

/// Blocks with a value or grid points.
pub fn etalon(text: &str) -> Read<Errors> {
    let mut errors = Errors::new();
    let mut name = String::new();
    for line in without_comments(text, "//") {
        if let Some(own) = line.strip_prefix('[') {
            own.trim_end_matches(']').clone_into(&mut name);
        } else if let Some(value) = line.strip_prefix("VALUE = ") {
            errors.insert(name.clone(), vec![(0.0, number(value)?)]);
        } else if line == "Gridpoints = {" {
            errors.insert(name.clone(), Vec::new());
        } else if line != "}" {
            let (at, value) = line.split_once(' ').ok_or(Unread::Rows)?;
            errors.get_mut(&name).ok_or(Unread::Lacks("Gridpoints"))?.push((number(at)?, number(value)?));
        }
    }
    Ok(errors)
}

/// The error of an axis under its ISO name that a control takes off: as it is given, mm or rad, or of an angle in degrees.
pub fn iso_error(errors: &Errors, name: &str, in_degrees: bool) -> Read<Trim> {
    let unit = if in_degrees { 1f64.to_degrees() } else { 1.0 };
    let rows = Rows::new(errors.get(name).ok_or(Unread::Lacks("the error"))?.clone())?;
    Ok(Box::new(move |x, _| -unit * rows.at(x)))
}
