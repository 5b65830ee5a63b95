//! The report that one hands over: every number of it is one of the JSON object's, nothing in it is obeyed or fetched, and what it
//! says of an uncertainty is so.

mod budget;
mod page;
mod probed;
#[path = "../program/mod.rs"]
mod program;

use page::Page;
use program::{succeeds, trunnion};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;
use trunnion::data::{Known, Quantity, Table, Unit};

const MODEL: &str = "tilting-table-a";
const RUNS: [&str; 6] = ["--run", "tilting=tilting.csv", "--run", "separation=separation.csv", "--table", "table.csv"];

fn refused(directory: &Path, arguments: &[&str], message: &str) {
    let output = trunnion(directory, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains(message), "{arguments:?}: {said}");
}

/// A directory with the files of a simulated machine.
fn simulated(model: &str, more: &[&str]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    succeeds(directory.path(), &[&["simulate", model, "--out", "."], more].concat());
    directory
}

/// The JSON object of a command, and its report.
fn reported(directory: &Path, arguments: &[&str]) -> (Value, Page) {
    let json = succeeds(directory, &[arguments, &["--report", "report.html"]].concat());
    let html = fs::read_to_string(directory.join("report.html")).unwrap();
    (serde_json::from_str(&json).unwrap(), Page::new(html))
}

fn fitted(directory: &Path, more: &[&str]) -> (Value, Page) {
    reported(directory, &[&["fit", MODEL, "--radius", "150", "--json"], &RUNS[..], more].concat())
}

/// A model with functions that these of its runs do not determine, and one with a long derivation that all of its runs do.
const MODELS: [(&str, &[&str]); 2] =
    [("rotary-table-c", &["tangential", "c-radial-far", "c-tangential-far"]), ("bc-trunnion", &[])];

/// Runs of a model with their files, as `simulate` names them; all of none.
fn runs_of(directory: &Path, runs: &[&str]) -> Vec<String> {
    let truth: Value = serde_json::from_str(&fs::read_to_string(directory.join("truth.json")).unwrap()).unwrap();
    let files = truth["files"].as_object().unwrap().keys();
    let named = files.filter_map(|name| name.strip_suffix(".csv")).filter(|name| *name != "table");
    let asked = named.filter(|name| runs.is_empty() || runs.contains(name));
    asked.flat_map(|run| ["--run".to_owned(), format!("{run}={run}.csv")]).collect()
}

/// The arguments of a fit of these runs, simulated into a directory.
fn fit_of(model: &str, runs: &[&str]) -> (TempDir, Vec<String>) {
    let directory = simulated(model, &[]);
    let fit = ["fit", model].map(str::to_owned).into_iter().chain(runs_of(directory.path(), runs)).collect();
    (directory, fit)
}

fn words(arguments: &[String]) -> Vec<&str> {
    arguments.iter().map(String::as_str).collect()
}

#[test]
fn every_number_is_one_of_the_json_object() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let (document, page) = fitted(directory.path(), &["--instrument", "QC20-W", "--robust", "huber"]);
    assert!(page.follows(&document) > 150);
    page.is_whole();
    for (model, runs) in MODELS {
        let (directory, fit) = fit_of(model, runs);
        let arguments = [&words(&fit)[..], &["--json", "--instrument-um", "0.5"]].concat();
        let (document, page) = reported(directory.path(), &arguments);
        assert!(page.follows(&document) > 150, "{model}");
        page.is_whole();
        let warnings = document["warnings"].as_array().unwrap();
        assert_eq!(warnings.is_empty(), runs.is_empty(), "{model}: {warnings:?}");
        for warning in warnings {
            assert!(page.says(warning.as_str().unwrap()), "{model}: {warning}");
        }
    }
}

/// Touches of a ring of 40.001 mm with a stylus of 6 mm, all around it.
fn touches(reversed: bool) -> String {
    let mut lines = String::from("x_mm,y_mm,z_mm,spindle_deg\n");
    for spindle in if reversed { &[0.0, 180.0][..] } else { &[0.0] } {
        for k in 0..12 {
            let (sin, cos) = (f64::from(k) * 30.0).to_radians().sin_cos();
            let off = 1e-4 * f64::from(k * 7 % 5 - 2);
            lines += &format!("{:.6},{:.6},-168,{spindle}\n", (17.0005 + off) * cos + 1.5, (17.0005 + off) * sin - 2.0);
        }
    }
    lines
}

#[test]
fn texts_are_shown_and_not_obeyed() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let at = directory.path();
    let (file, title) = ("a<b>&'c.csv", "<img src=x onerror=alert(1)> & \\u202e\\u0007 {{ 7*7 }}");
    fs::rename(at.join("tilting.csv"), at.join(file)).unwrap();
    let source = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/machines/tilting-table-a.toml"));
    let source = source.unwrap();
    let line = source.lines().find(|line| line.starts_with("title")).unwrap();
    fs::write(at.join("m.toml"), source.replace(line, &format!("title = \"{title}\""))).unwrap();
    let run = format!("tilting={file}");
    let rest = ["--run", "separation=separation.csv", "--table", "table.csv", "--json"];
    let (document, page) = reported(at, &[&["fit", "m.toml", "--radius", "150", "--run", &run], &rest[..]].concat());
    page.is_whole();
    page.follows(&document);
    assert!(
        page.says("<img src=x onerror=alert(1)> & \\u{202e}\\u{7} {{ 7*7 }}"),
        "as it stands, control characters visible"
    );
    assert!(page.says(file) && !page.html.contains("<img") && !page.html.contains("<b>"));
    assert!(!page.html.contains(['\u{202e}', '\u{7}']));
    assert!(page.says("--run 'tilting=a<b>&'\\''c.csv'"), "the command as a shell takes it");
}

#[test]
fn the_same_but_for_the_time() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let timeless = |html: &str, json: &Value| html.replace(json["made"]["at"].as_str().unwrap(), "");
    let [first, second] = [0, 1].map(|_| fitted(directory.path(), &[]));
    assert_eq!(timeless(&first.1.html, &first.0), timeless(&second.1.html, &second.0));
    let plain = || succeeds(directory.path(), &[&["fit", MODEL, "--radius", "150", "--json"], &RUNS[..]].concat());
    assert_eq!(plain(), plain(), "without a report there is no time");
}

#[test]
fn files_are_known_again() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let (document, _) = fitted(directory.path(), &[]);
    let files = document["made"]["files"].as_array().unwrap();
    let names: Vec<&str> = files.iter().map(|file| file["name"].as_str().unwrap()).collect();
    assert_eq!(names, [MODEL, "tilting.csv", "separation.csv", "table.csv"]);
    for file in &files[1..] {
        let name = file["name"].as_str().unwrap();
        let sum = Command::new("sha256sum").current_dir(directory.path()).arg(name).output().unwrap();
        let sum = String::from_utf8(sum.stdout).unwrap();
        assert!(sum.starts_with(file["sha256"].as_str().unwrap()), "{sum}");
        assert_eq!(fs::metadata(directory.path().join(name)).unwrap().len(), file["bytes"].as_u64().unwrap());
    }
}

#[test]
fn what_comes_through_a_pipe_has_the_digest_of_its_bytes() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let at = directory.path();
    // More than a pipe holds at once, so that not all of it is there when it is opened.
    let tilting = fs::read_to_string(at.join("tilting.csv")).unwrap() + &"\n".repeat(100_000);
    fs::write(at.join("tilting.csv"), tilting).unwrap();
    fs::write(at.join("touches.csv"), touches(true)).unwrap();
    let commands = [
        (
            "fit tilting-table-a --radius 150 --run tilting=- --run separation=separation.csv --table table.csv --json",
            "tilting.csv",
        ),
        (
            "fit tilting-table-a --radius 150 --run tilting=tilting.csv --run separation=separation.csv --table - --json",
            "table.csv",
        ),
        ("exechon ring - --json", "touches.csv"),
        ("exechon offset -", "touches.csv"),
    ];
    for (command, file) in commands {
        let reported = format!("cat {file} | \"$0\" {command} --report report.html");
        let mut shell = Command::new("sh");
        shell.args(["-c", &reported, env!("CARGO_BIN_EXE_trunnion")]).current_dir(at);
        let output = shell.output().unwrap();
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let files = document["made"]["files"].as_array().unwrap();
        let own = files.iter().find(|own| own["name"] == "-").unwrap();
        let sum = Command::new("sha256sum").current_dir(at).arg(file).output().unwrap();
        let sum = String::from_utf8(sum.stdout).unwrap();
        assert_eq!(own["sha256"].as_str(), sum.split(' ').next(), "{command}");
        assert_eq!(own["bytes"], fs::metadata(at.join(file)).unwrap().len(), "{command}");
        let html = fs::read_to_string(at.join("report.html")).unwrap();
        assert!(html.contains("standard input") && html.contains(sum.split(' ').next().unwrap()), "{command}");
    }
}

#[test]
fn curves_read_back_as_a_table_of_known_functions() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let at = directory.path();
    let (document, _) = fitted(at, &["--csv", "curves"]);
    let known = [Known { name: "eps_xa".to_owned(), quantity: Quantity::Angle }];
    let written = fs::read_to_string(at.join("curves/eps_xa.csv")).unwrap();
    let (columns, last): (Vec<&str>, Vec<&str>) = written.lines().skip(1).filter_map(|l| l.rsplit_once(',')).unzip();
    assert_eq!((columns[0], last[0]), ("a_deg,eps_xa_urad,u_eps_xa_urad", "u95_eps_xa_urad"));
    fs::write(at.join("known.csv"), columns.join("\n") + "\n").unwrap();
    let table = Table::read(&at.join("known.csv"), "a", &known).unwrap();
    let points = document["functions"][0]["points"].as_array().unwrap();
    assert_eq!((points.len(), last.len()), (73, 74));
    for (point, u95) in points.iter().zip(&last[1..]) {
        let printed = u95.parse::<f64>().unwrap();
        assert!((printed - point["u95"].as_f64().unwrap()).abs() <= 1e-12 * printed);
        let number = |key: &str| point[key].as_f64().unwrap();
        let read = table.at(Unit::Deg.to_inner(number("a_deg"))).unwrap();
        for (read, key) in [(read.values[0], "value"), (read.stds[0], "std")] {
            assert!((Unit::Urad.from_inner(read) - number(key)).abs() <= 1e-12 * number(key).abs(), "{key}");
        }
    }
    // A function that is seen in a sum: the sum, under another name, which nobody takes for the function.
    let (directory, fit) = fit_of(MODELS[0].0, MODELS[0].1);
    succeeds(directory.path(), &[&words(&fit)[..], &["--csv", "curves"]].concat());
    let ecc = fs::read_to_string(directory.path().join("curves/ECC.csv")).unwrap();
    assert!(ecc.lines().next().unwrap().contains("S = ECC"), "{ecc}");
    assert_eq!(ecc.lines().nth(1), Some("c_deg,S_urad,u95_S_urad,u95_ECC_urad"));
}

#[test]
fn only_earlier_results_are_replaced() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let at = directory.path();
    let fit = [&["fit", MODEL, "--radius", "150"], &RUNS[..]].concat();
    fn with<'a>(fit: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
        [fit, more].concat()
    }
    fs::write(at.join("notes.html"), "<html>mine</html>").unwrap();
    let foreign = "notes.html: this file is not one that was written here before";
    refused(at, &with(&fit, &["--report", "notes.html"]), foreign);
    for more in [&["--force"][..], &[]] {
        succeeds(at, &with(&fit, &[&["--report", "notes.html"], more].concat()));
    }
    refused(at, &with(&fit, &["--report", "tilting.csv", "--force"]), "the command reads this file");
    refused(at, &with(&fit, &["--force"]), "--force");
    fs::create_dir(at.join("out")).unwrap();
    fs::write(at.join("out/eps_xa.csv"), "a_deg,eps_xa_urad\n0,1\n").unwrap();
    refused(at, &with(&fit, &["--csv", "out"]), "eps_xa.csv: this file is not one that was written here before");
    for more in [&["--force"][..], &[]] {
        succeeds(at, &with(&fit, &[&["--csv", "out"], more].concat()));
    }
    // What is simulated beside stays.
    succeeds(at, &with(&fit, &["--csv", "."]));
    assert!(at.join("tilting.csv").exists() && at.join("eps_xa.csv").exists());
}
