//! `trunnion circular` as a user meets it.

use crate::program;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

const CW: &str = "tests/reference/circular/cw.csv";
const CCW: &str = "tests/reference/circular/ccw.csv";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn of_bar<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [&["circular", "--radius", "150"], arguments].concat()
}

fn trunnion(arguments: &[&str]) -> Output {
    program::trunnion(root(), &of_bar(arguments))
}

fn succeeds(arguments: &[&str]) -> String {
    program::succeeds(root(), &of_bar(arguments))
}

fn refused(arguments: &[&str]) -> String {
    let output = trunnion(arguments);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn the_page_shows_what_the_command_prints() {
    let directory = tempfile::tempdir().unwrap();
    let picture = directory.path().join("circular.svg");
    let text = succeeds(&["--cw", CW, "--ccw", CCW, "--feed", "1000", "--svg", picture.to_str().unwrap()]);
    let drawn = fs::read_to_string(picture).unwrap();
    let page = fs::read_to_string(root().join("docs/circular.md")).unwrap();
    for line in text.lines() {
        assert!(page.contains(line.trim_end()), "docs/circular.md lacks: {line}");
    }
    for part in ["+X", "\u{2212}Y", "clockwise", "counterclockwise", "least-squares circle", "5 µm a division"] {
        assert!(drawn.contains(part), "{part}");
    }
}

#[test]
fn every_number_is_in_the_document() {
    let document: Value =
        serde_json::from_str(&succeeds(&["--cw", CW, "--ccw", CCW, "--feed", "1000", "--json"])).unwrap();
    let paths = document["paths"].as_array().unwrap();
    assert_eq!(
        paths.iter().map(|path| path["direction"].as_str().unwrap()).collect::<Vec<_>>(),
        ["clockwise", "counterclockwise"]
    );
    for object in paths.iter().chain([&document["both"]]) {
        let zone = object["circular_deviation"]["minimum_zone_um"].as_f64().unwrap();
        let squares = object["circular_deviation"]["least_squares_um"].as_f64().unwrap();
        assert!(5.0 < zone && zone <= squares && squares < 15.0);
        let [max, min] = ["max", "min"].map(|end| object["radial_deviation"][end]["um"].as_f64().unwrap());
        assert!(max - min >= squares);
    }
    let effect = |name: &str, key: &str| {
        let effects = document["effects"].as_array().unwrap();
        let value = &effects.iter().find(|e| e["name"] == name).unwrap()[key];
        [&value["value"], &value["u95"]].map(|number| number.as_f64().unwrap())
    };
    // What the files were made with.
    let truths = [
        ("squareness", "um_per_m", 22.0),
        ("squareness", "urad", 22.0),
        ("scale_mismatch", "um_per_m", 23.0),
        ("scale_mismatch", "um_over_diameter", 6.9),
        ("servo_mismatch", "ms", 0.15),
        ("servo_mismatch", "um", 2.5),
        ("centre_first", "um", 4.1),
        ("centre_second", "um", -2.7),
        ("backlash", "um", 3.6),
    ];
    for (name, key, truth) in truths {
        let [value, u95] = effect(name, key);
        assert!((value - truth).abs() <= u95 && u95 < 0.5 * truth.abs(), "{name}: {value} ± {u95} {key}");
    }
    assert_eq!(document["spikes"].as_array().unwrap().len(), 8);
    assert!(document["both"]["circular_hysteresis"]["um"].as_f64().unwrap() > 5.0);
    assert!(document["both"]["mean_bidirectional_radial_deviation"]["um"].as_f64().unwrap() < -2.0);
    assert!(document["warnings"].as_array().unwrap().is_empty());
}

#[test]
fn one_file_with_both_paths_is_two_files() {
    let directory = tempfile::tempdir().unwrap();
    let [ccw, cw] = [CCW, CW].map(|file| fs::read_to_string(root().join(file)).unwrap());
    let (_, back) = cw.split_once('\n').unwrap();
    let both = directory.path().join("both.csv");
    fs::write(&both, ccw + back).unwrap();
    let both = both.to_str().unwrap();
    assert_eq!(succeeds(&[both]), succeeds(&["--cw", CW, "--ccw", CCW]));
    fs::write(
        both,
        "a_deg,dr_um\n".to_owned() + &(0..359_u32).map(|k| format!("{},0\n", k.pow(3) % 359)).collect::<String>(),
    )
    .unwrap();
    assert!(refused(&[both]).contains("samples in no order in time"));
}

#[test]
fn a_feed_in_is_trimmed_by_every_way_in_and_told() {
    let directory = tempfile::tempdir().unwrap();
    let file = |name: &str, readings: &[(f64, f64)]| {
        let lines = readings.iter().map(|(a, r)| format!("{a:.3},{r:.4}\n")).collect::<String>();
        fs::write(directory.path().join(name), format!("a_deg,dr_um\n{lines}")).unwrap();
        directory.path().join(name).to_str().unwrap().to_owned()
    };
    // 80 µm out of centre and oval by 3 µm.
    let reading = |a: f64| 80.0 * a.to_radians().cos() + 1.5 * (2.0 * a.to_radians()).cos();
    let circle: Vec<(f64, f64)> = (0..720).map(|i| (0.5 * f64::from(i), reading(0.5 * f64::from(i)))).collect();
    let way = |a: f64, n: u32| (0..n).map(move |i| (a, reading(a) - 1080.0 * (1.0 - f64::from(i) / f64::from(n))));
    let back = way(359.5, 40).collect::<Vec<_>>().into_iter().rev();
    let fed: Vec<(f64, f64)> = way(0.0, 60).chain(circle.iter().copied()).chain(back).collect();
    let (fed, circle) = (file("fed.csv", &fed), file("circle.csv", &circle));
    for given in [&["--ccw", fed.as_str()][..], &[fed.as_str()]] {
        let output = trunnion(&[given, &["--json"]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains("fed.csv: ") && said.contains("60 of the feed-in, 40 of the feed-out"), "{said}");
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        let trimmed = &told["paths"][0]["trimmed"];
        assert_eq!((&trimmed["feed_in"], &trimmed["feed_out"]), (&60.into(), &40.into()));
        assert_eq!(succeeds(given), succeeds(&["--ccw", &circle]));
    }
    let output = trunnion(&["--ccw", &circle, "--feed", "1000", "--json"]);
    assert!(output.stderr.is_empty());
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (&told["paths"][0]["trimmed"]["feed_in"], told["feed_mm_per_min"].to_string().as_str()),
        (&0.into(), "1000.0")
    );
    // A path alone is one run.
    let both = fs::read_to_string(&circle).unwrap() + &(0..300).map(|i| format!("{},0\n", 359 - i)).collect::<String>();
    let both = {
        fs::write(directory.path().join("both.csv"), both).unwrap();
        directory.path().join("both.csv")
    };
    assert!(refused(&["--ccw", both.to_str().unwrap()]).contains("both.csv: 2 runs\n  expected one run"));
}

#[test]
fn one_direction_is_enough_and_says_what_it_lacks() {
    let text = succeeds(&["--ccw", CCW]);
    for said in ["needs both directions", "squareness and servo mismatch", "counterclockwise"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let document: Value = serde_json::from_str(&succeeds(&["--ccw", CCW, "--json"])).unwrap();
    assert!(document["both"].is_null());
    let effects = document["effects"].as_array().unwrap();
    let square = effects.iter().find(|effect| effect["name"] == "squareness").unwrap();
    assert_eq!(square["undetermined"], "needs both directions");
}

#[test]
fn bad_input_is_named() {
    assert!(refused(&[]).contains("--cw"));
    assert!(refused(&["--cw", CW, "--ccw", CW]).contains("the same file"));
    assert!(refused(&["--cw", CW, "--plane", "XX"]).contains("not a plane"));
    assert!(refused(&["--cw", CW, "--feed", "0"]).contains("above 0 to 1000000"));
    assert!(refused(&["--cw", "none.csv"]).contains("no such file"));
    let directory = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let file = directory.path().join(name);
        fs::write(&file, text).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let rows = |header: &str, to: u32| {
        let lines = (0..to).map(|k| format!("{k},0.{}\n", k % 10));
        format!("{header}\n{}", lines.collect::<String>())
    };
    assert!(refused(&["--cw", &file("short.csv", &rows("c_deg,dr_um", 60))]).contains("an arc of 59.0°"));
    assert!(refused(&["--cw", &file("few.csv", &rows("c_deg,dr_um", 5))]).contains("a run of 5 readings"));
    assert!(refused(&["--cw", &file("unit.csv", &rows("angle,dr_um", 360))]).contains("a_deg or a_rad"));
    assert!(refused(&["--cw", &file("two.csv", &rows("a_deg,c_deg", 360))]).contains("same quantity"));
    assert!(refused(&["--cw", &file("rows.csv", &rows("a_deg,dr_um", 360).replace("9,0.9", "9,x"))]).contains(":11:"));
    // What a message advises is there.
    let other = file("other.csv", &rows("angle,reading", 360));
    for from in [&["--cw", &other][..], &[&other]] {
        assert!(refused(from).contains("--columns"));
        assert!(succeeds(&[from, &["--columns", "a_deg=angle,dr_um=reading"]].concat()).contains("360.0°"));
    }
    assert!(refused(&["--cw", &other, "--columns", "b_deg=angle"]).contains("expected a and dr"));
    // Any name of the angle, and a picture that takes the place of nothing that is read.
    let good = file("good.csv", &rows("spindle_deg,dr_um", 360));
    assert!(succeeds(&["--ccw", &good]).contains("360.0°"));
    assert!(refused(&["--ccw", &good, "--svg", &good, "--force"]).contains("good.csv"));
    let output = trunnion(&["--cw", &good]);
    assert!(str::from_utf8(&output.stderr).unwrap().contains("go the other way"));
}

#[test]
fn a_path_of_a_minute_is_drawn_with_all_its_peaks_in_a_small_file() {
    let directory = tempfile::tempdir().unwrap();
    let [file, picture] = ["long.csv", "long.svg"].map(|name| directory.path().join(name).to_str().unwrap().to_owned());
    let row = |k: u32| format!("{:.3},{}\n", f64::from(k) * 0.006, if k == 31_234 { 9 } else { k % 3 });
    fs::write(&file, format!("a_deg,dr_um\n{}", (0..60_000).map(row).collect::<String>())).unwrap();
    assert!(succeeds(&["--ccw", &file, "--svg", &picture]).contains("9.00 µm 187.4°"));
    let drawn = fs::read_to_string(picture).unwrap();
    assert!(drawn.len() < 150_000, "{}", drawn.len());
    // The largest deviation is the outermost point, which the scale's last circle is for.
    assert!(drawn.contains(">\n10\n<"));
}
