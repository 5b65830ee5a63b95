//! The header: which column is what, in which unit.

use super::error::HeaderProblem;
use trunnion_codegen::quantity::{Quantity, Unit};

/// Units of a swept angle, the usual one first.
pub(crate) const SWEEP: &[Unit] = &[Unit::Deg, Unit::Rad];

/// Units of an error motion or a reading, the usual one first.
pub(crate) const fn deviation(quantity: Quantity) -> &'static [Unit] {
    match quantity {
        Quantity::Length => &[Unit::Um, Unit::Mm],
        Quantity::Angle => &[Unit::Urad, Unit::Rad],
    }
}

/// A column the caller asks for.
#[derive(Clone, Copy)]
pub(crate) struct Wanted<'a> {
    /// Its name without a unit.
    pub name: &'a str,
    /// Units it may be in; none for a plain number, whose name stands alone.
    pub units: &'static [Unit],
    /// What its values are where the file does not have it; none if it has to be there.
    pub absent: Option<f64>,
    /// Whether a column of any other name is meant as well, if its unit fits.
    pub any: bool,
}

impl<'a> Wanted<'a> {
    /// A column that has to be there.
    pub const fn new(name: &'a str, units: &'static [Unit]) -> Self {
        Self { name, units, absent: None, any: false }
    }

    /// A column that has to be there, whatever stands before its unit; `name` for example.
    pub const fn any(name: &'a str, units: &'static [Unit]) -> Self {
        Self { name, units, absent: None, any: true }
    }

    /// As a message lists it: `a_deg or a_rad`.
    fn listed(&self) -> String {
        let names: Vec<String> = self.units.iter().map(|unit| format!("{}_{unit}", self.name)).collect();
        let names = if names.is_empty() { self.name.to_owned() } else { names.join(" or ") };
        if self.absent.is_some() { format!("perhaps {names}") } else { names }
    }
}

/// The columns as a message lists them.
pub(crate) fn listed(wanted: &[Wanted]) -> Vec<String> {
    wanted.iter().map(Wanted::listed).collect()
}

/// Where the values of a wanted column come from.
#[derive(Clone, Debug)]
pub(crate) enum Column {
    /// From the file.
    Present {
        /// As it stands in the header.
        name: String,
        unit: Option<Unit>,
        /// Its place in a line.
        at: usize,
    },
    /// The same for every line.
    Absent(f64),
}

impl Column {
    /// Its name in the header.
    pub fn name(&self) -> &str {
        match self {
            Self::Present { name, .. } => name,
            Self::Absent(_) => "",
        }
    }
}

/// How a header field relates to a wanted column.
enum Match {
    Fits(Option<Unit>),
    NoUnit,
    WrongUnit,
}

fn compare(field: &str, wanted: &Wanted) -> Option<Match> {
    if wanted.any {
        let (_, suffix) = field.rsplit_once('_')?;
        let unit = wanted.units.iter().find(|unit| unit.suffix() == suffix)?;
        return Some(Match::Fits(Some(*unit)));
    }
    match (field.strip_prefix(wanted.name)?, wanted.units) {
        ("", []) => Some(Match::Fits(None)),
        ("", _) => Some(Match::NoUnit),
        (_, []) => None,
        (rest, units) => {
            let suffix = rest.strip_prefix('_')?;
            let unit = units.iter().find(|unit| unit.suffix() == suffix);
            Some(unit.map_or(Match::WrongUnit, |unit| Match::Fits(Some(*unit))))
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
        let candidates = || wanted.iter().enumerate().filter_map(|(i, w)| compare(field, w).map(|m| (i, w, m)));
        let best = candidates().find(|(.., m)| matches!(m, Match::Fits(_))).or_else(|| candidates().next());
        let Some((i, Wanted { name, units, .. }, matched)) = best else {
            problems.push(HeaderProblem::Unknown { name: field.clone(), columns: listed(wanted) });
            continue;
        };
        let (Some(slot), Some(misnamed)) = (found.get_mut(i), misnamed.get_mut(i)) else {
            continue;
        };
        match (matched, &slot) {
            (Match::Fits(_), Some(first)) => {
                problems.push(HeaderProblem::Twice { first: first.name().to_owned(), second: field.clone() });
            }
            (Match::Fits(unit), None) => *slot = Some(Column::Present { name: field.clone(), unit, at }),
            (Match::NoUnit, _) => {
                *misnamed = true;
                problems.push(HeaderProblem::NoUnit { name: field.clone(), units });
            }
            (Match::WrongUnit, _) => {
                *misnamed = true;
                problems.push(HeaderProblem::WrongUnit { column: field.clone(), name: (*name).to_owned(), units });
            }
        }
    }
    for ((w, slot), misnamed) in wanted.iter().zip(&mut found).zip(misnamed) {
        match (&slot, w.absent) {
            (None, Some(value)) => *slot = Some(Column::Absent(value)),
            (None, None) if !misnamed => {
                let (name, units) = (w.name.to_owned(), w.units);
                problems.push(HeaderProblem::Missing { name, units, found: header.to_vec() });
            }
            _ => {}
        }
    }
    if problems.is_empty() { Ok(found.into_iter().flatten().collect()) } else { Err(problems) }
}
