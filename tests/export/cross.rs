//! Errors that are none of the axis' own position: what another axis takes off, and what stands under its ISO name.

use crate::machine::Trim;
use crate::program::succeeds;
use crate::readers;
use std::f64::consts::TAU;
use trunnion::export::{Grid, OneFormat, Subject, Table, TakenOff, Told, write};
use trunnion::study::{ErrorLimits, Estimator, Observation, Population, Setup, SimulatedMachine, fit};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::catalogue::source;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;

use chacha20::ChaCha8Rng;
use rand::SeedableRng;

/// A machine whose tool stands further along y by what an axis was moved.
struct Moved<'a> {
    machine: &'a SimulatedMachine,
    tool: Option<[ErrorId; 3]>,
    by: f64,
}

impl ErrorValues for Moved<'_> {
    fn value(&self, error: ErrorId, x: f64) -> f64 {
        let moved = self.tool.is_some_and(|tool| tool[1] == error);
        self.machine.value(error, x) + if moved { self.by } else { 0.0 }
    }
}

/// Every run over a turn, the tool moved along y by what the trim of A's position gives, times `factor`.
fn measured(setup: &Setup, machine: &SimulatedMachine, trim: Option<&Trim>, factor: f64) -> Vec<Observation> {
    let one = |run| {
        let mut observation = Observation::zero(setup, run, &setup.swept(run, 181, (0.0, TAU)));
        for sample in &mut observation.samples {
            let exact = setup.exact(run, &[sample.sweep]);
            let by = trim.map_or(0.0, |trim| factor * trim(sample.sweep.to_degrees(), true));
            let moved = Moved { machine, tool: setup.model.runs[run].tool_ball.setup, by };
            sample.reading = exact.values(&moved).next().unwrap();
        }
        observation
    };
    setup.model.runs.keys().map(one).collect()
}

#[test]
fn another_axis_takes_a_displacement_off() {
    let text = source("tilting-table-a-dyz").unwrap();
    // The axis as it is, and one whose positive motion is the other way.
    for (direction, sense) in [("linear = \"y\"", -1.0), ("linear = \"-y\"", 1.0)] {
        let setup = Setup::from_description(&text.replace("linear = \"y\"", direction), &[]).unwrap();
        let function = setup.estimated().next().unwrap();
        let subject = Subject::new(&setup, function, None).unwrap();
        assert_eq!(subject.iso, "EYA");
        // The workpiece is displaced as the error says: the tool against it the other way.
        assert_eq!(subject.taken_off, TakenOff::Other("Y".to_owned(), sense));
        let exact: Vec<ExactReading> =
            setup.model.runs.keys().map(|run| setup.exact(run, &setup.swept(run, 181, (0.0, TAU)))).collect();
        let machine = Population::new(&setup, &exact, ErrorLimits::PAPER).draw(&mut ChaCha8Rng::seed_from_u64(3));
        let value = |observations: &[Observation], at: f64| {
            fit(&setup, observations, Estimator::Joint).unwrap().function(&setup, function, at.to_radians()).0
        };
        let before = measured(&setup, &machine, None, 0.0);
        let grid = Grid::new(0.0, 360.0, 5.0).unwrap();
        let table = Table::new(subject, grid, false, |at| [value(&before, at); 2]);
        let written =
            write(&table, OneFormat::Cec, &Told { output: Some("AX2".to_owned()), ..Told::default() }).unwrap();
        assert!(written.text.contains("$AN_CEC_INPUT_AXIS[0]=(A)\n$AN_CEC_OUTPUT_AXIS[0]=(AX2)\n"));
        let trim = readers::cec(&written.text);
        // Y is told so much more; its positive motion is −sense along y.
        let [after, wrong] = [1.0, -1.0].map(|sign| measured(&setup, &machine, Some(&trim), sign * -sense));
        let largest = grid.points().map(|at| value(&before, at).abs()).fold(0.0, f64::max);
        for at in grid.points().step_by(6) {
            let [before, after, wrong] = [&before, &after, &wrong].map(|observations| value(observations, at));
            assert!(after.abs() < 0.02 * largest, "{at}: {before} {after}, at most {largest}");
            assert!((wrong - 2.0 * before).abs() < 0.02 * largest, "{at}: {before} {wrong}");
        }
        // Under its ISO name it is the error itself.
        let heidenhain = write(&table, OneFormat::Heidenhain, &Told::default()).unwrap().text;
        assert!(heidenhain.lines().nth(1).unwrap().ends_with(" C2"), "{heidenhain}");
        assert!((readers::heidenhain(&heidenhain)(90.0, true) + value(&before, 90.0)).abs() < 1e-6);
        for own in [OneFormat::LinuxCnc, OneFormat::Sinumerik840d, OneFormat::Fanuc] {
            let message = write(&table, own, &Told::default()).unwrap_err().to_string();
            assert!(message.starts_with("not the axis' own position"), "{message}");
        }
    }
}

#[test]
fn all_identified_errors_are_in_the_volumetric_files() {
    for model in ["ac-trunnion", "rotary-table-c-rtest"] {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        succeeds(at, &["simulate", model, "--seed", "2", "--samples", "180", "--out", "."]);
        let files = std::fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut files: Vec<String> = files.filter(|name| name.ends_with(".csv") && name != "table.csv").collect();
        files.sort();
        let runs: Vec<String> = files.iter().map(|name| format!("{}={name}", name.trim_end_matches(".csv"))).collect();
        let mut runs: Vec<&str> = runs.iter().flat_map(|run| ["--run", run]).collect();
        if at.join("table.csv").exists() {
            runs.extend(["--table", "table.csv"]);
        }
        let fit: serde_json::Value =
            serde_json::from_str(&succeeds(at, &[&["fit", model, "--json"], runs.as_slice()].concat())).unwrap();
        let functions: Vec<&serde_json::Value> =
            fit["functions"].as_array().unwrap().iter().filter(|f| f["determined"] == true).collect();
        assert!(functions.len() > 1, "{model}");
        for (format, read) in
            [("volcomp", readers::volcomp as fn(&str) -> readers::Errors), ("etalon", readers::etalon)]
        {
            succeeds(at, &[&["export", model, "--format", format, "--out", "errors"], runs.as_slice()].concat());
            let written = std::fs::read_to_string(at.join("errors")).unwrap();
            let errors = read(&written);
            for function in &functions {
                let name = function["name"].as_str().unwrap();
                let rows = errors.get(name).unwrap_or_else(|| panic!("{model}: no {name}: {written}"));
                let unit = if function["unit"] == "urad" { 1e-6 } else { 1e-3 };
                let key = format!("{}_deg", function["coordinate"].as_str().unwrap());
                let mut compared = 0;
                for point in function["points"].as_array().unwrap() {
                    let at = point[&key].as_f64().unwrap();
                    let Some((_, value)) = rows.iter().find(|row| (row.0 - at).abs() < 1e-6) else { continue };
                    assert!((value - unit * point["value"].as_f64().unwrap()).abs() < 2e-12, "{name} at {at}");
                    compared += 1;
                }
                assert!(compared > 10, "{name}: {compared}");
            }
            // Location errors that are base parameters by themselves, without their E.
            for coefficient in fit["coefficients"].as_array().unwrap() {
                let name = coefficient["name"].as_str().unwrap();
                let alone =
                    coefficient["definition"].is_null() && name.chars().nth(2) == Some('0') && name.starts_with('E');
                assert_eq!(errors.contains_key(&name[1..]), alone && !name.contains('_'), "{model}: {name}");
                if alone {
                    let value = errors[&name[1..]][0].1;
                    assert!((value - coefficient["value"].as_f64().unwrap()).abs() < 1e-11, "{name}");
                }
            }
        }
    }
}
