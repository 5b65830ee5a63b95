//! The parallel machine on the command line: the paper's numbers, the reference poses, and what is said about bad input.

use serde_json::Value;
use std::fs;
use std::io::Write;
use std::process::{Command, Output, Stdio};

/// Runs `trunnion exechon …` with `input` on standard input.
fn exechon(arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trunnion"));
    command.arg("exechon").args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // A command that refuses its arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn good(arguments: &[&str], input: &str) -> String {
    let output = exechon(arguments, input);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Exit code 2, nothing on standard output, and this in the message.
fn bad(arguments: &[&str], input: &str, message: &str) {
    let output = exechon(arguments, input);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty());
    assert!(said.contains(message), "{said:?} without {message:?}");
    assert!(said.contains("\n  "), "{said:?} without a remedy");
}

fn good_json(arguments: &[&str], input: &str) -> Value {
    serde_json::from_str(&good(arguments, input)).unwrap()
}

fn table(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect()
}

fn reference() -> Value {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/exechon-poses.json");
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

const HEADER: &str = "x_mm,y_mm,z_mm,i,j,k\n";

#[test]
fn ik_gives_the_reference_poses_in_full_precision() {
    let reference = reference();
    let poses = reference["poses"].as_array().unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let fields = |p: &Value| ["pt", "t"].map(|n| [0, 1, 2].map(|k| number(&p[n][k]).to_string()).join(",")).join(",");
    let input: String = poses.iter().map(|p| fields(p) + "\n").collect();
    let rows = table(&good(&["ik", "--frame", "base", "-"], &(HEADER.to_owned() + &input)));
    assert_eq!(rows.len(), 12);
    for (row, pose) in rows.iter().zip(poses) {
        for k in 0..3 {
            assert_eq!(row[k], number(&pose["pt"][k]));
            assert!((row[3 + k] - number(&pose["l"][k])).abs() < 1e-9);
        }
        for (at, name) in [(6, "A"), (7, "C"), (8, "phi_DRM_eq7")] {
            assert!((row[at].to_radians() - number(&pose[name])).abs() < 1e-12, "{name}");
        }
        assert!(row[9] <= 6.0);
    }
}

#[test]
fn fk_undoes_ik_in_machine_coordinates() {
    let poses = format!("{HEADER}-319.135,198.236,-168,0,0,1\n\n# a comment\n100,-50,-30.5,0.6,0,0.8\n");
    let joints = table(&good(&["ik", "-"], &poses));
    let lines = joints.iter().map(|r| r[3..8].iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n");
    let back = table(&good(&["fk", "-"], &("l1_mm,l2_mm,l3_mm,a_deg,c_deg\n".to_owned() + &lines.collect::<String>())));
    for (found, given) in
        back.iter().zip([[-319.135, 198.236, -168.0, 0.0, 0.0, 1.0], [100.0, -50.0, -30.5, 0.6, 0.0, 0.8]])
    {
        assert!(found.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    }
    let drm = table(&good(&["drm", "-"], &poses));
    assert!((drm[0][3] - 16.356_382_247).abs() < 1e-9 && drm[1][3] == joints[1][8]);
}

#[test]
fn bad_poses_are_refused_whole() {
    let after = |line: &str| format!("{HEADER}0,0,0,0,0,1\n{line}\n");
    bad(&["ik", "-"], &after("0,0,0,0,0,0"), "-:3: the tool's direction has length zero");
    bad(&["ik", "-"], &after("0,0,0,0,0,2"), "-:3: the tool's direction has length 2, not 1");
    bad(&["ik", "-"], &after("NaN,0,0,0,0,1"), "-:3: \"NaN\" in column x_mm is not finite");
    bad(&["ik", "-"], &after("0,0,500,0,0,1"), "-:3: strut 1 would be 1817.993 mm long, 167.993 mm above its limit");
    bad(&["ik", "-"], &after("0,0,0,0,0"), "-:3: 5 field(s) in a file of 6 columns");
    bad(&["ik", "-"], &after("0,0,zero,0,0,1"), "-:3: \"zero\" in column z_mm is not a number");
    bad(&["ik", "-"], "x_mm,y_mm,i,j,k\n", "-:1: missing column z_mm");
    bad(&["ik", "-"], "x_mm,y_mm,z_mm,i,j,q\n", "-:1: unknown column \"q\"");
    bad(&["ik", "-"], "", "-: the file is empty");
    bad(&["ik", "no-such-file.csv"], "", "no-such-file.csv: no such file");
    bad(
        &["fk", "-"],
        "l1_mm,l2_mm,l3_mm,a_deg,c_deg\n1438,1438,900,0,0\n",
        "-:2: strut 3 would be 900.000 mm long, 50.000 mm below",
    );
    let singular =
        table(&good(&["fk", "--frame", "base", "-"], "l1_mm,l2_mm,l3_mm,a_deg,c_deg\n1300,1250,1400,0,10\n"));
    let along = singular[0][..6].iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    bad(
        &["ik", "--frame", "base", "-"],
        &format!("{HEADER}{along}\n"),
        "-:2: singular pose: the tool points along the C axis",
    );
}

#[test]
fn ik_undoes_fk_beside_the_c_axis() {
    let header = "l1_mm,l2_mm,l3_mm,a_deg,c_deg\n";
    for tilt in [0.01, 0.03, 0.1, 0.3, 1.0] {
        for a in [tilt, -tilt] {
            let given = format!("{header}1300,1300,1250,{a},30\n1300,1250,1400,{a},-100\n1400,1350,1300,{a},170\n");
            let poses = table(&good(&["fk", "-"], &given));
            let line = |row: &Vec<f64>, part: std::ops::Range<usize>| {
                row[part].iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n"
            };
            let joints = table(&good(&["ik", "-"], &poses.iter().fold(HEADER.to_owned(), |s, r| s + &line(r, 0..6))));
            let again = table(&good(&["fk", "-"], &joints.iter().fold(header.to_owned(), |s, r| s + &line(r, 3..8))));
            for (found, pose) in again.iter().zip(&poses) {
                assert!(found[..6].iter().zip(pose).all(|(a, b)| (a - b).abs() < 1e-7), "A = {a}: {found:?} {pose:?}");
            }
        }
    }
}

#[test]
fn a_machine_file_is_checked_by_line() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("machine.toml");
    let built_in = include_str!("../src/exechon/xt700.toml");
    let path = file.to_str().unwrap();
    let refuse = |from: &str, to: &str, message: &str| {
        assert!(built_in.contains(from));
        fs::write(&file, built_in.replacen(from, to, 1)).unwrap();
        bad(&["ik", "--machine", path, "-"], HEADER, message);
    };
    refuse("xu_mm = 450.0", "xu_mm = 0.0", "line 9: xu_mm is not positive");
    refuse("a_deg = -45.0", "a_deg = 0.0", "line 21: a_deg at home points the tool along the C axis");
    refuse("a_deg = [-90.0, 90.0]", "a_deg = [90.0, -90.0]", "line 26: the range of the A axis is empty");
    refuse(
        "ys2_mm = 450.0",
        "ys2_mm = 1e200",
        "line 10: ys2_mm = 1e200 is out of range\n  expected a length in mm from -100000 to 100000",
    );
    refuse("zc_mm = 375.0", "zd_mm = 375.0", "unknown field");
}

#[test]
fn the_paper_s_experiments() {
    let text = good(&["paper"], "");
    for number in [
        "(0.2100, 0.1600)",
        "(0.2465, 0.0944)",
        "-16.32°",
        "0.0338° at the 36 touches, 0.0892° anywhere",
        "NOT reproduced",
    ] {
        assert!(text.contains(number), "{number} in\n{text}");
    }
    let quintic: Value = serde_json::from_str(&good(&["drm", "--ring=-0.625,200.914,-168"], "")).unwrap();
    assert!(quintic["largest_deviation_anywhere_deg"].as_f64().unwrap() < 0.1);
}

/// Touches of a ring at the paper's second position with the paper's offset, made here by bisection.
fn touches(compensated: bool) -> String {
    let machine = trunnion::exechon::read_machine(None).unwrap();
    let centre = [-319.135, 198.236, -168.0];
    let phi = |p: [f64; 3]| trunnion::exechon::rotation_at(&machine, p, [0.0, 0.0, 1.0]).unwrap();
    let (radius, (ox, oy)) = (17.0005, (0.21, 0.16));
    let mut lines = String::from("x_mm,y_mm,z_mm,spindle_deg\n");
    for k in 0..8 {
        let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_2).sin_cos();
        let at = |way: f64| [centre[0] + way * c, centre[1] + way * s, centre[2]];
        let spindle = if compensated { phi(at(radius)) } else { 0.0 } + if k < 4 { 0.0 } else { std::f64::consts::PI };
        let gap = |way: f64| {
            let (p, (s, c)) = (at(way), (spindle - phi(at(way))).sin_cos());
            (p[0] + c * ox - s * oy - centre[0]).hypot(p[1] + s * ox + c * oy - centre[1]) - radius
        };
        let (mut inside, mut outside) = (15.0, 20.0);
        for _ in 0..60 {
            let middle = (inside + outside) / 2.0;
            if gap(middle) < 0.0 { inside = middle } else { outside = middle }
        }
        let [x, y, z] = at(inside);
        lines += &format!("{x},{y},{z},{}\n", spindle.to_degrees());
    }
    lines
}

#[test]
fn offset_is_found_with_and_without_the_dependent_rotation() {
    for compensated in [true, false] {
        let report: Value = serde_json::from_str(&good(&["offset", "-"], &touches(compensated))).unwrap();
        let close = |value: &Value, x: f64, y: f64, within: f64| {
            let off = (value[0].as_f64().unwrap() - x).abs().max((value[1].as_f64().unwrap() - y).abs());
            assert!(off < within, "{value} is not ({x}, {y})");
        };
        close(&report["with_dependent_rotation"]["offset_mm"], 0.21, 0.16, 1e-9);
        if compensated {
            close(&report["reversal"]["exact_mm"], 0.21, 0.16, 5e-6);
        } else {
            close(&report["spindle_angle_taken_as_it_is"]["offset_mm"], 0.2465, 0.0944, 1e-4);
        }
        let met = report["touches"].as_array().unwrap();
        assert!(
            met.len() == 8 && met.iter().all(|touch| touch["deviation_um"].as_f64().unwrap().abs() < 1e-3),
            "{met:?}"
        );
        assert_eq!(report["warnings"], serde_json::json!([]));
    }
    // A touch that is 10 µm off is beyond a probe that is good to 0.125 µm, and within one that is good to 10 µm.
    let mut lines: Vec<String> = touches(true).lines().map(str::to_owned).collect();
    let (x, rest) = lines[1].split_once(',').unwrap();
    lines[1] = format!("{},{rest}", x.parse::<f64>().unwrap() - 0.01);
    let wrong = lines.join("\n");
    let warned = |more: &[&str]| -> Value {
        let report: Value = serde_json::from_str(&good(&[&["offset", "-"], more].concat(), &wrong)).unwrap();
        report["warnings"].clone()
    };
    let said = warned(&[]);
    assert!(said[0].as_str().is_some_and(|said| said.contains("stated to be good to 0.125 µm")), "{said}");
    assert_eq!(warned(&["--repeatability", "20"]), serde_json::json!([]));
    bad(&["offset", "-"], "x_mm,y_mm,z_mm,spindle_deg\n1,2,3,0\n", "at least 5");
    // What is missing is not a line, but directions and the spindle's turn.
    let four =
        "x_mm,y_mm,z_mm,spindle_deg\n16.9,200.1,-168,0\n-0.1,217.1,-168,0\n17.1,199.9,-168,180\n0.1,216.9,-168,180\n";
    bad(&["offset", "-"], four, "expected touches in four directions, and four more with the spindle reversed");
    let unturned: String = touches(true).lines().take(5).map(|line| format!("{line}\n")).collect();
    bad(&["offset", "-"], &(unturned + "-320,215,-168,16\n"), "spindle");
}

#[test]
fn a_corrected_ring_is_round() {
    let points = touches(false);
    let report = |arguments: &[&str]| -> Value { serde_json::from_str(&good(arguments, &points)).unwrap() };
    let corrected = report(&["ring", "-", "--json", "--offset", "0.21,0.16"]);
    assert!(corrected["least_squares"]["roundness_mm"].as_f64().unwrap() < 1e-9);
    assert!((corrected["least_squares"]["diameter_mm"].as_f64().unwrap() - 40.001).abs() < 1e-9);
    assert!(report(&["ring", "-", "--json"])["least_squares"]["roundness_mm"].as_f64().unwrap() > 0.1);
    let xyz = "x_mm,y_mm,z_mm\n";
    let three = good_json(&["ring", "-", "--json"], &format!("{xyz}17.8,200,-168\n-8.7,215.2,-168\n-8.8,184.8,-168\n"));
    assert_eq!(three["least_squares"]["standard_uncertainty_mm"], Value::Null);
    assert_eq!(three["least_squares"]["residual_std_mm"], Value::Null);
    bad(&["ring", "-"], &format!("{xyz}1,2,3\n4,5,6\n"), "2 point(s) where a circle needs at least 3");
    bad(&["ring", "-"], &format!("{xyz}1,2,3\n1,2,3\n1,2,3\n1,2,3\n"), "all points are equal");
    bad(&["ring", "-"], &format!("{xyz}1,2,3\n2,4,3\n3,6,3\n4,8,3\n"), "on a straight line");
}

#[test]
fn repeats_give_their_spread() {
    let mut points = String::from("x_mm,y_mm,z_mm\n");
    for repeat in [-1.0, 0.0, 1.0] {
        for k in 0..36 {
            let (angle, r) = (f64::from(k * 10).to_radians(), 17.0 + 0.002 * repeat);
            points += &format!("{},{},0\n", r * angle.cos(), r * angle.sin());
        }
    }
    let report: Value = serde_json::from_str(&good(&["ring", "-", "--json"], &points)).unwrap();
    assert_eq!(report["places"].as_array().unwrap().len(), 36);
    assert!((report["largest_std_mm"].as_f64().unwrap() - 0.002).abs() < 1e-12);
}

#[test]
fn plans_keep_the_probe_s_orientation() {
    let plan = |feature: &str, size: &str| {
        table(&good(&["plan", feature, "--centre=-319.135,198.236,-168", "--size", size], ""))
    };
    let (ring, plane, sphere) = (plan("ring", "40.001"), plan("plane", "60"), plan("sphere", "30"));
    assert_eq!((ring.len(), plane.len(), sphere.len()), (36, 16, 13));
    for touch in ring.iter().chain(&plane).chain(&sphere) {
        let pose = format!("{HEADER}{},{},{},0,0,1\n", touch[3], touch[4], touch[5]);
        let drm = table(&good(&["drm", "-"], &pose))[0][3];
        assert!((drm.rem_euclid(360.0) - touch[6]).abs() < 1e-9);
    }
    // From inside the ring; from the spindle's side, where z is less, elsewhere.
    assert!(ring[0][0] < ring[0][3] && plane.iter().chain(&sphere).all(|t| t[2] <= t[5]));
    let program =
        good(&["plan", "ring", "--centre=-319.135,198.236,-168", "--size", "40", "--format", "sinumerik"], "");
    for word in ["SPOS=PHI", "MEAS=1", "DEF REAL C5=", "M30"] {
        assert!(program.contains(word), "{word}");
    }
    bad(&["plan", "ring", "--centre=0,0,900", "--size", "40"], "", "touch 1: ");
}
