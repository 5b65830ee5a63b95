//! Files of instruments and of other programs, read into runs.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::called::Columns;
use super::columns::Column;
use super::decoded::text;
use super::error::{FileError, FileProblem};
use super::limits::{INSTRUMENT, SAMPLES};
use super::lines::{Lines, is_xml, source};
use super::stamp::{Stamp, Stamping};
use super::sweep::{READING, RunColumns, check};
use crate::import::{About, Imported, Stated, TraceSample, Wrong, b5r, by_passes};
use trunnion_codegen::quantity::Unit;

/// The form of a file that was imported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A test of Renishaw Ballbar 20.
    B5r,
    /// A table of angles and readings.
    Table,
}

/// What was read of a file, and which file it was.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedFile {
    /// Its form.
    pub form: Form,
    /// Its digest, SHA-256 in hexadecimal.
    pub sha256: String,
    /// What was read.
    pub imported: Imported,
}

/// Reads the file of an instrument, or a table with columns `<angle>` and `dr` under these names, into its runs; a table's angle
/// may be called anything where no `angle` is given.
///
/// # Errors
/// [`FileError`] where the file cannot be read, is no such file, or does not say enough and neither does what is stated.
pub fn import(file: &Path, angle: Option<&str>, columns: &Columns, stated: &Stated) -> Result<ImportedFile, FileError> {
    let fail = |problem| FileError { file: file.to_owned(), problem };
    let stamping = Stamping::default();
    let stamped = |source| Box::new(stamping.reader(source));
    let begun = source(file).and_then(begin);
    let (form, imported) = match begun {
        Ok((true, source)) => (Form::B5r, instrument(stamped(source), stated).map_err(fail)?),
        Ok((false, source)) => (Form::Table, table(file, Ok(stamped(source)), angle, columns, stated)?),
        Err(refused) => (Form::Table, table(file, Err(refused), angle, columns, stated)?),
    };
    Ok(ImportedFile { form, sha256: stamping.stamp().sha256, imported })
}

/// Reads the file of an instrument; none where it is a table, or cannot be read twice.
pub(super) fn instrument_file(file: &Path) -> Result<Option<(Imported, Stamp)>, FileError> {
    let is_file = file.metadata().is_ok_and(|metadata| metadata.is_file());
    let Some(Ok((true, source))) = is_file.then(|| File::open(file).and_then(|file| begin(Box::new(file)))) else {
        return Ok(None);
    };
    let stamping = Stamping::default();
    let imported = instrument(Box::new(stamping.reader(source)), &Stated::default());
    let imported = imported.map_err(|problem| FileError { file: file.to_owned(), problem })?;
    Ok(Some((imported, stamping.stamp())))
}

/// Bytes by which XML is told.
const HEAD: u64 = 1 << 10;

/// Whether a source begins as XML does, and the source.
fn begin(mut source: Box<dyn Read>) -> io::Result<(bool, Box<dyn Read>)> {
    let mut head = Vec::new();
    source.by_ref().take(HEAD).read_to_end(&mut head)?;
    Ok((is_xml(text(&head).as_bytes()), Box::new(io::Cursor::new(head).chain(source))))
}

fn instrument(source: Box<dyn Read>, stated: &Stated) -> Result<Imported, FileProblem> {
    let mut bytes = Vec::new();
    source.take(INSTRUMENT as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > INSTRUMENT {
        return Err(Wrong::TooLong.of_all().into());
    }
    Ok(b5r(&text(&bytes), stated)?)
}

fn table(
    file: &Path,
    source: io::Result<Box<dyn Read>>,
    angle: Option<&str>,
    names: &Columns,
    stated: &Stated,
) -> Result<Imported, FileError> {
    let columns = RunColumns { angle, reading: READING, others: &[], names, bar_mm: None, least: 2 };
    let lines = Lines::from(file, source, &columns.wanted())?;
    let unit = lines.columns().get(1).and_then(Column::unit).unwrap_or(Unit::Um);
    let mut samples = Vec::new();
    check(lines, &columns, SAMPLES, |sample| {
        let (angle_rad, reading_mm, line) = (sample.angle_rad, sample.reading_mm, sample.line);
        samples.push(TraceSample { angle_rad, reading_mm, line });
    })?;
    let traces = by_passes(&samples, unit, stated);
    let traces = traces.map_err(|problem| FileError { file: file.to_owned(), problem: problem.into() })?;
    Ok(Imported { about: About::default(), traces })
}
