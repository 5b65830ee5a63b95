//! The header: which column is what, in which unit.

use super::called::{Called, Columns, with_unit};
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
    /// Its name in the file, where that is another one.
    pub called: Option<Called<'a>>,
    /// Whether a column of any other name is meant as well, if its unit fits.
    pub any: bool,
}

impl<'a> Wanted<'a> {
    /// A column that has to be there.
    pub const fn new(name: &'a str, units: &'static [Unit]) -> Self {
        Self { name, units, absent: None, called: None, any: false }
    }

    /// The same with the name that it has in files with such columns.
    pub fn in_files(self, columns: &'a Columns) -> Self {
        Self { called: columns.called(self.name), ..self }
    }

    /// Whether it is the column under this text.
    pub fn is(&self, field: &str) -> bool {
        matches!(compare(field, self), Some(Match::Fits(_)))
    }

    /// Its name in the header, without the unit where there is a choice.
    fn missing(&self) -> (String, &'static [Unit]) {
        match self.called {
            Some(called) => (called.text.to_owned(), &[]),
            None => (self.name.to_owned(), self.units),
        }
    }

    /// A column that has to be there, whatever stands before its unit; `name` for example.
    pub const fn any(name: &'a str, units: &'static [Unit]) -> Self {
        Self { name, units, absent: None, called: None, any: true }
    }

    /// As a message lists it: `a_deg or a_rad`.
    fn listed(&self) -> String {
        let (name, units) = self.missing();
        let names: Vec<String> = units.iter().map(|unit| format!("{name}_{unit}")).collect();
        let names = if names.is_empty() { name } else { names.join(" or ") };
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
    /// Its unit in the file, if it is there and has one.
    pub fn unit(&self) -> Option<Unit> {
        match self {
            Self::Present { unit, .. } => *unit,
            Self::Absent(_) => None,
        }
    }

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
    let Wanted { name, units, called, any, .. } = *wanted;
    let fitting = |unit: Unit| if units.contains(&unit) { Match::Fits(Some(unit)) } else { Match::WrongUnit };
    let written = with_unit(field);
    if let Some(Called { text, unit: stated }) = called {
        // It may be given without the unit that it has in the file.
        let is = field == text || written.is_some_and(|(name, _)| name == text);
        return is.then(|| match (stated, written) {
            (Some(stated), Some((_, unit))) if stated != unit => Match::WrongUnit,
            (Some(unit), _) | (None, Some((_, unit))) => fitting(unit),
            (None, None) => Match::NoUnit,
        });
    }
    if any {
        let (_, unit) = with_unit(field)?;
        return units.contains(&unit).then_some(Match::Fits(Some(unit)));
    }
    match (field.strip_prefix(name)?, units) {
        ("", []) => Some(Match::Fits(None)),
        ("", _) => Some(Match::NoUnit),
        (_, []) => None,
        (rest, _) => match written {
            Some((own, unit)) if own == name => Some(fitting(unit)),
            _ => rest.starts_with(['_', ' ', '[', '(', '/']).then_some(Match::WrongUnit),
        },
    }
}

/// The wanted columns in the header, in the order wanted; or everything wrong with the header.
pub(crate) fn resolve(header: &[String], wanted: &[Wanted]) -> Result<Vec<Column>, Vec<HeaderProblem>> {
    if header.iter().all(|field| field.parse::<f64>().is_ok()) {
        return Err(vec![HeaderProblem::Absent { columns: listed(wanted) }]);
    }
    let mut found: Vec<Option<Column>> = vec![None; wanted.len()];
    let mut misnamed = vec![false; wanted.len()];
    // Problems of columns that may be others, beside those wanted.
    let (mut problems, mut others) = (Vec::new(), Vec::new());
    for (at, field) in header.iter().enumerate() {
        // `a` is also the beginning of `a_x_um`: the column whose unit fits comes first.
        let candidates = || wanted.iter().enumerate().filter_map(|(i, w)| compare(field, w).map(|m| (i, w, m)));
        let best = candidates().find(|(.., m)| matches!(m, Match::Fits(_))).or_else(|| candidates().next());
        let Some((i, Wanted { name, units, called, .. }, matched)) = best else {
            others.push(HeaderProblem::Unknown { name: field.clone(), columns: listed(wanted) });
            continue;
        };
        let (Some(slot), Some(misnamed)) = (found.get_mut(i), misnamed.get_mut(i)) else {
            continue;
        };
        let (column, name) = (field.clone(), (*name).to_owned());
        match (matched, &slot) {
            (Match::Fits(_), Some(first)) => {
                problems.push(HeaderProblem::Twice { first: first.name().to_owned(), second: column });
            }
            (Match::Fits(unit), None) => *slot = Some(Column::Present { name: column, unit, at }),
            (Match::NoUnit, _) => {
                *misnamed = true;
                others.push(match called {
                    Some(_) => HeaderProblem::UnknownUnit { column, name, units },
                    None => HeaderProblem::NoUnit { name: column, units },
                });
            }
            (Match::WrongUnit, _) => {
                *misnamed = true;
                others.push(HeaderProblem::WrongUnit { column, name, units });
            }
        }
    }
    // A file may have more columns; but where one is missing, another may be it.
    if found.iter().any(Option::is_none) {
        problems.append(&mut others);
    }
    for ((w, slot), misnamed) in wanted.iter().zip(&mut found).zip(misnamed) {
        match (&slot, w.absent) {
            (None, Some(value)) => *slot = Some(Column::Absent(value)),
            (None, None) if !misnamed => {
                let (name, units) = w.missing();
                problems.push(HeaderProblem::Missing { name, units, found: header.to_vec() });
            }
            _ => {}
        }
    }
    if problems.is_empty() { Ok(found.into_iter().flatten().collect()) } else { Err(problems) }
}
