//! Files of instruments and of other programs: what is read of them, what is refused, and that a fit is the same by every way.

mod b5r;
mod bad;
mod dialects;
#[path = "../program/mod.rs"]
mod program;
mod written;

use program::{succeeds, trunnion};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn object(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// Exit code 2, nothing on standard output, nothing written, and all of this in the message.
fn refused(directory: &Path, arguments: &[&str], told: &[&str]) {
    let before = fs::read_dir(directory).unwrap().count();
    let output = trunnion(directory, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(output.stdout.is_empty() && said.contains("error: ") && said.len() < 2000, "{arguments:?}: {said}");
    told.iter().for_each(|told| assert!(said.contains(told), "{arguments:?}: {said} without {told}"));
    assert_eq!(fs::read_dir(directory).unwrap().count(), before, "{arguments:?}: something is left behind");
}

const MODEL: &str = "tilting-table-a";
const FIT: [&str; 5] = ["fit", MODEL, "--radius", "150", "--json"];
const TABLE: [&str; 2] = ["--table", "table.csv"];

/// A directory with the native files of a set of the reference.
fn reference(set: &str) -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/tilting-table").join(set);
    for file in ["tilting.csv", "separation.csv", "table.csv"] {
        fs::copy(from.join(file), directory.path().join(file)).unwrap();
    }
    directory
}

/// Angle and reading of each sample, as the text of the file has them: degrees and µm.
fn samples(file: &Path) -> Vec<(String, String)> {
    let text = fs::read_to_string(file).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let pair = |line: &str| line.split_once(',').map(|(a, r)| (a.to_owned(), r.to_owned()));
    lines.filter_map(pair).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// The fit of two files.
fn fitted(directory: &Path, [tilting, separation]: [&str; 2], more: &[&str]) -> Value {
    let runs = [format!("tilting={tilting}"), format!("separation={separation}")];
    let runs = ["--run", &runs[0], "--run", &runs[1]];
    object_of_fit(directory, &[&FIT[..], &runs, &TABLE, more].concat())
}

/// What a fit prints, but for which files it was made of.
fn object_of_fit(directory: &Path, arguments: &[&str]) -> Value {
    let mut fit = object(&succeeds(directory, arguments));
    fit.as_object_mut().unwrap().remove("made");
    fit
}

/// Holds every number of two fits to agree to this share of itself; what is zero but for rounding agrees.
fn alike(one: &Value, other: &Value, share: f64) {
    match (one, other) {
        (Value::Object(a), Value::Object(b)) => {
            assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
            a.iter().for_each(|(key, value)| alike(value, &b[key], share));
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len());
            a.iter().zip(b).for_each(|(a, b)| alike(a, b, share));
        }
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            assert!((a - b).abs() <= (share * a.abs().max(b.abs())).max(1e-13), "{a} {b}");
        }
        (a, b) => assert_eq!(a, b),
    }
}
