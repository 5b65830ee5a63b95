//! The header: which column is what, in which unit.

use super::error::HeaderProblem;
use super::unit::{Role, Unit};

/// A column the caller asks for.
#[derive(Clone, Copy)]
pub(crate) struct Wanted<'a> {
    pub name: &'a str,
    pub role: Role,
}

/// A column found.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// As it stands in the header.
    pub name: String,
    pub unit: Unit,
    /// Its place in a line.
    pub at: usize,
}

/// The columns as a message lists them: `a_deg or a_rad`.
pub(crate) fn listed(wanted: &[Wanted]) -> Vec<String> {
    let names = |w: &Wanted| w.role.units().iter().map(|unit| format!("{}_{unit}", w.name)).collect::<Vec<_>>();
    wanted.iter().map(|w| names(w).join(" or ")).collect()
}

/// How a header field relates to a wanted column.
enum Match {
    Unit(Unit),
    NoUnit,
    WrongUnit,
}

fn compare(field: &str, wanted: Wanted) -> Option<Match> {
    match field.strip_prefix(wanted.name)? {
        "" => Some(Match::NoUnit),
        rest => {
            let suffix = rest.strip_prefix('_')?;
            let unit = wanted.role.units().iter().find(|unit| unit.suffix() == suffix);
            Some(unit.map_or(Match::WrongUnit, |unit| Match::Unit(*unit)))
        }
    }
}

/// The wanted columns in the header, in the order wanted; or everything wrong with the header.
pub(crate) fn resolve(header: &[String], wanted: &[Wanted]) -> Result<Vec<Column>, Vec<HeaderProblem>> {
    if header.iter().all(|field| field.parse::<f64>().is_ok()) {
        return Err(vec![HeaderProblem::Absent { columns: listed(wanted) }]);
    }
    let mut problems = Vec::new();
    let mut found: Vec<Option<Column>> = vec![None; wanted.len()];
    let mut misnamed = vec![false; wanted.len()];
    for (at, field) in header.iter().enumerate() {
        // `a` is also the beginning of `a_x_um`: the column whose unit fits comes first.
        let candidates = || wanted.iter().enumerate().filter_map(|(i, w)| compare(field, *w).map(|m| (i, w, m)));
        let best = candidates().find(|(.., m)| matches!(m, Match::Unit(_))).or_else(|| candidates().next());
        let Some((i, Wanted { name, role }, matched)) = best else {
            problems.push(HeaderProblem::Unknown { name: field.clone(), columns: listed(wanted) });
            continue;
        };
        let (Some(slot), Some(misnamed)) = (found.get_mut(i), misnamed.get_mut(i)) else {
            continue;
        };
        match (matched, &slot) {
            (Match::Unit(_), Some(first)) => {
                problems.push(HeaderProblem::Twice { first: first.name.clone(), second: field.clone() });
            }
            (Match::Unit(unit), None) => *slot = Some(Column { name: field.clone(), unit, at }),
            (Match::NoUnit, _) => {
                *misnamed = true;
                problems.push(HeaderProblem::NoUnit { name: field.clone(), units: role.units() });
            }
            (Match::WrongUnit, _) => {
                *misnamed = true;
                let (name, units) = ((*name).to_owned(), role.units());
                problems.push(HeaderProblem::WrongUnit { column: field.clone(), name, units });
            }
        }
    }
    for ((w, slot), misnamed) in wanted.iter().zip(&found).zip(misnamed) {
        if slot.is_none() && !misnamed {
            let (name, units) = (w.name.to_owned(), w.role.units());
            problems.push(HeaderProblem::Missing { name, units, found: header.to_vec() });
        }
    }
    if problems.is_empty() { Ok(found.into_iter().flatten().collect()) } else { Err(problems) }
}
