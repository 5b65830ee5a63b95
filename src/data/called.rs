//! Columns that have other names in a file than here, and units as people write them.

use std::collections::BTreeMap;
use std::str::FromStr;

use serde::Deserialize;
use thiserror::Error;
use trunnion_codegen::quantity::Unit;

/// What columns are called in files of other programs: `a` is `Angle [deg]`, its unit in its name; or `a_deg` is `Angle`, its
/// unit stated.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "BTreeMap<String, String>")]
pub struct Columns(BTreeMap<String, Heading>);

/// The text above a column.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Heading {
    text: String,
    unit: Option<Unit>,
}

/// Names that nothing else stands for.
pub(super) static NATIVE: Columns = Columns(BTreeMap::new());

/// Why names of columns cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ColumnsError {
    /// No name with the text that stands for it.
    #[error(
        "{0:?} is not a column with its name in the file\n  expected for example a=\"Angle [deg]\",dr=\"Radius [µm]\""
    )]
    NotAPair(String),
    /// Two texts for one column.
    #[error("column {0} is given twice\n  expected each column once")]
    Twice(String),
}

/// What a column is called in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Called<'a> {
    /// The text above it.
    pub text: &'a str,
    /// Its unit; none where the text has it.
    pub unit: Option<Unit>,
}

impl Columns {
    /// The columns that have another name, without their units.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The name of a column in the file, if it has another one.
    pub(super) fn called(&self, name: &str) -> Option<Called<'_>> {
        let Heading { text, unit } = self.0.get(name)?;
        Some(Called { text, unit: *unit })
    }

    fn add(&mut self, name: &str, text: &str) -> Result<(), ColumnsError> {
        let stated = name.rsplit_once('_').and_then(|(name, suffix)| Some((name, by_suffix(suffix)?)));
        let (name, unit) = stated.map_or((name, None), |(name, unit)| (name, Some(unit)));
        let text = text.trim();
        if name.is_empty() || text.is_empty() {
            return Err(ColumnsError::NotAPair(format!("{name}={text}")));
        }
        match self.0.insert(name.to_owned(), Heading { text: text.to_owned(), unit }) {
            None => Ok(()),
            Some(_) => Err(ColumnsError::Twice(name.to_owned())),
        }
    }
}

impl TryFrom<BTreeMap<String, String>> for Columns {
    type Error = ColumnsError;

    fn try_from(named: BTreeMap<String, String>) -> Result<Self, ColumnsError> {
        let mut columns = Self::default();
        named.iter().try_for_each(|(name, text)| columns.add(name, text))?;
        Ok(columns)
    }
}

/// `a="Angle [deg]",dr="Radius [µm]"`, with or without the quotes, which a shell takes away; a comma that no `NAME=` follows
/// is part of a text.
impl FromStr for Columns {
    type Err = ColumnsError;

    fn from_str(text: &str) -> Result<Self, ColumnsError> {
        let mut pairs: Vec<(String, String)> = Vec::new();
        for piece in text.split(',') {
            match (piece.split_once('='), pairs.last_mut()) {
                (Some((name, text)), _) => pairs.push((name.trim().to_owned(), text.to_owned())),
                (None, Some((_, text))) => *text = format!("{text},{piece}"),
                (None, None) => return Err(ColumnsError::NotAPair(piece.to_owned())),
            }
        }
        let mut columns = Self::default();
        for (name, text) in pairs {
            let text = text.trim();
            columns.add(&name, text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text))?;
        }
        Ok(columns)
    }
}

/// The text above a column as its name and its unit: `Radius [µm]`, `Radius (µm)`, `Radius / µm`, `Radius in µm`, `radius_um`.
pub(super) fn with_unit(text: &str) -> Option<(&str, Unit)> {
    let bracketed = |open, close| text.strip_suffix(close).and_then(|text: &str| text.rsplit_once(open));
    let ways =
        [bracketed('[', ']'), bracketed('(', ')'), text.rsplit_once('/'), text.rsplit_once('_'), text.rsplit_once(' ')];
    let known = |(name, unit): (_, &str)| Some((name, by_name(unit.trim())?));
    let (name, unit): (&str, Unit) = ways.into_iter().flatten().find_map(known)?;
    let name = name.trim();
    Some((name.strip_suffix(" in").map_or(name, str::trim_end), unit))
}

fn by_suffix(suffix: &str) -> Option<Unit> {
    [Unit::Deg, Unit::Rad, Unit::Urad, Unit::Um, Unit::Mm].into_iter().find(|unit| unit.suffix() == suffix)
}

/// A column's name with the unit that stands on a line of its own below it.
pub(super) fn joined(name: &str, unit: &str) -> String {
    match bare(unit) {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    }
}

/// Whether the fields of a line are units, of which one is known.
pub(super) fn are_units<'a>(fields: impl Iterator<Item = &'a str> + Clone) -> bool {
    let known = |field: &str| by_name(bare(field)).is_some();
    let bracketed = |field: &str| field.is_empty() || bare(field) != field;
    fields.clone().any(known) && fields.clone().all(|field| known(field) || bracketed(field))
}

/// A unit without its brackets.
fn bare(unit: &str) -> &str {
    let within = |open, close| unit.strip_prefix(open).and_then(|unit: &str| unit.strip_suffix(close));
    within('[', ']').or(within('(', ')')).unwrap_or(unit).trim()
}

/// A unit as people write it. A German "Grad" may be a degree or a gon: it has to be stated.
fn by_name(name: &str) -> Option<Unit> {
    // Two letters look like µ.
    let name = name.replace('\u{3bc}', "µ");
    match name.to_lowercase().as_str() {
        "deg" | "°" | "º" | "degree" | "degrees" => Some(Unit::Deg),
        "rad" => Some(Unit::Rad),
        "µrad" | "urad" => Some(Unit::Urad),
        "µm" | "um" | "micron" | "microns" => Some(Unit::Um),
        "mm" => Some(Unit::Mm),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_found_where_people_write_it() {
        let written = ["r [µm]", "r[um]", "r (\u{3bc}m)", "r / µm", "r/µm", "r_um", "r µm", "r in µm"];
        assert_eq!(written.map(with_unit), [Some(("r", Unit::Um)); 8]);
        assert_eq!(with_unit("Winkel A [°]"), Some(("Winkel A", Unit::Deg)));
        // "Mm" would be a megametre, but nobody means that.
        assert_eq!(["r [nm]", "r", "r [Grad]", "um", "[", "(]"].map(with_unit), [None; 6]);
    }

    #[test]
    fn names_are_read_with_and_without_quotes() {
        let columns: Columns = r#"a="Angle [deg]", dr_um = "Radius, deviation""#.parse().unwrap();
        assert_eq!(columns.called("a"), Some(Called { text: "Angle [deg]", unit: None }));
        assert_eq!(columns.called("dr"), Some(Called { text: "Radius, deviation", unit: Some(Unit::Um) }));
        assert_eq!("a=Angle [deg],dr_um=Radius, deviation".parse(), Ok(columns.clone()));
        assert_eq!(columns.names().collect::<Vec<_>>(), ["a", "dr"]);
        assert_eq!("a=x,a_deg=y".parse::<Columns>(), Err(ColumnsError::Twice("a".to_owned())));
        for bad in ["", "angle", "a=", "=x", "_deg=x"] {
            assert!(matches!(bad.parse::<Columns>(), Err(ColumnsError::NotAPair(_))), "{bad}");
        }
    }
}
