//! A machine that no one compiled in, from the command line: derived, planned, simulated, fitted.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A table that turns about y on a slide along x, under a column along z; a bar and displacements of a ball.
const MODEL: &str = r#"
name = "slide-table"
title = "Table B on the slide X under Z"
constants = ["R", "L"]
workpiece = ["X", "B"]
tool = ["Z"]
estimate = ["EBB"]

[axis.X]
linear = "x"

[axis.B]
rotary = "y"
location = ["EX0B", "EZ0B", "EA0B", "EB0B", "EC0B"]

[axis.Z]
linear = "z"
location = ["EB(0X)Z"]

[run.bar]
sweep = "b"
at = { X = "-L*sin(b)", B = "b", Z = "L*cos(b) + R" }
workpiece_ball = { at = ["0", "0", "L"], setup = ["w_x", "w_y", "w_z"] }
tool_ball = { setup = ["t_x", "t_y", "t_z"] }
reading = "R"

[run.ball]
sweep = "b"
at = { X = "-L*sin(b)", B = "b", Z = "L*cos(b)" }
workpiece_ball = { at = ["0", "0", "L"], setup = ["w_x", "w_y", "w_z"] }
tool_ball = { setup = ["t_x", "t_y", "t_z"] }
reading = { displacement = "xyz" }

[function]
EXX = { polynomial = 1 }
EYX = { polynomial = 1 }
EZX = { polynomial = 1 }
EAX = { polynomial = 1 }
EBX = { polynomial = 1 }
ECX = { polynomial = 1 }
EXB = { fourier = 1 }
EYB = { fourier = 1 }
EZB = { fourier = 1 }
EAB = { fourier = 1 }
EBB = { fourier = 2 }
ECB = { fourier = 1 }
EXZ = { polynomial = 1 }
EYZ = { polynomial = 1 }
EZZ = { polynomial = 1 }
"#;
const LENGTHS: [&str; 4] = ["--radius", "150", "--set", "L=200"];

fn trunnion(directory: &Path, command: &str, more: &[&str]) -> String {
    let mut arguments = vec![command, "slide-table.toml"];
    arguments.extend(more);
    let run = Command::new(env!("CARGO_BIN_EXE_trunnion")).current_dir(directory).args(&arguments).output().unwrap();
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.success(), "{arguments:?}: {said}");
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn a_machine_of_ones_own_goes_through_every_command() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    fs::write(at.join("slide-table.toml"), MODEL).unwrap();

    let derived = trunnion(at, "derive", &LENGTHS);
    for said in ["Run ball-z", "only appear", "Predicted with R = 150 mm, L = 200 mm", "EBB: std at most"] {
        assert!(derived.contains(said), "{said}: {derived}");
    }

    let small = ["--length-um", "0.03", "--angle-urad", "0.1", "--noise-um", "0", "--out", "files"];
    trunnion(at, "simulate", &[&LENGTHS[..], &small].concat());
    let names = ["bar", "ball-x", "ball-y", "ball-z"];
    let runs: Vec<String> = names.iter().flat_map(|n| ["--run".into(), format!("{n}=files/{n}.csv")]).collect();
    let runs: Vec<&str> = runs.iter().map(String::as_str).collect();
    let bounds = ["--length-um", "0.03", "--angle-urad", "0.1", "--json"];
    let one = |runs: &[&str]| -> Value {
        serde_json::from_str(&trunnion(at, "fit", &[&LENGTHS[..], runs, &bounds].concat())).unwrap()
    };
    let fit = one(&runs);
    let truth: Value = serde_json::from_str(&fs::read_to_string(at.join("files/truth.json")).unwrap()).unwrap();
    for c in fit["coefficients"].as_array().unwrap() {
        let (name, value) = (c["name"].as_str().unwrap(), c["value"].as_f64().unwrap());
        let expected = truth[name].as_f64().unwrap();
        // Errors of 3e-5 mm and 1e-7 rad, and a millionth of the paper's second order.
        assert!((value - expected).abs() < 2e-9, "{name}: {value:e} {expected:e}");
    }
    let function = &fit["functions"][0];
    let number = |key: &str| function[key].as_f64().unwrap();
    assert!(number("neglected_typical") > 0.0 && number("neglected_typical") < number("neglected"));
    assert!(function["neglected_terms"][0]["errors"].as_str().unwrap().contains('·'));

    // All three displacements in one file.
    let column = |name: &str| -> Vec<(String, String)> {
        let text = fs::read_to_string(at.join(format!("files/{name}.csv"))).unwrap();
        text.lines().skip(1).filter_map(|l| l.split_once(',')).map(|(a, d)| (a.to_owned(), d.to_owned())).collect()
    };
    let (x, y, z) = (column("ball-x"), column("ball-y"), column("ball-z"));
    let mut all = String::from("b_deg,dx_um,dy_um,dz_um\n");
    for ((x, y), z) in x.iter().zip(&y).zip(&z) {
        all += &format!("{},{},{},{}\n", x.0, x.1, y.1, z.1);
    }
    fs::write(at.join("all.csv"), all).unwrap();
    let (mut together, mut apart) = (one(&["--run", "bar=files/bar.csv", "--run", "ball=all.csv"]), fit);
    // By another command, of other files.
    [&mut together, &mut apart].into_iter().for_each(|fit| drop(fit["made"].take()));
    assert_eq!(together, apart);

    let text = trunnion(at, "plan", &[&LENGTHS[..], &["--range-deg", "0:360,-90:90"]].concat());
    for said in ["0…360°", "-90…90°", "without bar", "EBB", "cannot tell apart"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let plan: Value =
        serde_json::from_str(&trunnion(at, "plan", &[&LENGTHS[..], &["--json", "--without", "bar,ball-x"]].concat()))
            .unwrap();
    assert_eq!(plan["plans"].as_array().unwrap().len(), 6, "two subsets, three ranges");
    let carlo = trunnion(at, "monte-carlo", &[&LENGTHS[..], &["--trials", "20", "--estimator", "joint"]].concat());
    assert!(carlo.contains("linearisation"), "{carlo}");
}
