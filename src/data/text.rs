//! Text files, in whatever encoding people's editors write them.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use thiserror::Error;

use super::limits::{RESULT, TEXT};

/// Why a file is no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TextError {
    /// The operating system refuses.
    #[error("cannot be read: {0}")]
    Unreadable(io::ErrorKind),
    /// More than so many bytes.
    #[error("more than {0} bytes\n  expected a text of that size at most: is this the right file?")]
    TooLong(u64),
    /// An encoding that is not read, with the line of the first character that is not ASCII.
    #[error("line {line}: not UTF-8 text but {encoding}\n  save the file as plain text in UTF-8")]
    Encoding {
        /// Counted from 1.
        line: usize,
        /// What it looks like.
        encoding: Encoding,
    },
}

/// What bytes that are not UTF-8 look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Encoding {
    /// With a byte order mark, or with a zero in each letter.
    #[error("UTF-16")]
    Utf16,
    /// Of one byte a letter.
    #[error("Latin-1 or another code of one byte a letter")]
    Latin,
}

impl Encoding {
    /// Of bytes from the beginning of a file or line; none of UTF-8.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some(Self::Utf16),
            _ if bytes.contains(&0) => Some(Self::Utf16),
            _ => str::from_utf8(bytes).is_err().then_some(Self::Latin),
        }
    }
}

/// Reads a text that a program wrote, as [`read_text`]; at most [`RESULT`] bytes.
///
/// # Errors
/// [`TextError`]
pub fn read_document(file: &Path) -> Result<String, TextError> {
    read(file, RESULT)
}

/// Reads a text file; a byte order mark and Windows line ends are none of its text.
///
/// # Errors
/// [`TextError`]
pub fn read_text(file: &Path) -> Result<String, TextError> {
    read(file, TEXT as u64)
}

fn read(file: &Path, most: u64) -> Result<String, TextError> {
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|file| file.take(most + 1).read_to_end(&mut bytes));
    read.map_err(|e| TextError::Unreadable(e.kind()))?;
    if bytes.len() as u64 > most {
        return Err(TextError::TooLong(most));
    }
    if let Some(encoding) = Encoding::of(&bytes) {
        let good = str::from_utf8(&bytes).map_or_else(|e| e.valid_up_to(), |_| 0);
        let line = 1 + bytes.iter().take(good).filter(|byte| **byte == b'\n').count();
        return Err(TextError::Encoding { line, encoding });
    }
    let text = String::from_utf8_lossy(&bytes);
    Ok(text.trim_start_matches('\u{feff}').replace("\r\n", "\n"))
}
