//! One module per command, and what they share.

pub mod demo;
pub mod derive;
pub mod exechon;
pub mod fit;
pub mod monte_carlo;
pub mod plan;
pub mod simulate;

mod document;
mod model;
mod predicted;
mod refused;
mod simulated;

pub use refused::Refused;

use std::io::{self, Write};

/// `NAME=…` as its two parts.
fn pair(given: &str) -> Option<(&str, &str)> {
    given.split_once('=')
}

/// Writes a finished document to standard output; a reader that has gone away is no error.
fn print(text: &str) -> Result<(), Refused> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(Refused::Output(e.kind())),
        _ => Ok(()),
    }
}
