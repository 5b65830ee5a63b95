//! The program as a user meets it: what it writes, what it prints, and what it says of bad input.

mod bad_input;
mod catalogue;
#[path = "../program/mod.rs"]
mod program;

use program::{succeeds, trunnion};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const MODEL: &str = "tilting-table-a";
const FIT: [&str; 5] = ["fit", MODEL, "--radius", "150", "--json"];
const RUNS: [&str; 4] = ["--run", "tilting=tilting.csv", "--run", "separation=separation.csv"];
const TABLE: [&str; 2] = ["--table", "table.csv"];

fn text(bytes: &[u8]) -> &str {
    str::from_utf8(bytes).unwrap()
}

fn object(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// A directory with the files of a simulated machine.
fn simulated(more: &[&str]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let arguments = ["simulate", MODEL, "--radius", "150", "--out", "."];
    succeeds(directory.path(), &[&arguments[..], more].concat());
    directory
}

fn fitted(directory: &Path, more: &[&str]) -> Value {
    object(&succeeds(directory, &[&FIT[..], &RUNS, &TABLE, more].concat()))
}

fn points(fit: &Value) -> Vec<[f64; 3]> {
    let points = fit["functions"][0]["points"].as_array().unwrap();
    points.iter().map(|p| ["a_deg", "value", "u95"].map(|key| p[key].as_f64().unwrap())).collect()
}

#[test]
fn demo_writes_its_figures_and_measurements() {
    let directory = tempfile::tempdir().unwrap();
    let out = succeeds(directory.path(), &["demo", "--out", "figures"]);
    for said in ["k1 ", "Not seen", "largest error", "95 % band", "2.643", "two-step", "joint", "µm of tilting"] {
        assert!(out.contains(said), "{said}");
    }
    let read = |file: &str| fs::read_to_string(directory.path().join("figures").join(file)).unwrap();
    for figure in ["fig3.svg", "fig4.svg"] {
        assert!(read(figure).starts_with("<svg") && read(figure).trim_end().ends_with("</svg>"), "{figure}");
    }
    for run in ["tilting.csv", "separation.csv", "table.csv"] {
        assert_eq!(read(run).lines().count(), 361, "{run}");
    }
    assert_eq!(object(&read("truth.json"))["radius_mm"], 150.0);
    let written = || directory.path().join("figures").read_dir().unwrap().count();
    assert_eq!(written(), 6);
    succeeds(directory.path(), &["demo", "--out", "figures"]);
    assert_eq!(written(), 6, "again into the same directory");
}

#[test]
fn derive_prints_every_form() {
    let here = tempfile::tempdir().unwrap();
    let emit = |form| succeeds(here.path(), &["derive", MODEL, "--emit", form]);
    assert_eq!(emit("text"), succeeds(here.path(), &["derive", MODEL]));
    assert!(emit("latex").contains("\\delta"));
    assert!(emit("rust").contains("pub fn tilting"));
    let derived = object(&emit("json"));
    assert_eq!((&derived["model"], &derived["rank"]), (&Value::from(MODEL), &Value::from(11)));
    assert_eq!(derived["kernel"].as_array().unwrap().len(), 7, "18 parameters of rank 11");
}

/// A sum as its signed terms, each with its factors sorted: the order of terms and factors is the printer's own affair.
fn terms(sum: &str) -> Vec<String> {
    let spaced = sum.replace(' ', "").replace("**", "^").replace('-', "+-");
    let term = |t: &str| {
        let (sign, t) = t.strip_prefix('-').map_or(("", t), |t| ("-", t));
        let mut factors: Vec<&str> = t.split('*').collect();
        factors.sort_unstable();
        format!("{sign}{}", factors.join("*"))
    };
    let mut terms: Vec<String> = spaced.split('+').filter(|t| !t.is_empty()).map(term).collect();
    terms.sort_unstable();
    terms
}

#[test]
fn derive_gives_the_papers_coefficients_and_regressors() {
    let here = tempfile::tempdir().unwrap();
    let derived = object(&succeeds(here.path(), &["derive", MODEL, "--emit", "json"]));
    // Eqs. (7) and (9) with the misprints corrected; w_z1 goes with k8 R, whose regressor is the same.
    let definitions = [
        ("k1", "d_yz2 - d_yy2"),
        ("k2", "-e_xy2"),
        ("k3", "-e_xy1 - d_zz2 + d_zy2"),
        ("k4", "d_yz1 + d_zy1 - s_xz"),
        ("k5", "d_yy1 - d_zz1"),
        ("k6", "d_yy2*R**2 - o_ya + t_y1"),
        ("k7", "-d_zy2*R**2 + o_za - t_z1"),
        ("k8", "w_z1 - d_zy1*R"),
        ("k9", "d_yy2*R**2 - w_y2 + t_y1"),
        ("k10", "d_zz2*R**2 - w_z2 + t_z1"),
        ("k11", "d_zz1"),
    ];
    let coefficients = derived["coefficients"].as_array().unwrap();
    let lumped: Vec<_> = coefficients.iter().filter(|c| c["name"].as_str().unwrap().starts_with('k')).collect();
    assert_eq!(lumped.len(), definitions.len());
    for (found, (name, definition)) in lumped.into_iter().zip(definitions) {
        assert_eq!(found["name"], name);
        assert_eq!(terms(found["definition"].as_str().unwrap()), terms(definition), "{name}");
    }
    let regressors: [(&str, &[(&str, &str)]); 2] = [
        (
            "tilting",
            &[
                ("e_xa1", "R*a**4 - 2*pi*R*a**3 - 2*pi**2*R*a**2 + 4*pi**3*R*a"),
                ("e_xa2", "R*a**3 - 3*pi*R*a**2 + 2*pi**2*R*a"),
                ("k1", "R**2*s**3"),
                ("k2", "R**3*s**2*c**2"),
                ("k3", "R**2*s**2*c"),
                ("k4", "R*s**2"),
                ("k5", "R*s*c"),
                ("k6", "s"),
                ("k7", "c"),
                ("k8", "1"),
            ],
        ),
        (
            "separation",
            &[
                ("k1", "R**2*s**2*c"),
                ("k2", "R**3*s*c**3"),
                ("k3", "R**2*s*c**2"),
                ("k4", "R*s*c"),
                ("k5", "R*c**2"),
                ("k9", "c"),
                ("k10", "s"),
                ("k11", "R"),
            ],
        ),
    ];
    let runs = derived["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2);
    for (run, (name, expected)) in runs.iter().zip(regressors) {
        assert_eq!(run["name"], name);
        let found = run["regressors"].as_object().unwrap();
        assert_eq!(found.len(), expected.len(), "{name}");
        for (k, regressor) in expected {
            assert_eq!(terms(found[*k].as_str().unwrap()), terms(regressor), "{name}, {k}");
        }
    }
}

#[test]
fn what_is_simulated_is_recovered_within_the_band() {
    // Small errors: what linearisation drops has no part in it.
    let directory = simulated(&["--seed", "3", "--length-um", "0.03", "--angle-urad", "0.1"]);
    let truth = object(&fs::read_to_string(directory.path().join("truth.json")).unwrap());
    let truth = truth["eps_xa"].as_array().unwrap();
    for estimator in ["joint", "two-step"] {
        let fit = fitted(directory.path(), &["--estimator", estimator]);
        assert_eq!((&fit["model"], &fit["estimator"]), (&Value::from(MODEL), &Value::from(estimator)));
        assert_eq!((&fit["radius_mm"], &fit["warnings"]), (&Value::from(150.0), &Value::Array(Vec::new())));
        assert!(fit["condition"].as_f64().unwrap() > 1.0);
        for run in ["tilting", "separation"] {
            let run = &fit["runs"][run];
            assert_eq!(run["samples"], 360);
            // ±0.1 µm uniform has 0.058 µm rms.
            assert!((0.05..0.065).contains(&run["rms_um"].as_f64().unwrap()), "{run}");
        }
        let coefficients = fit["coefficients"].as_array().unwrap();
        assert_eq!(coefficients.len(), 13);
        for c in coefficients {
            assert!(c["name"].is_string() && c["unit"].is_string() && c["value"].is_f64());
            assert!(c["std"].as_f64().unwrap() > 0.0);
        }
        assert_eq!((&fit["functions"][0]["name"], &fit["functions"][0]["unit"]), (&"eps_xa".into(), &"urad".into()));
        let points = points(&fit);
        let angles: Vec<f64> = points.iter().map(|p| p[0]).collect();
        // Every 5°, and where the last sample is.
        assert_eq!(angles, (0..72).map(|i| f64::from(i) * 5.0).chain([359.0]).collect::<Vec<_>>());
        let inside = points[..72].iter().zip(truth).filter(|([a, value, u95], truth)| {
            assert_eq!(truth["a_deg"], *a);
            (value - truth["urad"].as_f64().unwrap()).abs() <= *u95 + 1e-9
        });
        // Two coefficients make the whole curve: it lies inside nearly everywhere or, one time in ten, is off in a part.
        let inside = inside.count();
        assert!(inside >= 68, "{estimator}: {inside} of 72");
    }
}

#[test]
fn a_seed_gives_the_same_files_and_another_seed_others() {
    let read = |d: &TempDir, file: &str| fs::read(d.path().join(file)).unwrap();
    let [one, same, other] = ["5", "5", "6"].map(|seed| simulated(&["--seed", seed]));
    for file in ["tilting.csv", "separation.csv", "table.csv", "truth.json"] {
        assert_eq!(read(&one, file), read(&same, file), "{file}");
        assert_ne!(read(&one, file), read(&other, file), "{file}");
    }
}

#[test]
fn warnings_go_to_standard_error_and_into_the_object() {
    let directory = simulated(&[]);
    let output = trunnion(directory.path(), &[&FIT[..], &RUNS].concat());
    assert_eq!(output.status.code(), Some(0));
    let fit = object(text(&output.stdout));
    let warnings: Vec<&str> = fit["warnings"].as_array().unwrap().iter().map(|w| w.as_str().unwrap()).collect();
    let expected = ["the known functions, taken as zero, are in them", "dya", "dza"];
    assert!(warnings.len() == 3 && warnings.iter().zip(expected).all(|(w, said)| w.contains(said)), "{warnings:?}");
    let said: String = warnings.iter().map(|w| format!("warning: {w}\n")).collect();
    assert_eq!(text(&output.stderr), said);
    let arc = simulated(&["--to-deg", "90"]);
    let output = trunnion(arc.path(), &[&FIT[..], &RUNS, &TABLE].concat());
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stderr).contains("hardly tell"), "{}", text(&output.stderr));
    let output = trunnion(arc.path(), &["monte-carlo", MODEL, "--radius", "150", "--trials", "3", "--to-deg", "90"]);
    assert!(text(&output.stderr).contains("hardly tell"), "{}", text(&output.stderr));
}

#[test]
fn samples_may_come_in_any_order() {
    let directory = simulated(&[]);
    let sorted = fitted(directory.path(), &[]);
    for file in ["tilting.csv", "separation.csv", "table.csv"] {
        let path = directory.path().join(file);
        let read = fs::read_to_string(&path).unwrap();
        let (header, rest) = read.split_once('\n').unwrap();
        let mut lines: Vec<&str> = rest.lines().collect();
        // 7 shares no factor with 360: every line once.
        lines = (0..lines.len()).map(|i| lines[i * 7 % lines.len()]).collect();
        fs::write(&path, format!("{header}\n{}\n", lines.join("\n"))).unwrap();
    }
    let shuffled = fitted(directory.path(), &[]);
    for (a, b) in points(&sorted).iter().zip(points(&shuffled)) {
        assert!((a[1] - b[1]).abs() <= 1e-12 * (1.0 + a[1].abs()), "{a:?} {b:?}");
    }
}

#[test]
fn a_weight_moves_the_joint_estimate_only() {
    let directory = simulated(&[]);
    let differs = |more: &[&str]| {
        let plain = fitted(directory.path(), more);
        let weighted = fitted(directory.path(), &[more, &["--weight", "tilting=4"]].concat());
        points(&plain).iter().zip(points(&weighted)).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max)
    };
    assert!(differs(&["--estimator", "joint"]) > 1e-3);
    assert!(differs(&["--estimator", "two-step"]) < 1e-9);
}

#[test]
fn monte_carlo_depends_on_its_seed_alone() {
    let here = tempfile::tempdir().unwrap();
    let run = |seed| {
        let arguments =
            ["monte-carlo", MODEL, "--radius", "150", "--trials", "20", "--samples", "36", "--json", "--seed"];
        object(&succeeds(here.path(), &[&arguments[..], &[seed]].concat()))
    };
    assert_eq!(run("1"), run("1"));
    assert_ne!(run("1"), run("2"));
    assert_eq!(run("1")["trials"], 20);
    let arguments = ["monte-carlo", MODEL, "--trials", "40", "--samples", "36"];
    let on = |threads: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trunnion"));
        let output =
            command.current_dir(here.path()).args(arguments).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        output.stdout
    };
    assert_eq!(on("1"), on("3"));
    let rows = |more: &[&str]| -> Vec<String> {
        let said = succeeds(here.path(), &[&arguments[..], more].concat());
        said.lines()
            .filter(|line| line.contains("step  noise ") || line.contains("joint     noise "))
            .map(str::to_owned)
            .collect()
    };
    let noise = rows(&["--noise-alone"]);
    assert!(noise.len() == 2 && noise == rows(&[]), "{noise:?}");
}

/// Which runs are enough is said of the same measurement as what all of them give.
#[test]
fn an_axis_range_counts_for_which_runs_are_enough() {
    let here = tempfile::tempdir().unwrap();
    let plan = ["plan", "tilting-table-b", "--radius", "150", "--range-deg", "0:360", "--json"];
    let of = |more: &[&str]| {
        let plan = object(&succeeds(here.path(), &[&plan[..], more].concat()));
        let all = plan["plans"][0]["functions"][0]["largest_u95"].as_f64().unwrap();
        // Coverage factors of few and of many readings.
        assert!((plan["recommended"][0]["best"].as_f64().unwrap() / all - 1.0).abs() < 0.03, "{more:?}: {plan}");
        all
    };
    assert!(of(&["--range", "B=-30:30"]) > 5.0 * of(&[]));
}
