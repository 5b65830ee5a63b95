//! A measurement described by a project file, with the program as its user meets it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

fn trunnion(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trunnion")).current_dir(directory).args(arguments).output().unwrap()
}

fn succeeds(directory: &Path, arguments: &[&str]) -> String {
    let output = trunnion(directory, arguments);
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {told}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(directory: &Path, arguments: &[&str]) -> String {
    let output = trunnion(directory, arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

const PROJECT: &str = "\
model = \"tilting-table-a\"

[lengths]
R_mm = 100

[limits]
angle_urad = 50

[instrument]
preset = \"QC20-W\"

[axis.A]
range = [-30, 120]

[fit]
estimator = \"two-step\"
table = \"readings/table.csv\"

[run.tilting]
files = [\"readings/tilting.csv\"]
weight = 2

[run.separation]
files = [\"readings/separation.csv\"]
";

const OPTIONS: [&str; 20] = [
    "fit",
    "tilting-table-a",
    "--radius",
    "100",
    "--angle-urad",
    "50",
    "--instrument",
    "QC20-W",
    "--estimator",
    "two-step",
    "--table",
    "readings/table.csv",
    "--run",
    "tilting=readings/tilting.csv",
    "--weight",
    "tilting=2",
    "--run",
    "separation=readings/separation.csv",
    "--weight",
    "separation=1",
];

fn project() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("trunnion.toml"), PROJECT).unwrap();
    succeeds(directory.path(), &["simulate", "--out", "readings"]);
    directory
}

#[test]
fn without_options_a_project_is_fitted_as_with_them() {
    let directory = project();
    let readings = fs::read_to_string(directory.path().join("readings/tilting.csv")).unwrap();
    let angles: Vec<f64> = readings.lines().filter_map(|line| line.split(',').next()?.parse().ok()).collect();
    assert!(angles.iter().all(|a| (-30.0..=120.0).contains(a)), "the axis' range is the project's");
    let fitted = succeeds(directory.path(), &["fit"]);
    assert_eq!(fitted, succeeds(directory.path(), &OPTIONS));
    // From elsewhere its files are where it is; by its folder as by its name.
    let elsewhere = tempfile::tempdir().unwrap();
    let (folder, file) = (directory.path().to_str().unwrap(), directory.path().join("trunnion.toml"));
    assert_eq!(fitted, succeeds(elsewhere.path(), &["fit", folder]));
    assert_eq!(fitted, succeeds(elsewhere.path(), &["fit", file.to_str().unwrap()]));
    // An option is put over it.
    assert_ne!(fitted, succeeds(directory.path(), &["fit", "--estimator", "joint"]));
    assert!(succeeds(directory.path(), &["derive"]).contains("tilting-table-a"));
}

#[test]
fn runs_that_are_given_stand_alone() {
    let directory = project();
    let out = trunnion(directory.path(), &["fit", "--estimator", "joint", "--run", "tilting=readings/tilting.csv"]);
    let told = String::from_utf8(out.stderr).unwrap();
    assert!(told.contains("fitted without separation"), "{told}");
}

#[test]
fn what_is_wrong_is_told_where_it_is() {
    let directory = project();
    let cases = [
        ("R_mm = 100", "R_mm = \"long\"", "trunnion.toml:4:8"),
        ("[axis.A]", "[axis.Q]", "trunnion.toml:12:7"),
        ("angle_urad = 50", "nothing_urad = 50", "trunnion.toml:7:1"),
        ("weight = 2", "weight = 0", "trunnion.toml: line 21: weight = 0.0"),
        ("estimator = \"two-step\"", "estimator = \"both\"", "trunnion.toml: line 16: unknown variant"),
        ("[run.separation]", "[run.other]", "the model has no run `other`"),
        ("tilting.csv", "absent.csv", "readings/absent.csv: "),
        ("model = \"tilting-table-a\"", "model = \"no-table\"", "no model `no-table`"),
    ];
    for (right, wrong, told) in cases {
        fs::write(directory.path().join("trunnion.toml"), PROJECT.replace(right, wrong)).unwrap();
        let message = refused(directory.path(), &["fit"]);
        assert!(message.contains(told), "{wrong}: {message}");
    }
    let empty = tempfile::tempdir().unwrap();
    assert!(refused(empty.path(), &["fit"]).contains("no MODEL, and no trunnion.toml in this folder"));
    assert!(refused(empty.path(), &["fit", "tilting-table-a"]).contains("no run"));
}
