//! What a user meets: options, refusals, what is replaced, and what is said of a table.

use crate::program::{succeeds, trunnion};
use crate::readers;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const RUNS: [&str; 6] = ["--run", "tilting=tilting.csv", "--run", "separation=separation.csv", "--table", "table.csv"];

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

pub fn simulated(model: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    succeeds(directory.path(), &["simulate", model, "--seed", "3", "--out", "."]);
    directory
}

/// Standard output and what is said beside it, of an export that has to succeed.
pub fn exported(directory: &TempDir, more: &[&str]) -> (String, String) {
    let arguments = [&["export", "tilting-table-a"], &RUNS[..], more].concat();
    let out = trunnion(directory.path(), &arguments);
    assert_eq!(out.status.code(), Some(0), "{more:?}: {}", text(&out.stderr));
    (text(&out.stdout), text(&out.stderr))
}

/// The message of a command that has to be refused, which leaves nothing.
fn refused(directory: &Path, arguments: &[&str]) -> String {
    let out = trunnion(directory, &[arguments, &["--out", "refused.comp"]].concat());
    let said = text(&out.stderr);
    assert_eq!((out.status.code(), text(&out.stdout).as_str()), (Some(2), ""), "{arguments:?}: {said}");
    assert!(!directory.join("refused.comp").exists(), "{arguments:?}");
    said
}

pub fn file(directory: &TempDir, name: &str) -> String {
    fs::read_to_string(directory.path().join(name)).unwrap()
}

#[test]
fn a_table_is_written_and_told() {
    let directory = simulated("tilting-table-a");
    let (said, warned) =
        exported(&directory, &["--function", "eps_xa", "--format", "linuxcnc", "--step-deg", "4", "--out", "a.comp"]);
    for words in [
        "eps_xa (EAA) of axis A",
        "91 of at most 256 from 0 to 360 ° by 4",
        "grid error: at most",
        "single precision of nominal − position: the control's",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(warned.contains("beyond 0 to 360 °"), "{warned}");
    let table = file(&directory, "a.comp");
    assert_eq!(table.lines().count(), 91);
    assert!(table.lines().all(|line| line.split_whitespace().filter(|word| word.parse::<f64>().is_ok()).count() == 3));
    // What fit says of the function, at the rows that both have.
    let fit = succeeds(directory.path(), &[&["fit", "tilting-table-a", "--json"], &RUNS[..]].concat());
    let fit: Value = serde_json::from_str(&fit).unwrap();
    let trim = readers::linuxcnc(&table).unwrap();
    for point in fit["functions"][0]["points"].as_array().unwrap() {
        let (at, value) = (point["a_deg"].as_f64().unwrap(), point["value"].as_f64().unwrap());
        if at % 4.0 != 0.0 {
            continue;
        }
        let taken = -trim(at, true).to_radians() * 1e6;
        assert!((taken - value).abs() < 1e-4, "{at}: {taken} {value}");
    }
    // The object says the same, and that the grid is coarser with fewer rows.
    let grid_error = |step: &str| {
        let more = ["--format", "linuxcnc", "--step-deg", step, "--out", "b.comp", "--force", "--json"];
        let (object, _) = exported(&directory, &more);
        let object: Value = serde_json::from_str(&object).unwrap();
        let table = &object["tables"][0];
        assert_eq!(
            (&object["format"], &table["iso"], &table["unit"]),
            (&"linuxcnc".into(), &"EAA".into(), &"urad".into())
        );
        let [rows, points] =
            ["rows", "points"].map(|key| table[key].as_u64().or(table[key].as_array().map(|p| p.len() as u64)));
        assert_eq!(rows, points);
        table["grid_error"].as_f64().unwrap()
    };
    let [fine, coarse] = ["2", "20"].map(grid_error);
    assert!(fine > 0.0 && coarse > 50.0 * fine, "{fine} {coarse}");
}

#[test]
fn the_page_shows_what_is_told() {
    let directory = simulated("tilting-table-a");
    let (said, _) = exported(&directory, &["--format", "linuxcnc", "--out", "A.comp"]);
    let page = include_str!("../../docs/export.md");
    let shown = page.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_eq!(shown, said);
}

#[test]
fn the_grid_error_is_what_a_reader_finds() {
    let directory = simulated("tilting-table-a");
    let (object, _) = exported(&directory, &["--format", "linuxcnc", "--step-deg", "20", "--out", "a.comp", "--json"]);
    let object: Value = serde_json::from_str(&object).unwrap();
    exported(&directory, &["--format", "csv", "--step-deg", "0.5", "--out", "fine.csv"]);
    let (coarse, fine) =
        (readers::linuxcnc(&file(&directory, "a.comp")).unwrap(), readers::csv(&file(&directory, "fine.csv")).unwrap());
    let found =
        (0..=720).map(|i| f64::from(i) * 0.5).map(|at| (coarse(at, true) - fine(at, true)).abs()).fold(0.0, f64::max);
    let (found, told) = (found.to_radians() * 1e6, object["tables"][0]["grid_error"].as_f64().unwrap());
    assert!((found - told).abs() < 0.01 * told, "{found} {told} µrad");
}

#[test]
fn what_fails_on_the_control_is_told() {
    let directory = simulated("tilting-table-a");
    let said = |more: &[&str]| exported(&directory, &[more, &["--out", "a.comp", "--force"]].concat()).1;
    let many = said(&["--format", "linuxcnc", "--step-deg", "1"]);
    assert!(many.contains("361 rows, where the control takes 256"), "{many}");
    let more = said(&["--format", "linuxcnc", "--range-deg=-360:360", "--step-deg", "5"]);
    assert!(more.contains("more than a turn"), "{more}");
    let home = said(&["--format", "linuxcnc", "--home", "90"]);
    assert!(home.contains("at 90 °, where it powers up, the error is"), "{home}");
    let zero = said(&["--format", "linuxcnc", "--home", "90", "--zero-at-home"]);
    assert!(!zero.contains("powers up"), "{zero}");
    // A whole turn of a modulo table has no end.
    let modulo = said(&["--format", "sinumerik-840d"]);
    assert!(!modulo.contains("beyond"), "{modulo}");
    let part = said(&["--format", "sinumerik-808d", "--range-deg", "0:250", "--step-deg", "1"]);
    assert!(part.contains("251 rows, where the control takes 200") && part.contains("beyond 0 to 250 °"), "{part}");
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let directory = simulated("tilting-table-a");
    let export = [&["export", "tilting-table-a"], &RUNS[..]].concat();
    let said = |more: &[&str]| refused(directory.path(), &[export.as_slice(), more].concat());
    let cases: [(&[&str], &str); 10] = [
        (&["--format", "linuxcnc", "--function", "eps_za"], "expected one of eps_xa"),
        (&["--format", "linuxcnc", "--step-deg", "7"], "no whole number of steps"),
        (&["--format", "linuxcnc", "--range-deg", "0:100", "--step-deg", "0.001"], "more than 20000 rows"),
        (&["--format", "linuxcnc", "--step-deg", "0.001"], "more than 20000 rows"),
        (&["--format", "fanuc", "--home", "12"], "without a row at the reference position"),
        (&["--format", "linuxcnc", "--step-mm", "7"], "--step-mm has no effect"),
        (&["--format", "linuxcnc", "--output-axis", "Y"], "it is for cec"),
        (&["--format", "linuxcnc", "--both-directions"], "one direction was measured"),
        (&["--format", "sinumerik-840d", "--both-directions"], "one value for both"),
        (&["--format", "sinumerik-840d", "--axis", "A;X"], "not an axis' name"),
    ];
    for (more, words) in cases {
        let message = said(more);
        assert!(message.contains(words), "{more:?}: {message}");
    }
    // Not over what was not measured.
    let short = tempfile::tempdir().unwrap();
    let simulate = ["simulate", "tilting-table-a", "--range-deg", "0:200", "--out", "."];
    succeeds(short.path(), &simulate);
    let beyond =
        refused(short.path(), &[export.as_slice(), &["--format", "linuxcnc", "--range-deg", "0:300"]].concat());
    assert!(beyond.contains("--range-deg 0:300: measured was"), "{beyond}");
}

#[test]
fn what_is_not_determined_is_refused_until_it_is_assumed() {
    let directory = simulated("rotary-table-c");
    let some = ["c-radial-far", "c-tangential-far", "tangential"].map(|run| format!("{run}={run}.csv"));
    let runs: Vec<&str> = some
        .iter()
        .filter(|run| directory.path().join(run.split('=').nth(1).unwrap()).exists())
        .flat_map(|run| ["--run", run])
        .collect();
    let message = refused(
        directory.path(),
        &[&["export", "rotary-table-c"], runs.as_slice(), &["--function", "ECC", "--format", "linuxcnc"]].concat(),
    );
    assert!(
        message.contains("ECC is determined up to")
            && message.contains("[assume]")
            && message.contains("trunnion plan"),
        "{message}"
    );
    // As the message says.
    let example = message.split("such as ").nth(1).unwrap().lines().next().unwrap();
    let model = trunnion_codegen::catalogue::source("rotary-table-c").unwrap();
    let mut assumed = format!("{model}\n[assume]\n{example}\n");
    let own = directory.path().join("assumed.toml");
    for _ in 0..6 {
        fs::write(&own, &assumed).unwrap();
        let arguments =
            [&["export", "assumed.toml"], runs.as_slice(), &["--function", "ECC", "--format", "csv", "--out", "c.csv"]]
                .concat();
        let out = trunnion(directory.path(), &arguments);
        if out.status.code() == Some(0) {
            let (said, written) = (text(&out.stdout), fs::read_to_string(directory.path().join("c.csv")).unwrap());
            assert!(said.contains(&format!("assumed: {}", example.replace('"', ""))), "{said}");
            assert!(written.contains("# assumed: "), "{written}");
            return;
        }
        let message = text(&out.stderr);
        let next = message.split("such as ").nth(1).unwrap_or_else(|| panic!("{message}")).lines().next().unwrap();
        assumed += &format!("{next}\n");
    }
    panic!("{assumed}");
}

#[test]
fn only_tables_are_replaced() {
    let directory = simulated("tilting-table-a");
    fs::write(directory.path().join("mine"), "mine").unwrap();
    let export = |format: &str, more: &[&str]| {
        let arguments = [&["export", "tilting-table-a"], &RUNS[..], &["--format", format, "--out"], more].concat();
        let out = trunnion(directory.path(), &arguments);
        (out.status.code(), text(&out.stderr))
    };
    assert_eq!(export("sinumerik-840d", &["mine"]).0, Some(2));
    assert_eq!(file(&directory, "mine"), "mine");
    assert_eq!(export("sinumerik-840d", &["mine", "--force"]).0, Some(0));
    // It says of itself that it is a table.
    for format in ["cec", "fanuc", "volcomp", "etalon", "csv"] {
        assert_eq!(export(format, &["mine"]).0, Some(0), "{format}");
    }
    // These have no comments.
    for format in ["linuxcnc", "heidenhain", "json"] {
        assert_eq!(export(format, &["plain", "--force"]).0, Some(0));
        assert_eq!(export(format, &["plain"]).0, Some(2), "{format}");
    }
    assert!(export("csv", &["tilting.csv", "--force"]).1.contains("reads this file"));
}

/// The lines of each direction: there, and back.
type Ways = (&'static str, String, [String; 2]);

/// Runs that are measured there and back, the axis 2″ further one way and 2″ less the other: a header, and the lines of each way.
fn there_and_back(directory: &TempDir) -> [Ways; 2] {
    let lines = |name: &str| file(directory, name).lines().map(str::to_owned).collect::<Vec<String>>();
    ["tilting", "separation"].map(|name| {
        let own = lines(&format!("{name}.csv"));
        // ΔR = R·e_xa: 2″ of it are 1.454 µm at 150 mm.
        let off = if name == "tilting" { 150e3 * (2.0 / 3600f64).to_radians() } else { 0.0 };
        let moved = |line: &String, by: f64| {
            let (angle, reading) = line.split_once(',').unwrap();
            format!("{angle},{}\n", reading.parse::<f64>().unwrap() + by)
        };
        let there: String = own[1..].iter().map(|line| moved(line, off)).collect();
        let back: String = own[1..].iter().rev().map(|line| moved(line, -off)).collect();
        (name, format!("{}\n", own[0]), [there, back])
    })
}

/// The same readings in one file or in two are the same: the uncertainty is of what is written, which has no hysteresis in its
/// residuals.
#[test]
fn one_file_of_both_directions_or_two_say_the_same() {
    let directory = simulated("tilting-table-a");
    let mut runs: [Vec<String>; 2] = Default::default();
    for (name, header, [there, back]) in there_and_back(&directory) {
        let files = [("one", format!("{there}{back}")), ("there", there), ("back", back)];
        for (at, (file, lines)) in files.into_iter().enumerate() {
            fs::write(directory.path().join(format!("{name}-{file}.csv")), header.clone() + &lines).unwrap();
            runs[at.min(1)].extend(["--run".to_owned(), format!("{name}={name}-{file}.csv")]);
        }
    }
    let found = runs.map(|runs| {
        let runs: Vec<&str> = runs.iter().map(String::as_str).collect();
        ["linuxcnc", "sinumerik-840d"].map(|format| {
            let export = [
                "export",
                "tilting-table-a",
                "--table",
                "table.csv",
                "--format",
                format,
                "--out",
                "a",
                "--force",
                "--json",
            ];
            let object: Value =
                serde_json::from_str(&succeeds(directory.path(), &[&export, runs.as_slice()].concat())).unwrap();
            let table = &object["tables"][0];
            ["u95", "u95_forward", "u95_reverse"].map(|key| table[key].as_f64().unwrap())
        })
    });
    let [one, two] = found.map(|of| of.concat());
    for (one, two) in one.into_iter().zip(two) {
        assert!((one - two).abs() < 0.01 * one && one < 5.0, "{one} {two} µrad");
    }
}

#[test]
fn both_directions_come_from_files() {
    let directory = simulated("tilting-table-a");
    for (name, header, [there, back]) in there_and_back(&directory) {
        fs::write(directory.path().join(format!("{name}.csv")), header + &there + &back).unwrap();
    }
    let (said, _) = exported(&directory, &["--format", "linuxcnc", "--both-directions", "--out", "a.comp"]);
    assert!(said.contains("directions: each its own; forward less reverse is at most +19."), "{said}");
    let trim = readers::linuxcnc(&file(&directory, "a.comp")).unwrap();
    for at in [0.0, 45.0, 90.0, 180.0, 270.0, 360.0] {
        let seconds = (trim(at, false) - trim(at, true)) * 3600.0;
        assert!((seconds - 4.0).abs() < 0.05, "{at}: {seconds}″");
    }
    let (object, _) = exported(&directory, &["--format", "cec", "--out", "a.ini", "--json"]);
    let object: Value = serde_json::from_str(&object).unwrap();
    let [value, u95] = ["value", "u95_noise"].map(|key| object["tables"][0]["hysteresis"][key].as_f64().unwrap());
    assert!((value - 19.39).abs() < u95.max(0.3) && u95 < 1.0, "{value} ± {u95}");
    // One value for both is the mean, and what stays is told.
    let (said, _) = exported(&directory, &["--format", "sinumerik-840d", "--out", "mean.ini"]);
    assert!(said.contains("half stays; forward less reverse is at most +19."), "{said}");
    let mean = readers::sinumerik(&file(&directory, "mean.ini")).unwrap();
    for at in [0.0, 90.0, 200.0] {
        assert!((mean(at, true) - (trim(at, true) + trim(at, false)) / 2.0).abs() < 1e-8);
    }
    let both = readers::cec(&file(&directory, "a.ini")).unwrap();
    assert!(((both(90.0, false) - both(90.0, true)) * 3600.0 - 4.0).abs() < 0.05);
}
