//! Proposed on the command line, taken by `trunnion new`, fitted.

use crate::program::{succeeds, trunnion};
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use serde_json::Value;
use std::fs;
use std::path::Path;
use trunnion::study::{ErrorLimits, Population, Setup};
use trunnion_codegen::kinematics::ErrorValues;

#[test]
fn proposed_positions_are_probed_and_fitted() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let plan = ["plan", "ac-trunnion-probe", "--positions", "25", "--in-all", "--step-deg", "15"];
    let object: Value =
        serde_json::from_str(&succeeds(at, &[&plan[..], &["--json", "--out", "at.toml"]].concat())).unwrap();
    succeeds(at, &["new", "ac-trunnion-probe", "--at", "at.toml", "--touch-mm", "12.5", "--out", "p"]);
    let sheet = fs::read_to_string(at.join("p/measuring-plan.md")).unwrap();

    // A machine within the limits, read at the positions that the programs go to.
    let setup = Setup::from_catalogue("ac-trunnion-probe", &[]).unwrap();
    let positions: Vec<Vec<f64>> = object["runs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|run| {
            let own: Vec<f64> = run["proposed_deg"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            let name = run["name"].as_str().unwrap();
            let program = fs::read_to_string(at.join("p").join(format!("{name}.linuxcnc.ngc"))).unwrap();
            let called = program.lines().filter(|line| line.starts_with("o300 call"));
            let swept = called.map(|line| line.rsplit_once('[').unwrap().1.trim_end_matches(']').parse().unwrap());
            assert_eq!(swept.collect::<Vec<f64>>(), own, "{name}");
            let listed: Vec<String> = own.iter().map(|x| format!("{x:.2}")).collect();
            assert!(sheet.contains(&format!("* Positions: {}°.", listed.join("°, "))), "{sheet}");
            own.into_iter().map(f64::to_radians).collect()
        })
        .collect();
    assert_eq!(positions.iter().map(Vec::len).sum::<usize>(), 25);
    let runs = setup.measurements();
    let exact: Vec<_> =
        runs.iter().zip(&positions).flat_map(|(own, at)| own.runs.iter().map(|run| setup.exact(*run, at))).collect();
    let limits = ErrorLimits { length: 1e-3, angle: 1e-6 };
    let machine = Population::new(&setup, &exact, limits).draw(&mut ChaCha8Rng::seed_from_u64(3));
    for (measurement, own) in runs.iter().zip(&positions) {
        let along: Vec<Vec<f64>> =
            measurement.runs.iter().map(|run| setup.exact(*run, own).values(&machine).collect()).collect();
        let mut text = "a_deg,dx_mm,dy_mm,dz_mm\n".replace('a', if measurement.name == "a" { "a" } else { "c" });
        for (i, sweep) in own.iter().enumerate() {
            text += &format!("{},{},{},{}\n", sweep.to_degrees(), along[0][i], along[1][i], along[2][i]);
        }
        fs::write(at.join("p").join(format!("{}.csv", measurement.name)), text).unwrap();
    }
    let fit: Value = serde_json::from_str(&succeeds(at, &["fit", "p", "--json"])).unwrap();
    for function in fit["functions"].as_array().unwrap() {
        let name = function["name"].as_str().unwrap();
        let id = setup.estimated().find(|f| setup.function_name(*f) == name).unwrap();
        let truth = setup.quantity(id).deviation().from_inner(machine.value(setup.model.functions[id].error, 0.0));
        assert!((function["points"][0]["value"].as_f64().unwrap() - truth).abs() < 1e-3, "{name}: {truth}");
        // The sheet's valuation is what was proposed with.
        let said = object["functions"].as_array().unwrap().iter().find(|own| own["name"] == name).unwrap();
        let valuation = said["proposed"]["valuation"].as_f64().unwrap();
        let words =
            if said["unit"] == "um/um" { format!("{valuation:.4} µm/µm") } else { format!("{valuation:.6} °/µm") };
        assert!(sheet.contains(&format!("| {name} | {words} |")), "{name}: {words}\n{sheet}");
    }
}

#[test]
fn a_project_keeps_its_positions() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    succeeds(at, &["new", "ac-trunnion-probe", "--positions", "7", "--touch-mm", "11.5", "--out", "p"]);
    let folder = at.join("p");
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let (project, program) = (read("trunnion.toml"), read("a.linuxcnc.ngc"));
    let listed = "a = [-90, -70, -50, -30, -10, 10, 30]\n";
    assert!(project.contains(listed), "{project}");
    // As they were they give the same.
    succeeds(&folder, &["new", "--force"]);
    assert_eq!(read("a.linuxcnc.ngc"), program);
    succeeds(at, &["new", "p", "--force", "--touch-mm", "12.5"]);
    assert_ne!(read("a.linuxcnc.ngc"), program);

    let moved = "a = [-90, -70.5, -50, -30, -10, 10]\n";
    fs::write(folder.join("trunnion.toml"), project.replace(listed, moved)).unwrap();
    succeeds(at, &["new", "p", "--force"]);
    assert!(read("measuring-plan.md").contains("* Positions: -90.00°, -70.50°, -50.00°, -30.00°, -10.00°, 10.00°."));
    assert_eq!(read("a.linuxcnc.ngc").lines().filter(|line| line.starts_with("o300 call")).count(), 6);
    // Options are put over it, and other commands have no use for it.
    succeeds(at, &["new", "p", "--positions", "9", "--out", "nine"]);
    assert!(fs::read_to_string(at.join("nine/measuring-plan.md")).unwrap().contains("A sphere probed at 9 positions"));
    fs::write(
        at.join("at.toml"),
        format!(
            "[positions_deg]\n{}",
            project.split_once("[positions_deg]\n").unwrap().1.split_once("\n\n").unwrap().0
        ),
    )
    .unwrap();
    succeeds(at, &["new", "p", "--at", "at.toml", "--out", "file"]);
    assert!(fs::read_to_string(at.join("file/measuring-plan.md")).unwrap().contains("A sphere probed at 7 positions"));
    assert!(succeeds(&folder, &["derive"]).contains("ac-trunnion-probe"));

    for (wrong, told) in [
        ("a = [-90, -70, -50, -30, -10, 10, 31]\n", "axis A would go to 31"),
        ("a = [-90]\n", ": 1 positions\n  expected 4 to 1000"),
        ("a = [-90, -70, -50, -30, -10, 10, \"30\"]\n", ": invalid type: string"),
        ("b = [-90, -70, -50, -30, -10, 10, 30]\n", "no positions of run a"),
    ] {
        fs::write(folder.join("trunnion.toml"), project.replace(listed, wrong)).unwrap();
        let line = 1 + project.split_once(listed).unwrap().0.matches('\n').count();
        let message = refused(at, &["new", "p", "--force"]);
        let place =
            if wrong.starts_with('b') { "trunnion.toml: ".to_owned() } else { format!("trunnion.toml: line {line}: ") };
        assert!(message.contains(&place) && message.contains(told), "{wrong}: {message}");
    }
    let touch = "touch_mm = 11.5\n";
    for wrong in ["0", "-1", "nan", "2e5", "\"1\""] {
        fs::write(folder.join("trunnion.toml"), project.replace(touch, &format!("touch_mm = {wrong}\n"))).unwrap();
        let line = 1 + project.split_once(touch).unwrap().0.matches('\n').count();
        let message = refused(at, &["new", "p", "--force"]);
        assert!(message.contains(&format!("trunnion.toml: line {line}: ")), "{wrong}: {message}");
    }
}

fn refused(at: &Path, arguments: &[&str]) -> String {
    let output = trunnion(at, arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
    assert!(message.contains("expected"), "{arguments:?}: {message}");
    message
}

#[test]
fn what_is_no_plan_of_positions_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let refused = |arguments: &[&str], told: &str| {
        let message = refused(at, arguments);
        assert!(message.contains(told), "{arguments:?}: {message}");
    };
    let plan = |more: &[&str], told: &str| refused(&[&["plan", "ac-trunnion-probe"][..], more].concat(), told);
    plan(&["--positions", "12", "--step-deg", "15"], "12 positions of run a: 9 to choose from");
    plan(&["--positions", "8", "--in-all"], "of all runs\n  expected 1");
    plan(&["--positions", "3"], "3 positions of run a\n  expected 4 at least");
    plan(&["--positions", "900", "--in-all"], "of all runs");
    plan(&["--positions", "fewest"], "no --within");
    plan(&["--positions", "9", "--within", "2"], "no effect");
    plan(&["--positions", "fewest", "--within", "2,3"], "one for each of the 8");
    plan(&["--positions", "fewest", "--within", "0.001"], "EY0A: all");
    plan(&["--positions", "9", "--radius", "100,200"], "one length");
    plan(&["--positions", "two"], "a number of positions");
    let new = |told: &str| refused(&["new", "ac-trunnion-probe", "--at", "at.toml", "--out", "none"], told);
    for (text, told) in [
        ("[positions]\n", "line 1: unknown field"),
        ("[positions_deg]\na = [1, 2, 3, 4, 5, 6, 7]\nc = [1, 2, 3, 4, 5, 6, 7]\n", "no positions of run c-tilted"),
        ("[positions_deg]\na = [1, 2]\n", "line 2: 2 positions"),
        ("[positions_deg]\na = [1, 2, 3,\n 2]\n", "line 3: 2 is no position"),
        ("[positions_deg]\na = [1, 2, 3, nan]\n", "line 2: NaN is no position"),
        ("[positions_deg]\na = [1, 2, 3, 31]\n", "axis A would go to 31"),
        (
            "[positions_deg]\na = [1, 2, 3, 4, 5, 6, 7]\nc = [1, 2, 3, 4, 5, 6, 7]\nc-tilted = [1, 2, 3, 4, 5, 6, 7]\nd = [1]\n",
            "line 5: no run `d`",
        ),
    ] {
        fs::write(at.join("at.toml"), text).unwrap();
        new(told);
    }
    refused(&["new", "tilting-table-a", "--at", "at.toml", "--out", "none"], "three displacements");
    refused(&["new", "ac-trunnion-probe", "--touch-mm", "12", "--out", "none"], "nothing is touched");
    assert!(!at.join("none").exists());
}

#[test]
fn the_page_has_what_is_proposed() {
    let directory = tempfile::tempdir().unwrap();
    let told = succeeds(directory.path(), &["plan", "ac-trunnion-probe", "--positions", "24", "--in-all"]);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/pivots.md");
    let page = fs::read_to_string(path).unwrap();
    let (before, rest) = page.split_once("--test positions` -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end of positions -->").unwrap();
    let now = format!("{before}--test positions` -->\n```text\n{told}```\n<!-- end of positions -->{after}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(path, now).unwrap();
    } else {
        assert_eq!(page, now, "set UPDATE_DOCS to write docs/pivots.md anew");
    }
}
