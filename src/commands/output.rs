//! Standard output.

use super::Refused;
use std::io::{self, Write};

/// Writes a finished document to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<(), Refused> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(Refused::Output(e.kind())),
        _ => Ok(()),
    }
}
