//! What can be wrong with a header.

use std::fmt;

use thiserror::Error;

use super::words::{List, UnitNames};
use trunnion_codegen::quantity::Unit;

/// One thing wrong with a header.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HeaderProblem {
    /// The first line holds numbers.
    #[error("no header: the first line holds numbers\n  expected the column names {} above it", List(.columns))]
    Absent {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// A column that has to be there is not.
    #[error("missing column {}\n  found {}", UnitNames(.name, .units), List(.found))]
    Missing {
        /// Its name without a unit.
        name: String,
        /// The units it may be in.
        units: &'static [Unit],
        /// The columns that are there.
        found: Vec<String>,
    },
    /// A column nobody asked for.
    #[error("unknown column {name:?}\n  expected {}; remove the column or correct its name (upper and lower case differ)", List(.columns))]
    Unknown {
        /// The column as it stands.
        name: String,
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// A name without its unit.
    #[error("column {name:?} has no unit\n  expected {}", UnitNames(.name, .units))]
    NoUnit {
        /// The column as it stands.
        name: String,
        /// The units it may be in.
        units: &'static [Unit],
    },
    /// A name with a unit it cannot have.
    #[error("column {column:?} has a unit that does not fit\n  expected {}", UnitNames(.name, .units))]
    WrongUnit {
        /// The column as it stands.
        column: String,
        /// Its name without the unit.
        name: String,
        /// The units it may be in.
        units: &'static [Unit],
    },
    /// A name of another program without a unit that is known.
    #[error("column {column:?} has no unit that is known\n  expected it to be stated: {} in place of {name}", UnitNames(.name, .units))]
    UnknownUnit {
        /// The column as it stands.
        column: String,
        /// Its name here.
        name: String,
        /// The units it may be in.
        units: &'static [Unit],
    },
    /// The same quantity twice, in the same unit or in two.
    #[error("columns {first:?} and {second:?} are the same quantity\n  expected one of them: remove the other")]
    Twice {
        /// The first column of it.
        first: String,
        /// The next column of it.
        second: String,
    },
}

/// Header problems, one below the other.
pub(super) struct Joined<'a>(pub(super) &'a [HeaderProblem]);

impl fmt::Display for Joined<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, problem) in self.0.iter().enumerate() {
            if at > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}
