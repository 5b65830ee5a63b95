//! What an import writes: in place of what it wrote before alone, and the whole set or nothing.

use super::{refused, succeeds};
use std::fs;
use std::path::Path;

fn table(at: &Path, name: &str, factor: f64) {
    let lines: String = (0..90).map(|i| format!("{};{}\n", i, f64::from(i % 7) * factor)).collect();
    fs::write(at.join(name), format!("a_deg;dr_um\n{}", lines.replace('.', ","))).unwrap();
}

fn names(at: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn earlier_imports_are_replaced_and_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    table(at, "one.csv", 1.5);
    table(at, "two.csv", 2.5);
    let text = succeeds(at, &["import", "one.csv", "--out", "runs"]);
    assert!(text.contains("one.csv\n  → runs/one-ccw.csv\n    run: CCW, 0° to 89°, 90 samples\n"), "{text}");
    let one = fs::read(at.join("runs/one-ccw.csv")).unwrap();
    // Another import into the same directory goes beside, the same one in its place.
    succeeds(at, &["import", "two.csv", "--out", "runs"]);
    assert_eq!(names(&at.join("runs")), ["one-ccw.csv", "one-ccw.svg", "two-ccw.csv", "two-ccw.svg"]);
    succeeds(at, &["import", "one.csv", "two.csv", "--out", "runs"]);
    assert_eq!(fs::read(at.join("runs/one-ccw.csv")).unwrap(), one, "the same file gives the same bytes");
    // What somebody has worked on is theirs.
    fs::write(at.join("runs/one-ccw.csv"), [one.as_slice(), b"90,1\n"].concat()).unwrap();
    refused(
        at,
        &["import", "one.csv", "--out", "runs"],
        &["runs/one-ccw.csv: this file is not one that was written here"],
    );
    succeeds(at, &["import", "one.csv", "--out", "runs", "--force"]);
    assert_eq!(fs::read(at.join("runs/one-ccw.csv")).unwrap(), one);
    // An output is never an input.
    table(at, "one-ccw.csv", 1.5);
    for force in [&[][..], &["--force"]] {
        let arguments = [&["import", "one.csv", "one-ccw.csv", "--out", "."], force].concat();
        refused(at, &arguments, &["one-ccw.csv: the command reads this file"]);
    }
    fs::create_dir(at.join("other")).unwrap();
    table(&at.join("other"), "one.csv", 3.5);
    refused(at, &["import", "one.csv", "other/one.csv", "--out", "new"], &["other/one.csv: another file of this name"]);
}

#[test]
fn a_fit_writes_all_that_is_asked_for_or_nothing() {
    let directory = super::reference("full");
    let at = directory.path();
    let fit = ["--run", "tilting=tilting.csv", "--run", "separation=separation.csv"];
    let fit = [&super::FIT[..], &fit, &super::TABLE].concat();
    let outputs =
        |report, csv, pictures| [&fit[..], &["--report", report, "--csv", csv, "--pictures", pictures]].concat();
    // Directories are made, with what they are in, but where one of all cannot be written.
    refused(at, &outputs("none/r.html", "new/c", "p"), &["none/r.html: cannot be written"]);
    refused(at, &outputs("r.html", "tilting.csv/c", "new/p"), &["tilting.csv/c: ", "expected a directory"]);
    refused(at, &outputs("r.html", "new/c", "tilting.csv/new/p"), &["tilting.csv/new/p: ", "expected a directory"]);
    refused(at, &outputs("tilting.csv", "c", "new/p"), &["tilting.csv: the command reads this file"]);
    assert!(["r.html", "c", "p", "new"].iter().all(|name| !at.join(name).exists()), "{:?}", names(at));
    succeeds(at, &outputs("r.html", "new/c", "p"));
    assert!(
        ["r.html", "new/c/eps_xa.csv", "p/eps_xa.svg"].iter().all(|file| at.join(file).is_file()),
        "{:?}",
        names(at)
    );
}

#[test]
fn what_a_file_says_is_no_line_of_its_own() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let readings: Vec<f64> = (0..=36).map(|i| 0.003 * (f64::from(i) * 20.0).to_radians().cos()).collect();
    let features = vec![("AF_CIRCULARITY\n9,9", "UT_LENGTH_MM", 0.006)];
    let runs = [super::b5r::Run { direction: "CCW", readings, features }];
    let text = super::b5r::document("360deg&#10;1,2&#13;3,4\n", "XY", 150.0, &runs).replace("Jörg", "x&#10;5,6\n7,8");
    fs::write(at.join("evil\n0,1.b5r"), text).unwrap();
    succeeds(at, &["import", "evil\n0,1.b5r", "--out", "runs", "--unit", "mm"]);
    let written = fs::read_to_string(at.join("runs/evil\n0,1-ccw.csv")).unwrap();
    let lines = written.lines().filter(|line| !line.starts_with('#'));
    assert_eq!(lines.count(), 38, "{written}");
}
