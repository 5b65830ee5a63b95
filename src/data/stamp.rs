//! Which bytes an input had, so that it is known again: SHA-256, as `sha256sum` prints it.

use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Bytes read at once.
const BLOCK: usize = 1 << 16;

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
    pub fn of(mut source: impl Read) -> io::Result<Self> {
        let (mut hash, mut bytes, mut block) = (Sha256::new(), 0, vec![0; BLOCK]);
        loop {
            match source.read(&mut block)? {
                0 => break,
                read => {
                    hash.update(&block[..read]);
                    bytes += read as u64;
                }
            }
        }
        let sha256 = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { bytes, sha256 })
    }

    /// Of a file; none of a stream, which can be read only once, and of what cannot be read.
    pub fn of_file(file: &Path) -> Option<Self> {
        let is_file = file.metadata().is_ok_and(|there| there.is_file());
        is_file.then(|| Self::of(File::open(file).ok()?).ok()).flatten()
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
