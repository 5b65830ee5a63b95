//! Output that appears whole or not at all, in constant memory.

use super::ExechonRefused;
use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

/// Lines collected in a temporary file, shown on standard output once all are there.
///
/// A bad line anywhere in the input then leaves standard output empty, from a file as from a pipe, and memory stays
/// constant however long the input is.
pub struct Spool {
    lines: BufWriter<File>,
}

impl Spool {
    /// An empty one.
    pub fn new() -> Result<Self, ExechonRefused> {
        Ok(Self { lines: BufWriter::with_capacity(1 << 16, tempfile::tempfile()?) })
    }

    /// A line.
    pub fn line(&mut self, line: std::fmt::Arguments<'_>) -> Result<(), ExechonRefused> {
        self.lines.write_fmt(line)?;
        Ok(self.lines.write_all(b"\n")?)
    }

    /// Shows everything; a reader that has gone away is no error.
    pub fn show(self) -> Result<(), ExechonRefused> {
        let mut file = self.lines.into_inner().map_err(|e| e.into_error())?;
        file.rewind()?;
        match io::copy(&mut file, &mut io::stdout().lock()) {
            Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(e.into()),
            _ => Ok(()),
        }
    }
}

/// Writes a text to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<(), ExechonRefused> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(e.into()),
        _ => Ok(()),
    }
}

/// Writes a picture's file, if one is asked for.
pub fn picture(
    file: Option<&Path>,
    svg: impl FnOnce() -> Result<String, ExechonRefused>,
) -> Result<(), ExechonRefused> {
    match file {
        Some(file) => Ok(trunnion::data::write_atomically(file, svg()?.as_bytes())?),
        None => Ok(()),
    }
}
