//! Runs the firmware in QEMU and holds it to account.
//!
//! ```text
//! check result FILE          ε_xa that a program prints (firmware, or its output) against the host's f64
//! check cost DIR BUDGET        cost of the firmware in DIR against a budget and the table in docs/controller.md
//! check cost DIR BUDGET bless  the same, and writes the table
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
        ["cost", directory, budget] => cost::check(Path::new(directory), Path::new(budget), false),
        ["cost", directory, budget, "bless"] => cost::check(Path::new(directory), Path::new(budget), true),
        _ => Err("usage: check result FILE | check cost DIR BUDGET [bless]".to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("check: {why}");
            ExitCode::FAILURE
        }
    }
}
