//! What is told of a table: where its rows are, what the axis does with it, in numbers as they were stated.

use crate::commands::{exported, file, simulated, text};
use crate::program::{succeeds, trunnion};
use crate::readers;
use serde_json::Value;
use std::fs;
use tempfile::TempDir;
use trunnion::export::{AllFormat, Format};

/// The rows of a table that is asked for without a range.
fn rows(directory: &TempDir, format: &str, step: &str) -> String {
    let (said, _) = exported(directory, &["--format", format, "--step-deg", step, "--out", "a.comp", "--force"]);
    let rows = said.lines().find_map(|line| line.trim().strip_prefix("rows: ")).unwrap();
    rows.split_once(" from ").unwrap().1.to_owned()
}

#[test]
fn a_turn_is_closed_and_less_ends_where_it_was_measured() {
    // Samples, and the rows with one value of a turn and with every turn the same.
    for (measured, plain, modulo) in [
        ("0:360", ["0 to 360", "0 to 360", "0 to 360"], "0 to 360"),
        ("10:370", ["0 to 360", "0 to 360", "0 to 360"], "0 to 360"),
        ("-180:180", ["-180 to 180", "-180 to 180", "-180 to 180"], "0 to 360"),
        // A sample is taken for so much beyond the last as they are apart: for 200, but not for 199.5 and more.
        ("0:200", ["0 to 199", "0 to 200", "0 to 200"], ""),
    ] {
        let directory = tempfile::tempdir().unwrap();
        succeeds(directory.path(), &["simulate", "tilting-table-a", &format!("--range-deg={measured}"), "--out", "."]);
        for (step, plain) in ["0.5", "1", "5"].into_iter().zip(plain) {
            assert_eq!(rows(&directory, "linuxcnc", step), format!("{plain} ° by {step}"), "{measured}");
            let modulo = if modulo.is_empty() { plain } else { modulo };
            assert_eq!(rows(&directory, "sinumerik-840d", step), format!("{modulo} ° by {step}"), "{measured}");
        }
    }
}

#[test]
fn where_the_axis_powers_up_is_looked_up_as_the_control_does() {
    let directory = simulated("tilting-table-a");
    let said = |format: &str, more: &[&str]| {
        exported(&directory, &[&["--format", format, "--out", "a.comp", "--force"], more].concat()).1
    };
    // 270° of a modulo axis is −90°.
    for format in ["sinumerik-840d", "cec"] {
        let [there, here] = ["--home=-90", "--home=270"].map(|home| said(format, &[home]));
        let error = |said: &str| said.split("the error is ").nth(1).map(str::to_owned);
        assert!(error(&there).is_some() && error(&there) == error(&here), "{format}: {there}{here}");
        let zero = said(format, &["--home=-90", "--zero-at-home"]);
        assert!(!zero.contains("powers up"), "{format}: {zero}");
    }
    assert!(!said("fanuc", &["--home=-90"]).contains("powers up"));
    // LinuxCNC knows no turns.
    let held = said("linuxcnc", &["--home=-90", "--zero-at-home"]);
    assert!(held.contains("at -90 °, where it powers up"), "{held}");
    // What no digit shows is none: half a row from a row's own value.
    let between = said("linuxcnc", &["--step-deg", "0.5", "--home", "0.25", "--zero-at-home"]);
    assert!(!between.contains("powers up"), "{between}");
    // A table of a whole turn that an axis modulo 360° is not in.
    let turn = said("sinumerik-840d", &["--range-deg=-180:180"]);
    assert!(turn.contains("from -180 to 180 °") && turn.contains("--range-deg 0:360"), "{turn}");
    assert!(!said("linuxcnc", &["--range-deg=-180:180"]).contains("--range-deg 0:360"));
}

/// `--run` of every file that was simulated.
fn runs(directory: &TempDir) -> Vec<String> {
    let files = fs::read_dir(directory.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let run = |name: String| Some(format!("{}={name}", name.strip_suffix(".csv").filter(|run| *run != "table")?));
    files.filter_map(run).flat_map(|run| ["--run".to_owned(), run]).collect()
}

#[test]
fn location_errors_have_their_unit_and_their_uncertainty() {
    let directory = simulated("ac-trunnion-probe");
    let (at, runs) = (directory.path(), runs(&directory));
    let runs: Vec<&str> = runs.iter().map(String::as_str).collect();
    let object = |arguments: &[&str]| -> Value {
        serde_json::from_str(&succeeds(at, &[arguments, &runs, &["--json"]].concat())).unwrap()
    };
    let fit = object(&["fit", "ac-trunnion-probe"]);
    let locations: Vec<&Value> =
        fit["functions"].as_array().unwrap().iter().filter(|own| own["location_error"] == true).collect();
    assert_eq!(locations.len(), 8);
    for format in [AllFormat::Volcomp, AllFormat::Etalon] {
        let export = ["export", "ac-trunnion-probe", "--out", "v", "--force", "--format", Format::All(format).name()];
        let exported = object(&export);
        let written = readers::of_all(format)(&file(&directory, "v")).unwrap();
        for own in &locations {
            let name = own["name"].as_str().unwrap().strip_prefix('E').unwrap();
            let told = exported["constants"].as_array().unwrap().iter().find(|told| told["name"] == name).unwrap();
            let (per, unit) = if own["unit"] == "um" { (1e-3, "mm") } else { (1e-6, "rad") };
            assert_eq!(told["unit"], unit, "{name}");
            let [value, u95] = ["value", "u95"].map(|key| per * own["points"][0][key].as_f64().unwrap());
            let [told_value, told_u95] = ["value", "u95"].map(|key| told[key].as_f64().unwrap());
            assert!((told_value - value).abs() < 1e-12 && (told_u95 - u95).abs() < 1e-12 && u95 > 0.0, "{name}");
            assert!((written[name][0].1 - value).abs() < 1e-12, "{name}");
            let line = format!("// {name}: {value:.9} {unit} +- {u95:.9} {unit} (95 %)");
            assert!(file(&directory, "v").contains(&line), "{line}");
        }
    }
}

#[test]
fn numbers_are_told_as_they_were_stated() {
    let directory = simulated("bc-trunnion");
    let runs = runs(&directory);
    let runs: Vec<&str> = runs.iter().map(String::as_str).collect();
    let export = ["export", "bc-trunnion", "--format", "volcomp", "--step-deg", "60", "--out", "v"];
    let out = trunnion(directory.path(), &[&export, runs.as_slice()].concat());
    assert!(text(&out.stderr).contains("the axis goes from -30 to 110 ° in the model"), "{}", text(&out.stderr));
    let out = trunnion(directory.path(), &["simulate", "bc-trunnion", "--range-deg=200:300", "--out", "x"]);
    let said = text(&out.stderr);
    assert!(said.contains("its range, -30 to 110 deg"), "{said}");
}

#[test]
fn whose_resolution_it_is_is_told() {
    let directory = simulated("tilting-table-a");
    for format in Format::ALL {
        let (object, _) = exported(&directory, &["--format", format.name(), "--out", "a", "--force", "--json"]);
        let object: Value = serde_json::from_str(&object).unwrap();
        let control = ["linuxcnc", "fanuc"].contains(&format.name());
        assert_eq!(object["resolution_of"], if control { "control" } else { "file" }, "{}", format.name());
        let words = object["resolution"].as_str().unwrap();
        let known = control || ["csv", "json"].contains(&format.name());
        assert_eq!(words.contains("the control's own is not known"), !known, "{words}");
    }
}

/// A table on the workpiece's side and a tool's axis: the sign is told in the file, too.
#[test]
fn a_sign_that_is_turned_is_told() {
    let directory = simulated("tilting-table-a-dyz");
    let runs = ["--run", "along-y=along-y.csv", "--run", "along-z=along-z.csv"];
    let export = ["export", "tilting-table-a-dyz", "--function", "delta_ya", "--out", "a.ini", "--force", "--format"];
    let told = "values are −EYA: Y, moved further, does the opposite to the tool against the workpiece";
    for (format, turned) in [("cec", true), ("heidenhain", false), ("csv", false)] {
        let said = succeeds(directory.path(), &[&export, &[format][..], &runs].concat());
        assert_eq!(said.contains(told), turned, "{format}: {said}");
        assert_eq!(file(&directory, "a.ini").contains("; sign: values are -EYA: Y,"), turned);
    }
}
