//! Which bytes an input had, so that it is known again: SHA-256, as `sha256sum` prints it.

use sha2::{Digest, Sha256};
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::rc::Rc;

/// Length and digest of an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Its length in bytes.
    pub bytes: u64,
    /// Its SHA-256 in hexadecimal.
    pub sha256: String,
}

impl Stamp {
    /// Of everything that can be read.
    ///
    /// # Errors
    /// What cannot be read.
    pub fn of(source: impl Read) -> io::Result<Self> {
        let stamping = Stamping::default();
        io::copy(&mut stamping.reader(source), &mut io::sink())?;
        Ok(stamping.stamp())
    }

    /// Of a file; none of a stream, which can be read only once, and of what cannot be read.
    pub fn of_file(file: &Path) -> Option<Self> {
        let is_file = file.metadata().is_ok_and(|there| there.is_file());
        is_file.then(|| Self::of(File::open(file).ok()?).ok()).flatten()
    }
}

/// A stamp of what goes through its readers.
#[derive(Clone, Default)]
pub(crate) struct Stamping(Rc<RefCell<(Sha256, u64)>>);

impl Stamping {
    /// Stamps what is read.
    pub fn reader<R: Read>(&self, source: R) -> Stamped<R> {
        Stamped { source, stamping: self.clone() }
    }

    /// The stamp of what has been read.
    pub fn stamp(&self) -> Stamp {
        let (hash, bytes) = &*self.0.borrow();
        let sha256 = hash.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Stamp { bytes: *bytes, sha256 }
    }
}

/// A source that is stamped while it is read.
pub(crate) struct Stamped<R> {
    source: R,
    stamping: Stamping,
}

impl<R: Read> Read for Stamped<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        let (hash, bytes) = &mut *self.stamping.0.borrow_mut();
        hash.update(&buffer[..read]);
        *bytes += read as u64;
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4, appendix examples.
    #[test]
    fn the_examples_of_the_standard() {
        let of = |text: &[u8]| Stamp::of(text).unwrap();
        assert_eq!(of(b"abc").sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        let million = of(&vec![b'a'; 1_000_000]);
        assert_eq!(million.sha256, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
        assert_eq!(million.bytes, 1_000_000);
    }
}
