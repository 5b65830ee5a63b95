//! Bad files: each refused by its name, with its line and what was expected.

use super::b5r::{Run, document};
use super::refused;
use std::fmt::Write;
use std::fs;

/// A whole turn of an oval, 6 µm wide, in mm.
fn turn() -> Vec<f64> {
    (0..=360).map(|i| 0.003 * (2.0 * f64::from(i).to_radians()).cos()).collect()
}

fn features() -> Vec<(&'static str, &'static str, f64)> {
    vec![("AF_CIRCULARITY", "UT_LENGTH_MM", 0.006)]
}

fn test_of(name: &str, features: Vec<(&str, &str, f64)>) -> String {
    document(name, "XY", 150.0, &[Run { direction: "CCW", readings: turn(), features }])
}

fn good() -> String {
    test_of("XY 360deg 150mm", features())
}

#[test]
fn bad_tests_are_refused_by_name() {
    let laughs = "<!DOCTYPE t [\n<!ENTITY a \"ha\">\n<!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">\n]>\n<TEST_DOCUMENT>&b;</TEST_DOCUMENT>";
    let cut = good();
    let attributes: String = (0..2000).map(|i| format!(" a{i}='>'")).collect();
    let features = |unit, value| test_of("XY 360deg", vec![("AF_CIRCULARITY", unit, value)]);
    let files: Vec<(&str, String, &str)> = vec![
        ("truncated", cut[..cut.len() / 2].to_owned(), "expected a whole XML file"),
        ("truncated within a tag", cut[..120].to_owned(), "expected a whole XML file"),
        ("no end", cut.replace("</TEST_DOCUMENT>", ""), "expected a whole XML file"),
        ("entities", laughs.to_owned(), "bad.b5r:2: declares an entity"),
        (
            "another file",
            "<?xml version='1.0'?>\n<svg><a/></svg>".to_owned(),
            "bad.b5r:2: the file of another program: its first element is <svg>",
        ),
        ("no runs", cut.replace("BALLBAR_RUN", "OTHER"), "no run in this test"),
        ("no readings", cut.replace("READINGS", "OTHER"), "bad.b5r:15: run 1 has no READINGS"),
        ("no direction", cut.replace("RUN_DIRECTION", "OTHER"), "bad.b5r:15: RUN_DIRECTION \"\""),
        ("wrong direction", cut.replace("CCW", "up"), "bad.b5r:16: RUN_DIRECTION \"up\""),
        (
            "text in readings",
            cut.replacen("0.0030000000 ", "0.003.0 ", 1),
            "bad.b5r:17: \"0.003.0\" in READINGS is not a number",
        ),
        ("not finite", cut.replacen("0.0030000000 ", "NaN ", 1), "bad.b5r:17: \"NaN\" in READINGS"),
        (
            "few readings",
            cut.replacen("<READINGS>", "<READINGS>1 2 3</READINGS><X>", 1).replacen("</READINGS>\n", "</X>\n", 1),
            "a run of 3 readings",
        ),
        (
            "no plane",
            cut.replace("TEST_PLANE=\"XY\"", "TEST_PLANE=\"XQ\""),
            "bad.b5r:8: test plane \"XQ\"\n  expected two of X, Y and Z",
        ),
        (
            "wrong plane",
            cut.replace("TEST_PLANE=\"XY\"", "TEST_PLANE=\"YZ\""),
            "bad.b5r:8: test plane YZ with the axes X and Y",
        ),
        ("length in words", cut.replace(">150<", ">long<"), "bad.b5r:6: \"long\" in NOMINAL_LENGTH"),
        ("length of no bar", cut.replace(">150<", ">-150<"), "bad.b5r:6: NOMINAL_LENGTH -150 mm"),
        ("unknown unit", features("UT_LENGTH_INCH", 0.006), "bad.b5r:18: AF_CIRCULARITY in \"UT_LENGTH_INCH\""),
        ("circularity in words", cut.replace(">0.006<", ">good<"), "bad.b5r:18: \"good\" in FEATURE"),
        (
            "unit not conclusive",
            features("UT_LENGTH_MM", 0.1),
            "bad.b5r:17: the unit of the readings is not in the file, and a circularity of 0.0060",
        ),
        (
            "no circularity",
            test_of("XY 360deg", Vec::new()),
            "no run has an AF_CIRCULARITY to compare with\n  expected it to be stated: mm or um (--unit mm or --unit um)",
        ),
        (
            "no arc",
            test_of("50mm XY 1500", self::features()),
            "bad.b5r:3: where the readings begin and end is not in the file",
        ),
        ("short arc", test_of("90grad", self::features()), "may begin anywhere"),
        ("another view", cut.replace("VIEW=\"+A+B\"", "VIEW=\"-A+B\""), "the plane is seen as \"-A+B\""),
        (
            "a long tag",
            cut.replace("<FUTURE a=\"1\">", &format!("<FUTURE{attributes}>")),
            "bad.b5r:4: a tag of more than 4096 bytes",
        ),
        (
            "namespaces",
            cut.replace("<DEEP/>", &(0..100).map(|i| format!("<D xmlns:n{i}='{i}'/>")).collect::<String>()),
            "more than 64 namespaces",
        ),
        ("many elements", cut.replace("<DEEP/>", &"<DEEP/>".repeat(30_000)), "more than 20000 elements"),
        ("deep", cut.replace("<DEEP/>", &("<D>".repeat(9000) + &"</D>".repeat(8999))), "expected a whole XML file"),
        (
            "many readings",
            cut.replacen("<READINGS>", &format!("<READINGS>{}", "0 ".repeat(300_000)), 1),
            "more than 300000 readings",
        ),
        ("huge", cut.replace("<DEEP/>", &" ".repeat(1 << 24)), "bad.b5r: more than 16777216 bytes"),
    ];
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for (kind, text, told) in files {
        fs::write(at.join("bad.b5r"), text).unwrap();
        refused(at, &["import", "bad.b5r", "--out", "new"], &[told, "\n  expected"]);
        refused(at, &["fit", super::MODEL, "--run", "tilting=bad.b5r"], &[told.split(" (--").next().unwrap()]);
        assert!(!at.join("new").exists(), "{kind}");
    }
    fs::write(at.join("good.b5r"), good()).unwrap();
    refused(at, &["import", "good.b5r", "--out", "new", "--columns", "a=x"], &["--columns", "no file needs it"]);
    refused(at, &["import", "good.b5r", "--out", "new", "--plane", "ZX"], &["good.b5r:8: test plane XY", "plane ZX"]);
    super::succeeds(at, &["import", "good.b5r", "--out", "new"]);
}

#[test]
fn bad_tables_are_refused_by_name() {
    let rows = |line: &dyn Fn(i32) -> String| (0..20).map(|i| line(i) + "\n").collect::<String>();
    let table = |header: &str, line: &dyn Fn(i32) -> String| format!("{header}\n{}", rows(line));
    let turning = table("a_deg,dr_um", &|i| format!("{},{i}.5", 100 - (i - 14).abs() * 5));
    let files: Vec<(&str, String, &str)> = vec![
        (
            "ambiguous",
            table("a_deg,dr_um|x", &|i| format!("{i},1|x")),
            "t.csv:1: fields may be separated by commas or by vertical bars",
        ),
        (
            "unknown unit",
            table("a [deg];dr [inch]", &|i| format!("{i};1,5")),
            "t.csv:1: column \"dr [inch]\" has a unit that does not fit\n  expected dr_um or dr_mm",
        ),
        ("no unit", table("a [deg];dr", &|i| format!("{i};1,5")), "t.csv:1: column \"dr\" has no unit"),
        (
            "header far below",
            "text\n".repeat(300) + &table("a_deg,dr_um", &|i| format!("{i},1")),
            "t.csv:1: unknown column \"text\"",
        ),
        (
            "mixed decimals",
            table("a_deg;dr_um", &|i| format!("{i},5;{i}.5")),
            "t.csv:2: \"0.5\" in column dr_um has another decimal sign",
        ),
        (
            "thousands",
            table("a_deg;dr_um", &|i| format!("{i};1.000,5")),
            "t.csv:2: \"1.000,5\" in column dr_um is not a number",
        ),
        (
            "decimal commas",
            table("a_deg,dr_um", &|i| format!("{i},5,1,5")),
            "4 fields in a file of 2 columns: decimal commas?",
        ),
        ("too few of one way", turning, "t.csv:17: a run of 5 readings"),
        ("beyond the stroke", table("a_deg,dr_mm", &|i| format!("{i},150")), "beyond the stroke of a ball-bar"),
        (
            "words below the table",
            table("a_deg,dr_um", &|i| format!("{i},1")) + "END OF MEASUREMENT\nOperator,Joe\n",
            "t.csv:22: \"END OF MEASUREMENT\" has no number\n  expected 2 numbers: delete the line, or begin it with #",
        ),
        ("not text", "a_deg,dr_um\n0,1\n\0\n".to_owned(), "t.csv:3: this is not text"),
    ];
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for (kind, text, told) in files {
        fs::write(at.join("t.csv"), text).unwrap();
        refused(at, &["import", "t.csv", "--out", "new"], &[told, "\n  expected"]);
        assert!(!at.join("new").exists(), "{kind}");
    }
    let mut named = String::from("Angle [deg];Radius\n");
    (0..20).for_each(|i| writeln!(named, "{i};1,5").unwrap());
    fs::write(at.join("t.csv"), named).unwrap();
    let import = |columns| ["import", "t.csv", "--out", "new", "--columns", columns];
    refused(
        at,
        &import("a=Angle [deg],dr=Radius"),
        &["column \"Radius\" has no unit that is known", "dr_um or dr_mm in place of dr"],
    );
    refused(at, &import("a=Winkel,dr_um=Radius"), &["missing column Winkel\n  found Angle [deg], Radius"]);
    refused(at, &import("a_rad=Angle [deg],dr_um=Radius"), &["column \"Angle [deg]\" has a unit that does not fit"]);
    refused(at, &import("c=Angle [deg]"), &["--columns c", "expected dr"]);
    refused(at, &import("Angle"), &["--columns", "\"Angle\" is not a column with its name"]);
    let named = import("a=Angle [deg],dr_um=Radius");
    for idle in [["--unit", "mm"], ["--plane", "XY"], ["--overshoot-deg", "5"]] {
        refused(at, &[&named[..], &idle].concat(), &[idle[0], "no file needs it"]);
    }
    refused(at, &[&named[..], &["--from-deg", "5", "--to-deg", "4"]].concat(), &["--to-deg 4", "beyond --from-deg"]);
    refused(
        at,
        &[&named[..], &["--from-deg", "50", "--to-deg", "60"]].concat(),
        &["t.csv:2: no sample of this run lies from 50° to 60°"],
    );
    let fit = ["fit", super::MODEL, "--run", "tilting=t.csv", "--columns", "b=Angle"];
    refused(at, &fit, &["--columns: no file has a column \"b\"", "expected names for a, dr"]);
    refused(at, &["import", "none.b5r", "--out", "new"], &["none.b5r: no such file"]);
    refused(at, &["exechon", "ik", "none.b5r"], &["none.b5r: no such file"]);
    fs::write(at.join("x.csv"), "<a/>").unwrap();
    refused(at, &["exechon", "ik", "x.csv"], &["x.csv: this is XML"]);
}
