//! Writing whole files or none, and sets of files that are complete or absent.

mod error;
mod own;
mod place;
mod set;
mod stage;

pub use error::{WriteError, WriteProblem, remedy};
pub(super) use own::{LISTED, sealed};
pub use set::Files;
pub use stage::discard_staged;

use std::path::{Path, PathBuf};
use std::{fs, io};

use place::Place;
use stage::Stage;

/// What an output has to leave alone.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    /// What the command reads: never replaced.
    pub inputs: Vec<PathBuf>,
    /// Whether files that are no earlier results may be replaced.
    pub force: bool,
}

impl Guard {
    /// Whether a file that may be there may be replaced, `own` saying of it whether it is an earlier result.
    fn allows(&self, file: &Path, own: impl FnOnce(&Path) -> io::Result<bool>) -> Result<(), WriteProblem> {
        let Ok(there) = fs::metadata(file) else { return Ok(()) };
        if !there.is_file() {
            return Err(WriteProblem::NoFile);
        }
        if self.inputs.iter().any(|input| place::same(input, file)) {
            return Err(WriteProblem::Input);
        }
        match self.force || own(file)? {
            true => Ok(()),
            false => Err(WriteProblem::Foreign),
        }
    }

    /// Whether a file can be written, before anything is: what is in its place may be replaced, and there is room beside it.
    ///
    /// # Errors
    /// As [`write_picture`].
    pub fn admits(&self, file: &Path) -> Result<(), WriteError> {
        let admitted = || match Place::of(file)? {
            Place::Stream(_) => Ok(()),
            Place::File(target) => {
                self.allows(&target, own::says_so)?;
                Stage::file(place::beside(&target, ""), &[]).map(drop)
            }
        };
        admitted().map_err(|problem| WriteError { file: file.to_owned(), problem })
    }
}

/// Writes a picture so that it is there whole or not at all: into a hidden file beside it, which then takes its name. It takes the
/// place of an earlier picture; a symbolic link leads to what is written, a stream is written through.
///
/// # Errors
/// [`WriteError`] where something else is in its place, the directory is missing or nothing can be written.
pub fn write_picture(file: &Path, svg: &str, guard: &Guard) -> Result<(), WriteError> {
    replace(file, svg.as_bytes(), guard).map_err(|problem| WriteError { file: file.to_owned(), problem })
}

/// Writes a report as [`write_picture`] a picture: it says of itself by [`MADE`](crate::plot::MADE) that it is one.
///
/// # Errors
/// The same.
pub fn write_report(file: &Path, html: &str, guard: &Guard) -> Result<(), WriteError> {
    write_picture(file, html, guard)
}

/// Writes a compensation table as [`write_picture`] a picture. Where its format has comments it says of itself that it is one; else
/// it is replaced with [`Guard::force`] alone.
///
/// # Errors
/// The same.
pub fn write_table(file: &Path, text: &str, guard: &Guard) -> Result<(), WriteError> {
    write_picture(file, text, guard)
}

/// Writes a file so that it is there whole or not at all, in place of any other; else as [`write_picture`].
///
/// # Errors
/// [`WriteError`] where the directory is missing or cannot be written.
pub fn write_atomically(file: &Path, contents: &[u8]) -> Result<(), WriteError> {
    let guard = Guard { inputs: Vec::new(), force: true };
    replace(file, contents, &guard).map_err(|problem| WriteError { file: file.to_owned(), problem })
}

fn replace(file: &Path, contents: &[u8], guard: &Guard) -> Result<(), WriteProblem> {
    let target = match Place::of(file)? {
        Place::Stream(mut stream) => {
            stream.write_all(contents)?;
            return Ok(stream.flush()?);
        }
        Place::File(target) => target,
    };
    guard.allows(&target, own::says_so)?;
    let staged = Stage::file(place::beside(&target, ""), contents)?;
    if let Ok(before) = fs::metadata(&target) {
        fs::set_permissions(staged.path(), before.permissions())?;
    }
    staged.commit(|staged| fs::rename(staged, &target))
}
