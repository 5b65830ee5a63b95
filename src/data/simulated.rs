//! The files of a simulation: `RUN.csv`, `table.csv`, `truth.json`.

use super::atomic::{WriteError, WriteProblem};
use super::runs::known_functions;
use super::sweep::Sweep;
use super::table::{Known, Table};
use super::truth::{Truth, TruthFunction};
use crate::study::{Observation, Setup, Simulated, Simulation, coordinate, marks, visited};
use std::fs;
use std::io;
use std::path::Path;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;

/// Writes the files of a simulation into a directory, which is made where it is not there.
///
/// # Errors
/// [`WriteError`]
pub fn write_simulation(
    setup: &Setup,
    simulation: &Simulation,
    simulated: &Simulated,
    out: &Path,
) -> Result<(), WriteError> {
    fs::create_dir_all(out).map_err(|e| {
        // What the operating system calls this, "already exists", leads nowhere.
        let kind = if out.is_file() { io::ErrorKind::NotADirectory } else { e.kind() };
        WriteError { file: out.to_owned(), problem: WriteProblem::Directory(kind) }
    })?;
    let own = setup.model.runs.iter().find(|run| run.name.eq_ignore_ascii_case("table"));
    if let Some(run) = own.filter(|_| known_functions(setup).is_some()) {
        let file = out.join(format!("{}.csv", run.name));
        return Err(WriteError { file, problem: WriteProblem::HoldsTheTable });
    }
    for observation in &simulated.observations {
        let run = &setup.model.runs[observation.run];
        let samples = observation.samples.iter().map(|s| (s.sweep, s.reading));
        let sweep = Sweep::new(out.join(format!("{}.csv", run.name)), samples);
        sweep.write(setup.model.alphabet.sweep_name(run.sweep), Unit::Deg, Unit::Um)?;
    }
    write_table(setup, simulated, &out.join("table.csv"))?;
    truth(setup, simulation, simulated).write(&out.join("truth.json"))
}

/// The known functions of all runs, at every value of the sweeps of those that see one.
fn write_table(setup: &Setup, simulated: &Simulated, file: &Path) -> Result<(), WriteError> {
    let Some((angle, functions)) = known_functions(setup) else { return Ok(()) };
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
    Table::write(file, angle, &known, sweeps.into_iter().map(line))
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
    let names = setup.derivation.base.iter().map(|b| b.name.clone());
    Truth {
        seed: simulation.seed,
        radius_mm: setup.radius(),
        samples: simulation.samples,
        noise_um: simulation.noise_um,
        range_deg: simulation.range_deg,
        functions: setup.estimated().filter_map(function).collect(),
        constants: names.zip(simulated.machine.base(setup)).collect(),
    }
}
