//! The program as a user calls it.

use std::path::Path;
use std::process::{Command, Output};

/// Runs it in a directory, so that messages name files without it.
pub fn trunnion(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trunnion")).current_dir(directory).args(arguments).output().unwrap()
}

/// Standard output of a run that has to succeed.
pub fn succeeds(directory: &Path, arguments: &[&str]) -> String {
    let output = trunnion(directory, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}
