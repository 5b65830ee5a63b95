//! A set of files in a directory: complete or absent, whenever the process ends.
//!
//! A directory that is new or holds nothing but earlier results is written beside and takes the name as a whole: the earlier one
//! is set aside first, so that whoever looks finds all of the old files, none, or all of the new ones.
//!
//! A directory that has other files, or in which somebody works (the current one), stays. Files are staged within it and moved one
//! after the other; a process that is killed between two moves leaves the rest staged, and the next run moves them first.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Guard;
use super::error::{WriteError, WriteProblem};
use super::own::{Digest, INDEX, Listed};
use super::place::{beside, followed};
use super::stage::{Lock, Stage, remove};

/// Files staged within their directory, and files that are being moved from there.
const WITHIN: &str = ".trunnion";
const MOVING: &str = ".trunnion-moving";

/// Files that belong together, by name.
#[derive(Default)]
pub struct Files<'a> {
    contents: BTreeMap<String, Contents<'a>>,
    index: Option<Box<Index<'a>>>,
}

/// What a file is to have.
enum Contents<'a> {
    Bytes(Vec<u8>),
    Stream(Box<Stream<'a>>),
}

type Stream<'a> = dyn Fn(&mut dyn Write) -> Result<(), WriteProblem> + 'a;
type Index<'a> = dyn Fn(&BTreeMap<String, String>) -> Result<Vec<u8>, WriteProblem> + 'a;

impl<'a> Files<'a> {
    /// Adds one.
    pub fn add(&mut self, name: impl Into<String>, contents: impl Into<Vec<u8>>) {
        self.contents.insert(name.into(), Contents::Bytes(contents.into()));
    }

    /// Adds one whose contents are made while they are written, perhaps more than once.
    pub fn stream(
        &mut self,
        name: impl Into<String>,
        contents: impl Fn(&mut dyn Write) -> Result<(), WriteProblem> + 'a,
    ) {
        self.contents.insert(name.into(), Contents::Stream(Box::new(contents)));
    }

    /// Adds the file that lists all others, of their names and digests.
    pub(in crate::data) fn index(
        &mut self,
        contents: impl Fn(&BTreeMap<String, String>) -> Result<Vec<u8>, WriteProblem> + 'a,
    ) {
        self.index = Some(Box::new(contents));
    }

    /// What is in one; nothing where it is made while it is written.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        match self.contents.get(name)? {
            Contents::Bytes(bytes) => Some(bytes),
            Contents::Stream(_) => None,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.names().next().is_none()
    }

    /// What they are called.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.contents.keys().map(String::as_str).chain(self.index.as_ref().map(|_| INDEX))
    }

    fn has(&self, name: &str) -> bool {
        self.names().any(|own| own == name)
    }

    /// Writes them all or none into a directory, in place of what an earlier run wrote there.
    ///
    /// # Errors
    /// [`WriteError`] where the directory cannot be written or another process writes it; where a file is in the way that is no
    /// earlier result.
    pub fn write(&self, directory: &Path, guard: &Guard) -> Result<(), WriteError> {
        let (out, earlier, _lock) = self.admitted(directory, guard)?;
        self.put(&out, &earlier).map_err(|problem| WriteError { file: directory.to_owned(), problem })
    }

    /// Whether they can be written, before anything is.
    ///
    /// # Errors
    /// As [`Files::write`].
    pub fn admit(&self, directory: &Path, guard: &Guard) -> Result<(), WriteError> {
        let staged = match missing_in(directory) {
            // What it is in is made when it is written, and nothing is there to be replaced.
            Some(there) if !there.is_dir() => Err(WriteProblem::Directory(io::ErrorKind::NotADirectory)),
            Some(there) => Stage::directory(there.join(WITHIN)).map(drop),
            None => {
                let (out, ..) = self.admitted(directory, guard)?;
                let within = |refused| if out.exists() { Stage::directory(out.join(WITHIN)) } else { Err(refused) };
                Stage::directory(beside(&out, "")).or_else(within).map(drop)
            }
        };
        staged.map_err(|problem| WriteError { file: directory.to_owned(), problem })
    }

    /// The directory, held, and what it has before, all of which may be replaced.
    fn admitted(&self, directory: &Path, guard: &Guard) -> Result<(PathBuf, Earlier, Lock), WriteError> {
        let failed = |problem| WriteError { file: directory.to_owned(), problem };
        let out = resolved(directory).map_err(failed)?;
        let lock = Lock::take(&out).map_err(failed)?;
        let earlier = finish(&out).and_then(|()| Earlier::of(&out, self)).map_err(|e| failed(e.into()))?;
        for name in self.names().chain(earlier.own.iter().map(String::as_str)) {
            // A link that leads to an earlier result is not among those of the directory.
            let own = |file: &Path| Ok(earlier.own.iter().any(|own| own == name) || earlier.listed.is_own(name, file)?);
            let allowed = guard.allows(&out.join(name), own);
            allowed.map_err(|problem| WriteError { file: directory.join(name), problem })?;
        }
        Ok((out, earlier, lock))
    }

    fn put(&self, out: &Path, earlier: &Earlier) -> Result<(), WriteProblem> {
        let work_here = std::env::current_dir().is_ok_and(|here| here.starts_with(out));
        if out.exists() && (earlier.others || work_here) {
            return self.one_by_one(out, earlier);
        }
        match self.as_a_whole(out) {
            // A place for it beside may not be had, or the directory be where another disk is mounted.
            Err(problem) if out.exists() && problem != WriteProblem::Busy => self.one_by_one(out, earlier),
            done => done,
        }
    }

    fn as_a_whole(&self, out: &Path) -> Result<(), WriteProblem> {
        let staged = Stage::directory(beside(out, ""))?;
        let aside = beside(out, "-old");
        // Left by a process that was killed between the two moves below, or after them.
        if out.exists() || fs::rename(&aside, out).is_err() {
            remove(&aside);
        }
        self.write_into(&staged)?;
        if let Ok(before) = fs::metadata(out) {
            fs::set_permissions(staged.path(), before.permissions())?;
        }
        staged.commit(|staged| {
            if out.exists() {
                fs::rename(out, &aside)?;
            }
            fs::rename(staged, out).inspect_err(|_| drop(fs::rename(&aside, out)))?;
            remove(&aside);
            Ok(())
        })
    }

    fn one_by_one(&self, out: &Path, earlier: &Earlier) -> Result<(), WriteProblem> {
        let staged = Stage::directory(out.join(WITHIN))?;
        self.write_into(&staged)?;
        // Earlier results without a successor.
        for name in earlier.own.iter().filter(|name| !self.has(name)) {
            staged.mark(name)?;
        }
        staged.commit(|staged| {
            fs::rename(staged, out.join(MOVING))?;
            finish(out)
        })
    }

    fn write_into(&self, staged: &Stage) -> Result<(), WriteProblem> {
        let mut digests = BTreeMap::new();
        for (name, contents) in &self.contents {
            let mut digest = Digest::new();
            staged.write(name, |out| {
                let mut both = Both(out, &mut digest);
                match contents {
                    Contents::Bytes(bytes) => Ok(both.write_all(bytes)?),
                    Contents::Stream(stream) => stream(&mut both),
                }
            })?;
            digests.insert(name.clone(), digest.text());
        }
        match &self.index {
            Some(index) => staged.write(INDEX, |out| Ok(out.write_all(&index(&digests)?)?)),
            None => Ok(()),
        }
    }
}

/// Writes to a file and to its digest.
struct Both<'a>(&'a mut dyn Write, &'a mut Digest);

impl Write for Both<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.0.write(bytes)?;
        self.1.add(bytes.get(..written).unwrap_or(bytes));
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Moves what is staged for it into a directory.
fn finish(out: &Path) -> io::Result<()> {
    let moving = out.join(MOVING);
    let Ok(entries) = fs::read_dir(&moving) else { return Ok(()) };
    for entry in entries {
        let entry = entry?;
        let to = out.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            remove(&to);
            continue;
        }
        // A link stays one. It may lead to another disk.
        let to = fs::canonicalize(&to).unwrap_or(to);
        fs::rename(entry.path(), &to).or_else(|_| fs::copy(entry.path(), &to).map(drop))?;
    }
    fs::remove_dir_all(moving)
}

/// What a directory has before.
struct Earlier {
    listed: Listed,
    /// Earlier results.
    own: Vec<String>,
    /// Whether there is anything else, or a link, which is somebody's own.
    others: bool,
}

impl Earlier {
    fn of(out: &Path, files: &Files<'_>) -> io::Result<Self> {
        // Files that have no index replace none that has one.
        let listed = if files.index.is_some() { Listed::of(out) } else { Listed::default() };
        let mut earlier = Self { listed, own: Vec::new(), others: false };
        for entry in fs::read_dir(out).into_iter().flatten() {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let candidate = entry.file_type()?.is_file() && (files.has(&name) || earlier.listed.has(&name));
            if candidate && earlier.listed.is_own(&name, &entry.path())? {
                earlier.own.push(name);
            } else if name != WITHIN {
                earlier.others = true;
            }
        }
        Ok(earlier)
    }
}

/// The nearest of the directories above one that is there, if that is not the one that it is in.
fn missing_in(directory: &Path) -> Option<&Path> {
    let mut above = directory.ancestors().skip(1).filter(|above| !above.as_os_str().is_empty());
    if above.next().is_none_or(Path::exists) {
        return None;
    }
    Some(above.find(|above| above.exists()).unwrap_or(Path::new(".")))
}

/// The directory that a name leads to, made but for itself.
fn resolved(directory: &Path) -> Result<PathBuf, WriteProblem> {
    let made = |directory: &Path| {
        fs::create_dir_all(directory).map_err(|e| {
            // What the operating system calls this, "already exists", leads nowhere.
            let kind = if directory.is_file() { io::ErrorKind::NotADirectory } else { e.kind() };
            WriteProblem::Directory(kind)
        })
    };
    if let Some(parent) = directory.parent().filter(|parent| !parent.as_os_str().is_empty()) {
        made(parent)?;
    }
    let out = followed(directory)?;
    match out.exists() && !out.is_dir() {
        true => Err(WriteProblem::Directory(io::ErrorKind::NotADirectory)),
        false => Ok(out),
    }
}
