//! Writing whole files or none.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::Builder;
use thiserror::Error;

use super::columns::Wanted;
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
    #[error("cannot be written: {0}")]
    Refused(io::ErrorKind),
    /// There is no such directory, and none can be made.
    #[error("{0}\n  expected a directory that can be written, or a name for a new one")]
    Directory(io::ErrorKind),
    /// NaN or infinity in a line, counted from 1.
    #[error("value {column} of line {line} is not finite")]
    NotFinite {
        /// The line in the file.
        line: usize,
        /// The value in the line, counted from 1.
        column: usize,
    },
    /// A line with another number of values than columns, counted from 1.
    #[error("line {line} has {found} values for {expected} columns")]
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
    #[error("a column cannot be written in {0}")]
    Unit(Unit),
}

impl From<io::Error> for WriteProblem {
    fn from(error: io::Error) -> Self {
        WriteProblem::Refused(error.kind())
    }
}

/// Writes a file so that it is there whole or not at all: into a temporary one beside it, which then takes its name.
///
/// # Errors
/// [`WriteError`] where the directory is missing or cannot be written.
pub fn write_atomically(file: &Path, contents: &[u8]) -> Result<(), WriteError> {
    replace(file, contents).map_err(|error| WriteError { file: file.to_owned(), problem: error.into() })
}

fn replace(file: &Path, contents: &[u8]) -> io::Result<()> {
    let directory = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = Builder::new();
    // A temporary file is for its owner alone; this one is to end as any other file does.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    if let Ok(before) = fs::metadata(file) {
        builder.permissions(before.permissions());
    }
    let mut temporary = builder.tempfile_in(directory)?;
    temporary.write_all(contents)?;
    temporary.as_file().sync_all()?;
    temporary.persist(file).map_err(|error| error.error)?;
    Ok(())
}

/// Writes columns of values (mm or rad) in their units, below a header.
pub(crate) fn write_columns(
    file: &Path,
    columns: &[(Wanted, Unit)],
    lines: impl Iterator<Item = Vec<f64>>,
) -> Result<(), WriteError> {
    let text = render(columns, lines).map_err(|problem| WriteError { file: file.to_owned(), problem })?;
    write_atomically(file, &text)
}

fn render(columns: &[(Wanted, Unit)], lines: impl Iterator<Item = Vec<f64>>) -> Result<Vec<u8>, WriteProblem> {
    if let Some((_, unit)) = columns.iter().find(|(wanted, unit)| !wanted.units.contains(unit)) {
        return Err(WriteProblem::Unit(*unit));
    }
    let refused = |_| WriteProblem::Refused(io::ErrorKind::InvalidData);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|(wanted, unit)| format!("{}_{unit}", wanted.name))).map_err(refused)?;
    for (line, values) in (2..).zip(lines) {
        if values.len() != columns.len() {
            return Err(WriteProblem::Count { line, found: values.len(), expected: columns.len() });
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(WriteProblem::NotFinite { line, column: at + 1 });
        }
        let fields = columns.iter().zip(values).map(|((_, unit), value)| unit.decimal(value));
        writer.write_record(fields).map_err(refused)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
