//! Runs the firmware in QEMU and holds it to account.
//!
//! ```text
//! check result FILE      ε_xa printed by a program (FILE, or - for the firmware in QEMU) against the host's f64
//! check cost DIR         cost of the firmware in DIR against budget.toml and the table in docs/controller.md
//! check cost DIR bless   the same, and writes the table
//! ```

mod cost;
mod qemu;
mod result;

use std::{env, path::Path, process::ExitCode};

type Outcome = Result<(), String>;

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["result", file] => result::check(Path::new(file)),
        ["cost", directory] => cost::check(Path::new(directory), false),
        ["cost", directory, "bless"] => cost::check(Path::new(directory), true),
        _ => Err("usage: check result FILE | check cost DIR [bless]".to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("check: {why}");
            ExitCode::FAILURE
        }
    }
}
