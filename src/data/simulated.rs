//! The files of a simulation: `RUN.csv`, `table.csv`, `truth.json`.

use super::known::known_functions;
use super::output::{Files, Guard, INDEX, WriteError, WriteProblem};
use super::sweep::Sweep;
use super::table::{Known, Table};
use super::truth::{Truth, TruthFunction};
use crate::study::{Observation, Setup, Simulated, Simulation, coordinate, marks, visited};
use std::path::Path;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;

/// The file of the known functions.
const TABLE: &str = "table.csv";

/// Writes the files of a simulation into a directory, all or none; the directory is made where it is not there, and what a
/// simulation wrote there before is replaced.
///
/// # Errors
/// [`WriteError`]
pub fn write_simulation(
    setup: &Setup,
    simulation: &Simulation,
    simulated: &Simulated,
    out: &Path,
) -> Result<(), WriteError> {
    simulation_files(setup, simulation, simulated, out, Files::default())?.write(out, &Guard::default())
}

/// The files of a simulation for a directory, with others beside them; `truth.json` lists them all.
///
/// # Errors
/// [`WriteError`] where a value is not finite, or two files have one name.
pub fn simulation_files(
    setup: &Setup,
    simulation: &Simulation,
    simulated: &Simulated,
    out: &Path,
    others: Files,
) -> Result<Files, WriteError> {
    let failed = |name: &str, problem| WriteError { file: out.join(name), problem };
    let mut files = others;
    let own = setup.model.runs.iter().find(|run| run.name.eq_ignore_ascii_case("table"));
    if let Some(run) = own.filter(|_| known_functions(setup).is_some()) {
        return Err(failed(&format!("{}.csv", run.name), WriteProblem::HoldsTheTable));
    }
    for observation in &simulated.observations {
        let run = &setup.model.runs[observation.run];
        let name = format!("{}.csv", run.name);
        let samples = observation.samples.iter().map(|s| (s.sweep, s.reading));
        let sweep = Sweep::new(out.join(&name), samples);
        let contents = sweep.contents(setup.model.alphabet.sweep_name(run.sweep), Unit::Deg, Unit::Um);
        let contents = contents.map_err(|problem| failed(&name, problem))?;
        files.add(name, contents);
    }
    if let Some(contents) = table(setup, simulated) {
        files.add(TABLE, contents.map_err(|problem| failed(TABLE, problem))?);
    }
    let truth = truth(setup, simulation, simulated).listing(&files);
    files.add(INDEX, truth.map_err(|problem| failed(INDEX, problem))?);
    Ok(files)
}

/// The known functions of all runs, at every value of the sweeps of those that see one; none where no run does.
fn table(setup: &Setup, simulated: &Simulated) -> Option<Result<Vec<u8>, WriteProblem>> {
    let (angle, functions) = known_functions(setup)?;
    let known = functions.iter();
    let known = known.map(|f| Known { name: known_name(&setup.model, *f), quantity: setup.quantity(*f) });
    let known: Vec<Known> = known.collect();
    let sees = |o: &&Observation| !setup.derivation.runs[o.run].known.is_empty();
    let sweeps = simulated.observations.iter().filter(sees).flat_map(|o| o.samples.iter().map(|s| s.sweep));
    let mut sweeps: Vec<f64> = sweeps.collect();
    sweeps.sort_by(f64::total_cmp);
    sweeps.dedup();
    let value = |f: &FunctionId, sweep| simulated.machine.value(setup.model.functions[*f].error, sweep);
    let line = |sweep: f64| (sweep, functions.iter().map(|f| value(f, sweep)).collect());
    Some(Table::contents(angle, &known, sweeps.into_iter().map(line)))
}

fn truth(setup: &Setup, simulation: &Simulation, simulated: &Simulated) -> Truth {
    let swept = || simulated.observations.iter().map(|o| (o.run, simulation.visited(setup, o.run)));
    let function = |f: FunctionId| {
        let error = setup.model.functions[f].error;
        let (axis, unit) = (setup.axis(f)?, setup.quantity(f).deviation());
        let of = coordinate(axis).coordinate();
        let value = |x: f64| unit.from_inner(simulated.machine.value(error, of.to_inner(x)));
        let points = visited(setup, f, swept()).map_or(Vec::new(), |range| marks(range, of));
        let points = points.into_iter().map(|x| (x, value(x))).collect();
        let coordinate = format!("{}_{of}", axis.coordinate);
        Some(TruthFunction { name: setup.function_name(f), unit, coordinate, points })
    };
    let located = |f: &FunctionId| setup.model.functions[*f].is_location();
    let names = setup.derivation.base.iter().map(|b| b.name.clone());
    let mut constants: Vec<(String, f64)> = names.zip(simulated.machine.base(setup)).collect();
    for function in setup.estimated().filter(located) {
        let name = setup.function_name(function);
        if constants.iter().all(|(own, _)| *own != name) {
            constants.push((name, simulated.machine.value(setup.model.functions[function].error, 0.0)));
        }
    }
    Truth {
        seed: simulation.seed,
        radius_mm: setup.radius(),
        samples: simulation.samples,
        noise_um: simulation.noise_um,
        range_deg: simulation.range_deg,
        functions: setup.estimated().filter(|f| !located(f)).filter_map(function).collect(),
        constants,
    }
}
