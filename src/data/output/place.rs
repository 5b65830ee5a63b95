//! Where a name leads: to a file, to a stream, or to what must not be written.

use std::fs::{self, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::error::WriteProblem;

/// Symbolic links followed to a file that is not there yet.
const LINKS: usize = 40;

/// Where an output goes.
pub(super) enum Place {
    /// A pipe, a terminal, a device; standard output, whatever it is. It is written through.
    Stream(Box<dyn Write>),
    /// A file that is there or not; no symbolic link.
    File(PathBuf),
}

impl Place {
    /// Of a name.
    pub fn of(path: &Path) -> Result<Self, WriteProblem> {
        if ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].iter().any(|name| path == Path::new(name)) {
            return Ok(Self::Stream(Box::new(io::stdout())));
        }
        let Ok(there) = fs::metadata(path) else { return Ok(Self::File(followed(path)?)) };
        if there.is_dir() || is_block_device(&there) {
            return Err(WriteProblem::NoFile);
        }
        if !there.is_file() {
            return Ok(Self::Stream(Box::new(OpenOptions::new().write(true).open(path)?)));
        }
        match (Handle::stdout(), Handle::from_path(path)) {
            (Ok(stdout), Ok(own)) if stdout == own => Ok(Self::Stream(Box::new(io::stdout()))),
            _ => Ok(Self::File(followed(path)?)),
        }
    }
}

#[cfg(unix)]
fn is_block_device(there: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_block_device(&there.file_type())
}

#[cfg(not(unix))]
fn is_block_device(_: &Metadata) -> bool {
    false
}

/// The absolute name of a file or directory that may not be there yet, symbolic links followed.
pub(super) fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        if let Ok(there) = fs::canonicalize(&path) {
            return Ok(there);
        }
        match fs::read_link(&path) {
            Ok(target) => path = path.parent().unwrap_or(Path::new("")).join(target),
            Err(_) => break,
        }
    }
    let (Some(name), parent) = (path.file_name(), path.parent()) else {
        return Err(io::ErrorKind::InvalidInput.into());
    };
    let parent = parent.filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Ok(fs::canonicalize(parent)?.join(name))
}

/// A hidden name beside a file or directory.
pub(super) fn beside(path: &Path, ending: &str) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.trunnion{ending}"))
}

/// Whether two names are one file.
pub(super) fn same(a: &Path, b: &Path) -> bool {
    same_file::is_same_file(a, b).unwrap_or(false)
}
