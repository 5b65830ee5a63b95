//! What can be wrong with a file of numbers, and how it is said.

mod header;
mod line;
mod words;

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

pub use header::HeaderProblem;
pub use line::{FieldProblem, LineProblem};

use header::Joined;
use words::{Degrees, List};

use super::limits::{LINE, LINES};
use super::separator::Separator;
use crate::import::ImportProblem;

/// Problems shown of one file; the rest are counted.
const SHOWN: usize = 5;

/// The first bad lines of a file, and how many there are.
#[derive(Clone, Debug, PartialEq)]
pub struct BadLines {
    first: Vec<LineProblem>,
    all: usize,
}

impl BadLines {
    /// Those that are shown, in the file's order.
    pub fn first(&self) -> &[LineProblem] {
        &self.first
    }

    /// Of how many.
    pub fn all(&self) -> usize {
        self.all
    }

    pub(super) fn new(first: LineProblem) -> Self {
        Self { first: vec![first], all: 1 }
    }

    /// None of no lines.
    pub(super) fn of(mut lines: impl Iterator<Item = LineProblem>) -> Option<Self> {
        let mut bad = Self::new(lines.next()?);
        lines.for_each(|line| bad.add(line));
        Some(bad)
    }

    pub(super) fn add(&mut self, line: LineProblem) {
        self.all += 1;
        if self.first.len() < SHOWN {
            self.first.push(line);
        }
    }
}

/// A file that cannot be used, and why.
///
/// Shown as `path:line: what is wrong` with the remedy indented on the line below it, one such pair for each bad line.
#[derive(Debug, Error)]
pub struct FileError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong with it.
    #[source]
    pub problem: FileProblem,
}

/// What is wrong with a file.
#[derive(Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FileProblem {
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
    #[error("cannot be read: {0}\n  expected a file that can be read")]
    Unreadable(io::ErrorKind),
    /// Nothing but comments and empty lines.
    #[error("the file is empty\n  expected a header line with the columns {}", List(.columns))]
    Empty {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// Bytes that are no letters.
    #[error("this is not text\n  expected a CSV file")]
    NotText {
        /// The line of the first one.
        line: u64,
    },
    /// XML where a table belongs.
    #[error("this is XML\n  expected a CSV file with the columns {}; the file of an instrument for a run of a ball-bar, by its name", List(.columns))]
    Xml {
        /// The columns such a file has.
        columns: Vec<String>,
    },
    /// An instrument's own file cannot be used.
    #[error(transparent)]
    Import(#[from] ImportProblem),
    /// A line, or a field in quotes that goes over several, of more than [`LINE`] bytes.
    #[error(
        "a line of more than {LINE} bytes\n  expected a line for each sample: is this a CSV file, and every quote closed?"
    )]
    LongLine {
        /// The line it begins on.
        line: u64,
    },
    /// More than [`LINES`] lines.
    #[error("more than {LINES} lines\n  expected a file with an end: divide it, or leave out samples")]
    ManyLines,
    /// A file that was another when it was read again.
    #[error("has changed while it was read\n  expected a file that stays as it is: copy it first")]
    Changed,
    /// More samples, nodes or touches than can be kept at once.
    #[error("more than {most} {what}\n  expected fewer: leave out samples that lie next to others", what = .of.counted())]
    TooMany {
        /// How many can be.
        most: usize,
        /// Of what.
        of: Need,
    },
    /// Fields that may be divided in two ways.
    #[error(
        "fields may be separated by {first} or by {second}\n  expected one of them throughout, and the columns' names above the numbers"
    )]
    Ambiguous {
        /// The line of the header.
        line: u64,
        /// What may stand between the fields.
        first: Separator,
        /// What else.
        second: Separator,
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
    #[error("{} bad lines", .0.all)]
    Lines(BadLines),
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
        "readings of {median_mm:.3} mm (median) are beyond the stroke of a ball-bar, about ±1 mm\n  expected radial deviations: is the unit in {column} right?{}",
        .radius_mm.map_or_else(String::new, |mm| format!(" If they are absolute lengths, subtract the bar's (which is then not the radius given, {mm} mm)"))
    )]
    BeyondStroke {
        /// Median of the absolute readings, mm.
        median_mm: f64,
        /// The radius given, mm; none of displacements.
        radius_mm: Option<f64>,
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
#[non_exhaustive]
pub enum Need {
    /// A sample at least for each coefficient to fit.
    #[error("at least one sample for each of the coefficients to fit")]
    Coefficients,
    /// Two nodes to interpolate between.
    #[error("at least two angles to interpolate between")]
    Interpolation,
    /// Touches of a probe.
    #[error("that many lines of numbers below the header")]
    Touches,
}

impl Need {
    const fn counted(self) -> &'static str {
        match self {
            Need::Coefficients => "samples",
            Need::Interpolation => "angles",
            Need::Touches => "touches",
        }
    }
}

impl FileError {
    /// The first line that is wrong, where it is lines that are.
    pub fn line(&self) -> Option<u64> {
        match &self.problem {
            FileProblem::Lines(bad) => bad.first().first().map(|bad| bad.line),
            FileProblem::OutsideTable { samples, .. } => samples.first().map(|(line, _)| *line),
            FileProblem::Header { line, .. } => Some(*line),
            problem => problem.line(),
        }
    }
}

impl FileProblem {
    /// The line of a problem that has one place.
    fn line(&self) -> Option<u64> {
        match self {
            Self::NotText { line } | Self::LongLine { line } | Self::Ambiguous { line, .. } => Some(*line),
            Self::Import(problem) => problem.line(),
            _ => None,
        }
    }
}

impl From<io::Error> for FileProblem {
    fn from(error: io::Error) -> Self {
        FileProblem::Unreadable(error.kind())
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file.display();
        match &self.problem {
            FileProblem::Lines(BadLines { first, all }) => {
                for (at, bad) in first.iter().enumerate() {
                    if at > 0 {
                        writeln!(f)?;
                    }
                    write!(f, "{file}:{}: {}", bad.line, bad.problem)?;
                }
                more(f, *all)
            }
            FileProblem::OutsideTable { table, range, samples } => {
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
            FileProblem::Header { line, problems } => {
                for (at, problem) in problems.iter().take(SHOWN).enumerate() {
                    if at > 0 {
                        writeln!(f)?;
                    }
                    write!(f, "{file}:{line}: {problem}")?;
                }
                match problems.len().saturating_sub(SHOWN) {
                    0 => Ok(()),
                    rest => write!(f, "\n… and {rest} more"),
                }
            }
            problem => match problem.line() {
                Some(line) => write!(f, "{file}:{line}: {problem}"),
                None => write!(f, "{file}: {problem}"),
            },
        }
    }
}

fn more(f: &mut fmt::Formatter<'_>, total: usize) -> fmt::Result {
    match total.saturating_sub(SHOWN) {
        0 => Ok(()),
        rest => write!(f, "\n… and {rest} more, {total} bad lines in all"),
    }
}
