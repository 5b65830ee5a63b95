//! The files of a simulation: `RUN.csv`, `table.csv`, `truth.json`.

use super::known::known_functions;
use super::output::{Files, Guard, WriteError, WriteProblem};
use super::sweep::columns;
use super::table::{Known, Table};
use super::truth::{Truth, TruthFunction};
use super::written::Writing;
use crate::study::{DrawnMachine, Setup, Simulation, coordinate, marks, visited};
use std::path::Path;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;

/// The file of the known functions.
const TABLE: &str = "table.csv";

/// Writes the files of a simulation into a directory, all or none; the directory is made where it is not there, and what a
/// simulation wrote there before is replaced. No run is kept: their length needs no memory.
///
/// # Errors
/// [`WriteError`]
pub fn write_simulation(setup: &Setup, simulation: &Simulation, out: &Path) -> Result<(), WriteError> {
    simulation_files(setup, &simulation.draw(setup), out, Files::default())?.write(out, &Guard::default())
}

/// The files of a drawn machine's measurement for a directory, with others beside them; `truth.json` lists them all.
///
/// # Errors
/// [`WriteError`] where a value is not finite, or two files have one name.
pub fn simulation_files<'a>(
    setup: &'a Setup,
    drawn: &'a DrawnMachine<'a>,
    out: &Path,
    others: Files<'a>,
) -> Result<Files<'a>, WriteError> {
    let failed = |name: &str, problem| WriteError { file: out.join(name), problem };
    let mut files = others;
    let own = setup.model.runs.iter().find(|run| run.name.eq_ignore_ascii_case("table"));
    if let Some(run) = own.filter(|_| known_functions(setup).is_some()) {
        return Err(failed(&format!("{}.csv", run.name), WriteProblem::HoldsTheTable));
    }
    for (id, run) in setup.model.runs.iter_enumerated() {
        let angle = setup.model.alphabet.sweep_name(run.sweep);
        files.stream(format!("{}.csv", run.name), move |out| {
            let columns = columns(angle, Unit::Deg, Unit::Um);
            let mut table = Writing::new(out, &columns)?;
            drawn.each(id, |sample| table.line(&[sample.sweep, sample.reading]))?;
            table.end()
        });
    }
    if let Some(contents) = table(setup, drawn) {
        files.add(TABLE, contents.map_err(|problem| failed(TABLE, problem))?);
    }
    let truth = truth(setup, drawn);
    files.index(move |files| Ok(truth.listing(files)?.into_bytes()));
    Ok(files)
}

/// The known functions of all runs, along the sweeps of those that see one; none where no run does.
fn table(setup: &Setup, drawn: &DrawnMachine<'_>) -> Option<Result<Vec<u8>, WriteProblem>> {
    let (angle, functions) = known_functions(setup)?;
    let known = functions.iter();
    let known = known.map(|f| Known { name: known_name(&setup.model, *f), quantity: setup.quantity(*f) });
    let known: Vec<Known> = known.collect();
    let sees = |run: &RunId| !setup.derivation.runs[*run].known.is_empty();
    let runs = setup.model.runs.keys().filter(sees);
    let mut sweeps: Vec<f64> = runs.flat_map(|run| drawn.simulation.tabulated(setup, run)).collect();
    sweeps.sort_by(f64::total_cmp);
    sweeps.dedup();
    let value = |f: &FunctionId, sweep| drawn.machine.value(setup.model.functions[*f].error, sweep);
    let line = |sweep: f64| (sweep, functions.iter().map(|f| value(f, sweep)).collect());
    Some(Table::contents(angle, &known, sweeps.into_iter().map(line)))
}

fn truth(setup: &Setup, drawn: &DrawnMachine<'_>) -> Truth {
    let (simulation, machine) = (&drawn.simulation, &drawn.machine);
    let swept = || setup.model.runs.keys().map(|run| (run, simulation.visited(setup, run)));
    let function = |f: FunctionId| {
        let error = setup.model.functions[f].error;
        let (axis, unit) = (setup.axis(f)?, setup.quantity(f).deviation());
        let of = coordinate(axis).coordinate();
        let value = |x: f64| unit.from_inner(machine.value(error, of.to_inner(x)));
        let points = visited(setup, f, swept()).map_or(Vec::new(), |range| marks(range, of));
        let points = points.into_iter().map(|x| (x, value(x))).collect();
        let coordinate = format!("{}_{of}", axis.coordinate);
        Some(TruthFunction { name: setup.function_name(f), unit, coordinate, points })
    };
    let located = |f: &FunctionId| setup.model.functions[*f].is_location();
    let names = setup.derivation.base.iter().map(|b| b.name.clone());
    let mut constants: Vec<(String, f64)> = names.zip(machine.base(setup)).collect();
    for function in setup.estimated().filter(located) {
        let name = setup.function_name(function);
        if constants.iter().all(|(own, _)| *own != name) {
            constants.push((name, drawn.machine.value(setup.model.functions[function].error, 0.0)));
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
