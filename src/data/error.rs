//! What can be wrong with a measurement file, and how it is said.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::unit::Unit;

/// Bad lines shown of one file; the rest are counted.
const SHOWN: usize = 5;

/// A file that cannot be used, and why.
///
/// Shown as `path:line: what is wrong` with the remedy indented on the line below it, one such pair for each bad line.
#[derive(Debug, Error)]
pub struct FileError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong with it.
    #[source]
    pub problem: Problem,
}

/// What is wrong with a file.
#[derive(Debug, PartialEq, Error)]
pub enum Problem {
    /// No such file.
    #[error("no such file\n  expected a CSV file with the columns {}", List(.columns))]
    Missing {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// A directory.
    #[error("this is a directory\n  expected a CSV file with the columns {}", List(.columns))]
    Directory {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// The operating system refuses.
    #[error("cannot be read: {0}")]
    Unreadable(io::ErrorKind),
    /// Nothing but comments and empty lines.
    #[error("the file is empty\n  expected a header line with the columns {}", List(.columns))]
    Empty {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// Not UTF-8.
    #[error("not UTF-8 text{}\n  save the file as plain CSV in UTF-8", .utf16.then_some(" but UTF-16").unwrap_or_default())]
    NotUtf8 {
        /// The line of the first bad byte.
        line: u64,
        /// It begins with a UTF-16 byte order mark.
        utf16: bool,
    },
    /// Fields divided by something else than commas.
    #[error(
        "fields are separated by {separator}\n  expected commas between fields and points in numbers: replace decimal commas by points first, then {separator} by commas"
    )]
    Separator {
        /// The header's line.
        line: u64,
        /// What stands between the fields.
        separator: Separator,
    },
    /// The header's columns are not those expected.
    #[error("{}", Joined(.problems))]
    Header {
        /// The header's line.
        line: u64,
        /// Everything wrong with it.
        problems: Vec<HeaderProblem>,
    },
    /// Lines that are not usable, in the file's order.
    #[error("{} bad lines", .0.len())]
    Lines(Vec<LineProblem>),
    /// Fewer samples than needed.
    #[error("too few {}: {present} present, at least {needed} needed\n  expected {why}", .why.counted())]
    TooFew {
        /// Samples in the file.
        present: usize,
        /// Samples needed.
        needed: usize,
        /// What needs them.
        why: Need,
    },
    /// Bar lengths where radial deviations belong.
    #[error(
        "readings look like absolute lengths near {near_mm} mm (median {median_mm:.3} mm)\n  expected radial deviations from the radius: subtract {radius_mm} mm from each reading"
    )]
    AbsoluteLengths {
        /// Median of the readings, mm.
        median_mm: f64,
        /// The same, rounded to what a bar's length would be.
        near_mm: f64,
        /// The radius given, mm.
        radius_mm: f64,
    },
    /// Deviations larger than the bar can measure.
    #[error(
        "readings of {median_mm:.3} mm (median) are beyond the stroke of a ball-bar, about ±1 mm\n  expected radial deviations: is the unit in {column} right? If they are absolute lengths, subtract the bar's (which is then not the radius given, {radius_mm} mm)"
    )]
    BeyondStroke {
        /// Median of the absolute readings, mm.
        median_mm: f64,
        /// The radius given, mm.
        radius_mm: f64,
        /// The readings' column.
        column: String,
    },
    /// Angles of more turns than an axis makes in a run.
    #[error("angles reach {angle:.1} rad, {turns:.1} turns\n  expected at most {most} turns: are the angles in {column} degrees? Then name it with _deg", angle = .angle_rad, turns = .angle_rad / std::f64::consts::TAU)]
    ManyTurns {
        /// The largest angle, without its sign, rad.
        angle_rad: f64,
        /// Turns taken.
        most: f64,
        /// The angles' column.
        column: String,
    },
    /// Samples outside a table's range; the file is the samples'.
    #[error("{} samples outside the range of {}", .samples.len(), .table.display())]
    OutsideTable {
        /// The table's file.
        table: PathBuf,
        /// First and last node, rad.
        range: (f64, f64),
        /// Line and angle in rad of each sample outside.
        samples: Vec<(u64, f64)>,
    },
}

/// What a smallest number of samples is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Need {
    /// A sample at least for each coefficient to fit.
    #[error("at least one sample for each of the coefficients to fit")]
    Coefficients,
    /// Two nodes to interpolate between.
    #[error("at least two angles to interpolate between")]
    Interpolation,
}

impl Need {
    const fn counted(self) -> &'static str {
        match self {
            Need::Coefficients => "samples",
            Need::Interpolation => "angles",
        }
    }
}

/// Separators that are not commas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Separator {
    /// `;`
    #[error("semicolons")]
    Semicolon,
    /// A tabulator.
    #[error("tabs")]
    Tab,
}

/// One thing wrong with a header.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum HeaderProblem {
    /// The first line holds numbers.
    #[error("no header: the first line holds numbers\n  expected the column names {} above it", List(.columns))]
    Absent {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// A column that has to be there is not.
    #[error("missing column {}\n  found {}", Names(.name, .units), List(.found))]
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
    #[error("column {name:?} has no unit\n  expected {}", Names(.name, .units))]
    NoUnit {
        /// The column as it stands.
        name: String,
        /// The units it may be in.
        units: &'static [Unit],
    },
    /// A name with a unit it cannot have.
    #[error("column {column:?} has a unit that does not fit\n  expected {}", Names(.name, .units))]
    WrongUnit {
        /// The column as it stands.
        column: String,
        /// Its name without the unit.
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
pub enum FieldProblem {
    /// Too few or too many fields.
    #[error("{found} field(s) in a file of {expected} columns\n  expected {expected} numbers separated by commas")]
    Count {
        /// Fields in the line.
        found: usize,
        /// Columns in the header.
        expected: usize,
    },
    /// Twice as many fields as columns: commas in the numbers too.
    #[error(
        "{found} fields in a file of {expected} columns: decimal commas?\n  expected points in numbers (12.5) and commas between them"
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
    /// A comma within a number.
    #[error("{text:?} in column {column} has a decimal comma\n  expected a decimal point, such as 12.5")]
    DecimalComma {
        /// The field's column.
        column: String,
        /// The field.
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
    /// An angle that was there already.
    #[error("the angle {} is already on line {first}\n  expected each angle once in a file: give the mean of repeated readings, or remove one of the lines", Degrees(*.angle_rad))]
    RepeatedAngle {
        /// The angle, rad.
        angle_rad: f64,
        /// Where it stands first.
        first: u64,
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

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file.display();
        match &self.problem {
            Problem::Lines(lines) => {
                for (at, bad) in lines.iter().take(SHOWN).enumerate() {
                    if at > 0 {
                        writeln!(f)?;
                    }
                    write!(f, "{file}:{}: {}", bad.line, bad.problem)?;
                }
                more(f, lines.len())
            }
            Problem::OutsideTable { table, range, samples } => {
                let (low, high) = (Degrees(range.0), Degrees(range.1));
                for (at, (line, angle)) in samples.iter().take(SHOWN).enumerate() {
                    if at > 0 {
                        writeln!(f)?;
                    }
                    let angle = Degrees(*angle);
                    write!(f, "{file}:{line}: the sample's angle {angle} is outside the table {}", table.display())?;
                }
                more(f, samples.len())?;
                write!(
                    f,
                    "\n  expected angles from {low} to {high}, the table's range: extend the table or leave these samples out"
                )
            }
            Problem::Header { line, problems } => {
                for (at, problem) in problems.iter().enumerate() {
                    if at > 0 {
                        writeln!(f)?;
                    }
                    write!(f, "{file}:{line}: {problem}")?;
                }
                Ok(())
            }
            Problem::NotUtf8 { line, .. } | Problem::Separator { line, .. } => {
                write!(f, "{file}:{line}: {}", self.problem)
            }
            _ => write!(f, "{file}: {}", self.problem),
        }
    }
}

fn more(f: &mut fmt::Formatter<'_>, total: usize) -> fmt::Result {
    match total.saturating_sub(SHOWN) {
        0 => Ok(()),
        rest => write!(f, "\n… and {rest} more, {total} bad lines in all"),
    }
}

/// An angle in rad, shown in degrees without the last digits of the conversion and without a sign at zero.
struct Degrees(f64);

impl fmt::Display for Degrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}°", Unit::Deg.decimal(self.0 + 0.0).trim_end_matches(".0"))
    }
}

/// Names with commas between them.
struct List<'a>(&'a [String]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join(", "))
    }
}

/// A name in each of its units.
struct Names<'a>(&'a str, &'a [Unit]);

impl fmt::Display for Names<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, unit) in self.1.iter().enumerate() {
            let between = if at > 0 { " or " } else { "" };
            write!(f, "{between}{}_{unit}", self.0)?;
        }
        Ok(())
    }
}

/// Header problems, one below the other.
struct Joined<'a>(&'a [HeaderProblem]);

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
