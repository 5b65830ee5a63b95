//! Errors that are none of the axis' own position: what another axis takes off, and what stands under its ISO name.

use crate::program::succeeds;
use crate::readers::{self, Trim};
use crate::written::read;
use std::f64::consts::TAU;
use trunnion::export::{
    AllFormat, Format, Grid, Kept, OneFormat, Subject, Table, TakenOff, Told, left, write, write_all,
};
use trunnion::study::{
    ErrorLimits, Estimator, Instrument, Observation, Population, Setup, SimulatedMachine, fit, report,
};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::catalogue::source;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;

use chacha20::ChaCha8Rng;
use rand::SeedableRng;

/// A machine whose tool stands further by what its linear axes were moved.
struct Moved<'a> {
    machine: &'a SimulatedMachine,
    tool: Option<[ErrorId; 3]>,
    by: [f64; 3],
}

impl ErrorValues for Moved<'_> {
    fn value(&self, error: ErrorId, x: f64) -> f64 {
        let along = self.tool.and_then(|tool| tool.iter().position(|own| *own == error));
        self.machine.value(error, x) + along.map_or(0.0, |along| self.by[along])
    }
}

/// Every run over a turn, the tool moved by so much as A's position (degrees) has it.
fn measured(setup: &Setup, machine: &SimulatedMachine, moved: &dyn Fn(f64) -> [f64; 3]) -> Vec<Observation> {
    let one = |run| {
        let mut observation = Observation::zero(setup, run, &setup.swept(run, 181, (0.0, TAU)));
        for sample in &mut observation.samples {
            let exact = setup.exact(run, &[sample.sweep]);
            let by = moved(sample.sweep.to_degrees());
            let moved = Moved { machine, tool: setup.model.runs[run].tool_ball.setup, by };
            sample.reading = exact.values(&moved).next().unwrap();
        }
        observation
    };
    setup.model.runs.keys().map(one).collect()
}

/// A machine within the paper's limits.
fn drawn(setup: &Setup, seed: u64) -> SimulatedMachine {
    let exact: Vec<ExactReading> =
        setup.model.runs.keys().map(|run| setup.exact(run, &setup.swept(run, 181, (0.0, TAU)))).collect();
    Population::new(setup, &exact, ErrorLimits::PAPER).draw(&mut ChaCha8Rng::seed_from_u64(seed))
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
        let machine = drawn(&setup, 3);
        let value = |observations: &[Observation], at: f64| {
            fit(&setup, observations, Estimator::Joint).unwrap().function(&setup, function, at.to_radians()).0
        };
        let before = measured(&setup, &machine, &|_| [0.0; 3]);
        let grid = Grid::new(0.0, 360.0, 5.0).unwrap();
        let table = Table::new(subject, grid, false, |at| [value(&before, at); 2]);
        let written =
            write(&table, OneFormat::Cec, &Told { output: Some("AX2".to_owned()), ..Told::default() }).unwrap();
        assert!(written.text.contains("$AN_CEC_INPUT_AXIS[0]=(A)\n$AN_CEC_OUTPUT_AXIS[0]=(AX2)\n"));
        let trim = readers::cec(&written.text).unwrap();
        // Y is told so much more; its positive motion is −sense along y.
        let [after, wrong] =
            [1.0, -1.0].map(|sign| measured(&setup, &machine, &|at| [0.0, sign * -sense * trim(at, true), 0.0]));
        let largest = grid.points().map(|at| value(&before, at).abs()).fold(0.0, f64::max);
        for at in grid.points().step_by(6) {
            let [before, after, wrong] = [&before, &after, &wrong].map(|observations| value(observations, at));
            assert!(after.abs() < 0.02 * largest, "{at}: {before} {after}, at most {largest}");
            assert!((wrong - 2.0 * before).abs() < 0.02 * largest, "{at}: {before} {wrong}");
        }
        // Under its ISO name it is the error itself.
        let heidenhain = write(&table, OneFormat::Heidenhain, &Told::default()).unwrap().text;
        assert!(heidenhain.lines().nth(1).unwrap().ends_with(" C2"), "{heidenhain}");
        assert!((readers::heidenhain(&heidenhain).unwrap()(90.0, true) + value(&before, 90.0)).abs() < 1e-6);
        for own in [OneFormat::LinuxCnc, OneFormat::Sinumerik840d, OneFormat::Fanuc] {
            let message = write(&table, own, &Told::default()).unwrap_err().to_string();
            assert!(message.starts_with("not the axis' own position"), "{message}");
        }
    }
}

/// The displacements of A along y and z under their ISO names: the table carries the workpiece, so that a control that knows the
/// machine sends the tool after it by the error. Orientations are not compensated by these formats, and of Heidenhain's it is not
/// documented how: no loop is closed over them.
#[test]
fn displacements_are_taken_off_under_their_iso_names() {
    let setup = Setup::from_catalogue("tilting-table-a-dyz", &[]).unwrap();
    let functions: Vec<FunctionId> = setup.estimated().collect();
    let grid = Grid::new(0.0, 360.0, 5.0).unwrap();
    for seed in 3..6 {
        let machine = drawn(&setup, seed);
        // Values at the rows, and the largest expanded uncertainty.
        let found = |observations: &[Observation]| -> Vec<(Vec<f64>, f64)> {
            let fit = fit(&setup, observations, Estimator::Joint).unwrap();
            let report = report(&setup, observations, &fit, ErrorLimits::PAPER, &Instrument::default(), false).unwrap();
            let one = |function: &FunctionId| {
                let curve = report.functions.iter().find(|curve| curve.function == *function).unwrap();
                let u95 = curve.points.iter().map(|point| curve.unit.to_inner(point.u95)).fold(0.0, f64::max);
                (grid.points().map(|at| fit.function(&setup, *function, at.to_radians()).0).collect(), u95)
            };
            functions.iter().map(one).collect()
        };
        let raw = measured(&setup, &machine, &|_| [0.0; 3]);
        let (before, raw) = (found(&raw), fit(&setup, &raw, Estimator::Joint).unwrap());
        let error = |function: FunctionId| {
            let (setup, raw) = (&setup, &raw);
            move |at: f64| [raw.function(setup, function, at.to_radians()).0; 2]
        };
        let subject = |function: &FunctionId| Subject::new(&setup, *function, None).unwrap();
        let tables: Vec<Table> =
            functions.iter().map(|own| Table::new(subject(own), grid, false, error(*own))).collect();
        let isos: Vec<&str> = tables.iter().map(|table| table.subject.iso.as_str()).collect();
        assert_eq!(isos, ["EYA", "EZA"]);
        let heidenhain = Format::One(OneFormat::Heidenhain);
        let of_its_own = |table: &Table| read(heidenhain, table, &Told::default()).unwrap();
        let mut files: Vec<(Format, Vec<(Trim, Kept)>)> = vec![(heidenhain, tables.iter().map(of_its_own).collect())];
        for all in [AllFormat::Volcomp, AllFormat::Etalon] {
            let (text, kept) = write_all(&tables, &[], all, &[]);
            let errors = readers::of_all(all)(&text).unwrap();
            let trims = isos.iter().map(|iso| readers::iso_error(&errors, iso, false).unwrap());
            files.push((Format::All(all), trims.zip(kept).collect()));
        }
        for (format, own) in &files {
            let [after, wrong] = [1.0, -1.0].map(|sign| {
                let after_it = |at: f64| [0.0, -sign * own[0].0(at, true), -sign * own[1].0(at, true)];
                found(&measured(&setup, &machine, &after_it))
            });
            for (i, table) in tables.iter().enumerate() {
                let left = left(table, &own[i].1, format.facts().between, error(functions[i]));
                let [(before, was), (after, is), (wrong, _)] = [&before[i], &after[i], &wrong[i]];
                let allowed = was.hypot(*is) + left;
                let largest = before.iter().fold(0.0f64, |largest, e| largest.max(e.abs()));
                let named = format!("{} {}", format.name(), table.subject.iso);
                assert!(largest > 3.0 * allowed, "{named}: {largest} ± {allowed}");
                for ((before, after), wrong) in before.iter().zip(after).zip(wrong) {
                    assert!(after.abs() <= allowed, "{named}: {after} of {before}, ± {allowed}");
                    assert!((wrong - 2.0 * before).abs() <= 2.0 * allowed, "{named}: {before} {wrong}, ± {allowed}");
                }
            }
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
            [("volcomp", readers::volcomp as fn(&str) -> readers::Read<readers::Errors>), ("etalon", readers::etalon)]
        {
            let export = ["export", model, "--format", format, "--out", "errors", "--force", "--json"];
            let exported: serde_json::Value =
                serde_json::from_str(&succeeds(at, &[&export, runs.as_slice()].concat())).unwrap();
            let written = std::fs::read_to_string(at.join("errors")).unwrap();
            let errors = read(&written).unwrap();
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
                    // With its uncertainty, in words as in the object.
                    let constants = exported["constants"].as_array().unwrap();
                    let own = constants.iter().find(|own| own["name"] == name[1..]).unwrap();
                    let unit = if name.starts_with("EX") || name.starts_with("EY") || name.starts_with("EZ") {
                        "mm"
                    } else {
                        "rad"
                    };
                    assert_eq!((&own["u95"], own["unit"].as_str()), (&coefficient["u95"], Some(unit)), "{name}");
                    assert!(written.contains(&format!("// {}: {value:.9} {unit} +- ", &name[1..])), "{written}");
                }
            }
        }
    }
}
