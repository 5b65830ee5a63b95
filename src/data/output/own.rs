//! Which files are earlier results, and may be replaced by new ones.
//!
//! A picture says itself that Trunnion drew it. Measurement files cannot: a simulated one looks like a real one, which must not
//! be lost. So `truth.json` lists the files that were written with it, each with a digest; one that was changed since is none of
//! them. An imported one has its digest in its first line: somebody may have gone on working on it.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use crate::data::limits::RESULT;
use crate::plot::MADE;

/// The file that lists those written with it.
pub(in crate::data) const INDEX: &str = "truth.json";

/// The key of the list in it.
pub(in crate::data) const LISTED: &str = "files";

/// The beginning of an imported file; its digest and the end of the line follow.
const SEAL: &str = "# imported by trunnion, digest of what follows ";

/// The contents of a file below their digest.
pub(in crate::data) fn sealed(contents: &[u8]) -> Vec<u8> {
    [format!("{SEAL}{}\n", digest(contents)).as_bytes(), contents].concat()
}

/// Whether contents are as they were sealed.
fn is_sealed(contents: &[u8]) -> bool {
    let line = contents.strip_prefix(SEAL.as_bytes());
    let parts = line.and_then(|rest| Some(rest.split_at(rest.iter().position(|byte| *byte == b'\n')?)));
    parts.is_some_and(|(sealed, rest)| rest.get(1..).is_some_and(|rest| digest(rest).as_bytes() == sealed))
}

/// FNV-1a of 64 bits: tells a changed file, and need not withstand an attack.
pub(super) struct Digest(u64);

impl Digest {
    pub fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub fn add(&mut self, contents: &[u8]) {
        let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 = contents.iter().fold(self.0, step);
    }

    /// In hexadecimal.
    pub fn text(&self) -> String {
        format!("{:016x}", self.0)
    }
}

impl Write for Digest {
    fn write(&mut self, contents: &[u8]) -> io::Result<usize> {
        self.add(contents);
        Ok(contents.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn digest(contents: &[u8]) -> String {
    let mut digest = Digest::new();
    digest.add(contents);
    digest.text()
}

/// What an output is to replace, or its beginning: a longer file is no earlier result, and need not fill the memory.
fn contents(file: &Path) -> io::Result<Vec<u8>> {
    let mut contents = Vec::new();
    File::open(file)?.take(RESULT).read_to_end(&mut contents)?;
    Ok(contents)
}

/// The files of a directory that its index lists, with their digests, and the index itself.
#[derive(Default)]
pub(super) struct Listed(BTreeMap<String, Option<String>>);

impl Listed {
    /// Of a directory; nothing where it has no such index.
    pub fn of(directory: &Path) -> Self {
        let index = contents(&directory.join(INDEX)).ok();
        let index: Option<serde_json::Value> = index.and_then(|text| serde_json::from_slice(&text).ok());
        let Some(files) = index.as_ref().and_then(|index| index.get(LISTED)?.as_object()) else {
            return Self::default();
        };
        let digest = |(name, digest): (&String, &serde_json::Value)| (name.clone(), digest.as_str().map(str::to_owned));
        Self(files.iter().map(digest).chain([(INDEX.to_owned(), None)]).collect())
    }

    /// Whether the index has a name, or is it.
    pub fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Whether a file of a name is an earlier result.
    pub fn is_own(&self, name: &str, file: &Path) -> io::Result<bool> {
        let listed = match self.0.get(name) {
            None => false,
            Some(None) => true,
            Some(Some(own)) => {
                let mut digest = Digest::new();
                io::copy(&mut File::open(file)?, &mut digest)?;
                digest.text() == *own
            }
        };
        Ok(listed || says_so(file)?)
    }
}

/// Whether a file says itself that it is an earlier result; an empty one has nothing to lose.
pub(super) fn says_so(file: &Path) -> io::Result<bool> {
    let contents = &contents(file)?;
    let head = &contents[..contents.len().min(256)];
    Ok(contents.is_empty() || is_sealed(contents) || head.windows(MADE.len()).any(|part| part == MADE.as_bytes()))
}
