//! Why an output could not be written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;
use trunnion_codegen::quantity::Unit;

/// A file that could not be written; what was there before is still there.
#[derive(Debug, Error)]
#[error("{}: {problem}", .file.display())]
pub struct WriteError {
    /// The file.
    pub file: PathBuf,
    /// Why not.
    #[source]
    pub problem: WriteProblem,
}

/// Why a file could not be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum WriteProblem {
    /// The operating system refuses.
    #[error("cannot be written: {kind}\n  {remedy}", kind = .0, remedy = remedy(*.0))]
    Refused(io::ErrorKind),
    /// There is no such directory, and none can be made.
    #[error("{0}\n  expected a directory that can be written, or a name for a new one")]
    Directory(io::ErrorKind),
    /// A directory or a block device.
    #[error("this is no file\n  expected the name of a file, or of a stream such as /dev/stdout")]
    NoFile,
    /// What the command reads.
    #[error("the command reads this file\n  expected another name for what it writes")]
    Input,
    /// Something else than earlier results.
    #[error("this file is not one that was written here before\n  expected another name, or --force to replace it")]
    Foreign,
    /// Somebody else is writing there.
    #[error("another process is writing this\n  expected to be alone: wait for it, or choose another name")]
    Busy,
    /// NaN or infinity in a line, counted from 1.
    #[error("value {column} of line {line} is not finite\n  expected errors and noise that leave finite readings")]
    NotFinite {
        /// The line in the file.
        line: usize,
        /// The value in the line, counted from 1.
        column: usize,
    },
    /// A line with another number of values than columns, counted from 1.
    #[error("line {line} has {found} values for {expected} columns\n  expected a value for each column")]
    Count {
        /// The line in the file.
        line: usize,
        /// Values given.
        found: usize,
        /// Columns.
        expected: usize,
    },
    /// A run's file that is the known functions', too.
    #[error("this file holds the known functions, and a run has its name\n  expected another name of the run")]
    HoldsTheTable,
    /// A unit that does not fit the column.
    #[error("a column cannot be written in {0}\n  expected a unit of the column's quantity")]
    Unit(Unit),
}

impl From<io::Error> for WriteProblem {
    fn from(error: io::Error) -> Self {
        Self::Refused(error.kind())
    }
}

/// What to do about a refusal of the operating system.
pub fn remedy(kind: io::ErrorKind) -> &'static str {
    use io::ErrorKind as Kind;
    match kind {
        Kind::StorageFull | Kind::QuotaExceeded | Kind::FileTooLarge => {
            "expected room for it: free some, or write elsewhere"
        }
        Kind::BrokenPipe => "expected a reader that takes everything",
        Kind::NotFound | Kind::NotADirectory => "expected a name in a directory that is there",
        _ => "expected a place that can be written",
    }
}
