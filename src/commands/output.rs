//! Standard output, standard error, and files.

use clap::Args;
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, StdoutLock, Write};
#[cfg(unix)]
use std::os::fd::AsFd;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;
use trunnion::data::{Guard, WriteError, remedy, write_picture};

/// Why standard output does not take what is shown.
#[derive(Debug, Error)]
pub enum OutputError {
    #[error("standard output: closed\n  expected one that is open: `> /dev/null` where nobody looks")]
    Closed,
    #[error("standard output: {kind}\n  {remedy}", kind = .0.kind(), remedy = remedy(.0.kind()))]
    Refused(#[from] io::Error),
}

/// Whether standard output was closed when the program was called.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Before `main`, where /dev/null is not in its place yet: what is closed cannot be doubled.
#[cfg(unix)]
#[ctor::ctor]
fn look() {
    CLOSED.store(io::stdout().as_fd().try_clone_to_owned().is_err(), Ordering::Relaxed);
}

/// Standard output.
pub fn output() -> Result<StdoutLock<'static>, OutputError> {
    if CLOSED.load(Ordering::Relaxed) { Err(OutputError::Closed) } else { Ok(io::stdout().lock()) }
}

/// Writes a finished document to standard output.
pub fn print(text: &str) -> Result<(), OutputError> {
    let mut out = output()?;
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

/// Says something beside the output, to whoever listens.
pub fn say(what: impl Display) {
    let _ = writeln!(io::stderr(), "{what}");
}

/// Where lines wait that are not kept in memory: not where the environment says, which is the user's business.
const WAITING: [&str; 2] = ["/tmp", "/var/tmp"];

/// What can be written and read again.
trait Store: Read + Write + Seek {}
impl<T: Read + Write + Seek> Store for T {}

/// Lines collected out of sight, shown on standard output once all are there.
///
/// A bad line anywhere in the input then leaves standard output empty, from a file as from a pipe, and memory stays
/// constant however long the input is. (Where no temporary file can be had, the lines are kept in memory.)
pub struct Spool {
    lines: BufWriter<Box<dyn Store>>,
}

impl Spool {
    /// An empty one.
    pub fn new() -> Self {
        // A file without a name: nothing of it is left, whatever happens.
        let file = WAITING.iter().find_map(|place| tempfile::tempfile_in(place).ok());
        let memory = || Box::new(io::Cursor::new(Vec::new())) as Box<dyn Store>;
        let store = file.map_or_else(memory, |file: File| Box::new(file));
        Self { lines: BufWriter::with_capacity(1 << 16, store) }
    }

    /// A line.
    pub fn line(&mut self, line: std::fmt::Arguments<'_>) -> Result<(), OutputError> {
        self.lines.write_fmt(line)?;
        Ok(self.lines.write_all(b"\n")?)
    }

    /// Shows everything.
    pub fn show(self) -> Result<(), OutputError> {
        let mut store = self.lines.into_inner().map_err(io::IntoInnerError::into_error)?;
        store.rewind()?;
        let mut out = output()?;
        io::copy(&mut store, &mut out)?;
        Ok(out.flush()?)
    }
}

/// A picture beside the output.
#[derive(Clone, Debug, Args)]
pub struct Picture {
    /// Draws it (SVG) into this file, in place of an earlier picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Replaces the file even if it is no earlier picture.
    #[arg(long, requires = "svg")]
    force: bool,
}

impl Picture {
    /// One that is asked for, or none.
    pub fn new(svg: Option<PathBuf>, force: bool) -> Self {
        Self { svg, force }
    }

    /// Draws it, if it is asked for, but never in place of what the command reads.
    pub fn draw<E: From<WriteError>>(
        &self,
        inputs: impl IntoIterator<Item = impl AsRef<Path>>,
        svg: impl FnOnce() -> Result<String, E>,
    ) -> Result<(), E> {
        let Some(file) = &self.svg else { return Ok(()) };
        let inputs = inputs.into_iter().map(|input| input.as_ref().to_owned()).collect();
        Ok(write_picture(file, &svg()?, &Guard { inputs, force: self.force })?)
    }
}
