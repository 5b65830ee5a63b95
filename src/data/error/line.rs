//! What can be wrong with a line.

use thiserror::Error;

use super::words::Degrees;
use crate::data::separator::Separator;

/// A line that is not usable.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{problem}")]
pub struct LineProblem {
    /// The line, counted from 1.
    pub line: u64,
    /// What is wrong with it.
    #[source]
    pub problem: FieldProblem,
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FieldProblem {
    /// Too few or too many fields.
    #[error("{found} field(s) in a file of {expected} columns\n  expected {expected} fields separated by {separator}")]
    Count {
        /// Fields in the line.
        found: usize,
        /// Columns in the header.
        expected: usize,
        /// What stands between the fields.
        separator: Separator,
    },
    /// Words where numbers are due, as below a table.
    #[error("{0:?} has no number\n  expected {1} numbers: delete the line, or begin it with # if it is a remark")]
    Words(String, usize),
    /// Twice as many fields as columns: commas in the numbers too.
    #[error(
        "{found} fields in a file of {expected} columns: decimal commas?\n  expected decimal commas with semicolons between the numbers (1,5;12,5), or decimal points"
    )]
    DecimalCommas {
        /// Fields in the line.
        found: usize,
        /// Columns in the header.
        expected: usize,
    },
    /// The last line stops in its middle.
    #[error(
        "the file is cut short: its last line ends within {column}, without a line end\n  expected a whole last line: copy the file again"
    )]
    CutShort {
        /// The column it ends in.
        column: String,
    },
    /// Nothing in a field.
    #[error("no value in column {column}\n  expected a number such as 12.5")]
    Blank {
        /// The field's column.
        column: String,
    },
    /// No number in a field.
    #[error("{text:?} in column {column} is not a number\n  expected a number such as 12.5")]
    Text {
        /// The field's column.
        column: String,
        /// The field, or its beginning.
        text: String,
    },
    /// A negative uncertainty.
    #[error("a negative uncertainty in column {column}\n  expected a standard uncertainty, 0 or above")]
    Negative {
        /// The field's column.
        column: String,
    },
    /// Decimal commas and points in one file.
    #[error(
        "{text:?} in column {column} has another decimal sign than the numbers before it\n  expected decimal points or decimal commas throughout, and no sign between thousands"
    )]
    MixedDecimals {
        /// The field's column.
        column: String,
        /// The field, or its beginning.
        text: String,
    },
    /// NaN or infinite.
    #[error(
        "{text:?} in column {column} is not finite\n  expected a number such as 12.5; remove the line if nothing was measured"
    )]
    NotFinite {
        /// The field's column.
        column: String,
        /// The field.
        text: String,
    },
    /// A number that no machine has.
    #[error(
        "{text:?} in column {column} is out of range\n  expected a number from -{most} to {most}: is the unit right?"
    )]
    Absurd {
        /// The field's column.
        column: String,
        /// The field.
        text: String,
        /// The largest, without its sign, in the column's unit.
        most: f64,
    },
    /// A single reading that no ball-bar gives.
    #[error(
        "a reading of {reading_mm} mm is beyond the stroke of a ball-bar, about ±1 mm\n  remove the line if it is a slip of the file or of the measurement"
    )]
    BeyondStroke {
        /// The reading, mm.
        reading_mm: f64,
    },
    /// A table's node with two different values.
    #[error("the angle {} has another value of {function} on line {first}\n  expected one value for an angle: remove one of the lines", Degrees(*.angle_rad))]
    TwoValues {
        /// The angle, rad.
        angle_rad: f64,
        /// Where it stands first.
        first: u64,
        /// The function that differs.
        function: String,
    },
}
