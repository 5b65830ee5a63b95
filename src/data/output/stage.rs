//! Where outputs are written before they take their names: hidden, held by one process, gone whenever that one ends.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use same_file::Handle;

use super::error::WriteProblem;

/// Bytes that are written at once.
const PIECE: usize = 1 << 16;

/// What is staged now, for [`discard_staged`].
static STAGED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn staged() -> MutexGuard<'static, Vec<PathBuf>> {
    STAGED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is staged, for a process that is about to end; waits until what is being moved into place is there. Nothing can be
/// staged or moved afterwards.
pub fn discard_staged() {
    let staged = staged();
    staged.iter().for_each(|path| remove(path));
    std::mem::forget(staged);
}

/// Removes a file or directory that may be gone.
pub(super) fn remove(path: &Path) {
    // What cannot be removed now is cleared by the next run.
    let _ = fs::remove_file(path).or_else(|_| fs::remove_dir_all(path));
}

/// A lock on a file or directory, until it is dropped or the process ends, however it does.
pub(super) struct Lock(#[expect(dead_code, reason = "held, not used")] Option<Handle>);

impl Lock {
    /// Takes it; a place that knows no locks is taken without.
    pub fn take(path: &Path) -> Result<Self, WriteProblem> {
        // A directory cannot be opened on every system.
        let Ok(file) = File::open(path) else { return Ok(Self(None)) };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(WriteProblem::Busy),
            Err(TryLockError::Error(_)) => return Ok(Self(None)),
            Ok(()) => {}
        }
        let own = Handle::from_file(file)?;
        // Its last holder may have given it another name in between.
        match Handle::from_path(path) {
            Ok(there) if there == own => Ok(Self(Some(own))),
            _ => Err(WriteProblem::Busy),
        }
    }
}

/// A hidden file or directory of this process alone. What a killed one left in its place is cleared.
pub(super) struct Stage {
    path: PathBuf,
    moved: bool,
    _lock: Lock,
}

impl Stage {
    /// An empty directory.
    pub fn directory(path: PathBuf) -> Result<Self, WriteProblem> {
        let stage = Self::hold(path, |path| match fs::create_dir(path) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Ok(()),
            done => done,
        })?;
        for left in fs::read_dir(&stage.path)? {
            remove(&left?.path());
        }
        Ok(stage)
    }

    /// A file with these contents.
    pub fn file(path: PathBuf, contents: &[u8]) -> Result<Self, WriteProblem> {
        let create = |path: &Path| OpenOptions::new().write(true).create(true).truncate(false).open(path).map(drop);
        let stage = Self::hold(path, create)?;
        stage.write("", |out| Ok(out.write_all(contents)?))?;
        Ok(stage)
    }

    fn hold(path: PathBuf, create: impl FnOnce(&Path) -> io::Result<()>) -> Result<Self, WriteProblem> {
        let mut staged = staged();
        if path.is_symlink() {
            remove(&path);
        }
        create(&path)?;
        let lock = Lock::take(&path)?;
        staged.push(path.clone());
        Ok(Self { path, moved: false, _lock: lock })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file in it, or itself without a name, through to the disk.
    pub fn write(
        &self,
        name: &str,
        contents: impl FnOnce(&mut dyn Write) -> Result<(), WriteProblem>,
    ) -> Result<(), WriteProblem> {
        let path = if name.is_empty() { self.path.clone() } else { self.path.join(name) };
        let undisturbed = staged();
        let mut out = BufWriter::with_capacity(PIECE, Piecewise(File::create(path)?));
        drop(undisturbed);
        contents(&mut out)?;
        Ok(out.into_inner().map_err(io::IntoInnerError::into_error)?.0.sync_all()?)
    }

    /// Says in it that a name is to go, by a directory of that name.
    pub fn mark(&self, name: &str) -> io::Result<()> {
        let _undisturbed = staged();
        fs::create_dir(self.path.join(name))
    }

    /// Moves it into place, undisturbed by [`discard_staged`].
    pub fn commit(mut self, moves: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), WriteProblem> {
        let mut undisturbed = staged();
        let done = moves(&self.path);
        if done.is_ok() {
            // From now on its name may be another process'.
            undisturbed.retain(|path| *path != self.path);
            self.moved = true;
        }
        drop(undisturbed);
        Ok(done?)
    }
}

/// A staged file, of which each piece is written undisturbed by [`discard_staged`].
struct Piecewise(File);

impl Write for Piecewise {
    fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
        let _undisturbed = staged();
        self.0.write(piece)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        if !self.moved {
            staged().retain(|path| *path != self.path);
            remove(&self.path);
        }
    }
}
