//! The files of a simulation: `RUN.csv`, `table.csv`, `truth.json`.

use super::atomic::{WriteError, WriteProblem};
use super::sweep::Sweep;
use super::table::{Known, Table};
use super::truth::{Truth, TruthFunction};
use crate::study::{Setup, Simulated, Simulation};
use std::fs;
use std::io;
use std::path::Path;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;

/// Degrees between the points of a function in `truth.json`.
const STEP_DEG: f64 = 5.0;

/// Writes the files of a simulation into a directory, which is made where it is not there.
///
/// # Errors
/// [`WriteError`]
pub fn write_simulation(
    setup: &Setup,
    simulation: &Simulation,
    simulated: &Simulated,
    radius_mm: f64,
    out: &Path,
) -> Result<(), WriteError> {
    fs::create_dir_all(out).map_err(|e| {
        // What the operating system calls this, "already exists", leads nowhere.
        let kind = if out.is_file() { io::ErrorKind::NotADirectory } else { e.kind() };
        WriteError { file: out.to_owned(), problem: WriteProblem::Directory(kind) }
    })?;
    for observation in &simulated.observations {
        let run = &setup.model.runs[observation.run];
        let samples = observation.samples.iter().map(|s| (s.sweep, s.reading));
        let sweep = Sweep::new(out.join(format!("{}.csv", run.name)), samples);
        sweep.write(setup.model.alphabet.sweep_name(run.sweep), Unit::Deg, Unit::Um)?;
    }
    write_table(setup, simulated, &out.join("table.csv"))?;
    truth(setup, simulation, simulated, radius_mm).write(&out.join("truth.json"))
}

/// The known functions at the samples of the run that sees most of them.
fn write_table(setup: &Setup, simulated: &Simulated, file: &Path) -> Result<(), WriteError> {
    let most = |r: &RunId| setup.derivation.runs[*r].known.len();
    let Some(run) = setup.derivation.runs.keys().max_by_key(most).filter(|r| most(r) > 0) else { return Ok(()) };
    let known = setup.derivation.runs[run].known.iter();
    let known = known.map(|(f, _)| Known { name: known_name(&setup.model, *f), quantity: setup.quantity(*f) });
    let known: Vec<Known> = known.collect();
    let lines = simulated.observations[run].samples.iter().map(|s| (s.sweep, s.known.clone()));
    let angle = setup.model.alphabet.sweep_name(setup.model.runs[run].sweep);
    Table::write(file, angle, &known, lines)
}

fn truth(setup: &Setup, simulation: &Simulation, simulated: &Simulated, radius_mm: f64) -> Truth {
    let (from, to) = simulation.range_deg;
    let (first, last) = ((from / STEP_DEG).ceil() as i64, (to / STEP_DEG).floor() as i64);
    let function = |f: FunctionId| {
        let error = setup.model.functions[f].error;
        let unit = setup.quantity(f).deviation();
        let value = |deg: f64| unit.from_inner(simulated.machine.value(error, Unit::Deg.to_inner(deg)));
        let points = (first..=last).map(|i| i as f64 * STEP_DEG).map(|deg| (deg, value(deg))).collect();
        TruthFunction { name: setup.function_name(f), unit, points }
    };
    let names = setup.derivation.base.iter().map(|b| b.name.clone());
    Truth {
        seed: simulation.seed,
        radius_mm,
        samples: simulation.samples,
        noise_um: simulation.noise_um,
        range_deg: simulation.range_deg,
        angle: setup.model.runs.first().map_or("a", |r| setup.model.alphabet.sweep_name(r.sweep)).to_owned(),
        functions: setup.estimated().map(function).collect(),
        constants: names.zip(simulated.machine.base(setup)).collect(),
    }
}
