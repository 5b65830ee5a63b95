//! `trunnion simulate`: measurement files of a drawn machine.

use super::Refused;
use super::model::ModelArguments;
use super::simulated::{Measured, Simulation};
use clap::Args;
use std::path::{Path, PathBuf};
use trunnion::data::{Known, Sweep, Table, Truth, TruthFunction, Unit};
use trunnion::study::Setup;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    simulation: Simulation,
    /// Directory for the files: one CSV per run, the known functions, the truth.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

impl Simulate {
    /// Draws, measures, writes.
    pub fn run(self) -> Result<(), Refused> {
        self.simulation.check()?;
        let (setup, radius) = self.model.setup()?;
        write(&setup, &self.simulation, &self.simulation.measure(&setup), radius.mm(), &self.out)
    }
}

/// Writes the files of a simulation: `RUN.csv`, `table.csv`, `truth.json`.
pub fn write(
    setup: &Setup,
    simulation: &Simulation,
    measured: &Measured,
    radius_mm: f64,
    out: &Path,
) -> Result<(), Refused> {
    std::fs::create_dir_all(out).map_err(|e| {
        // What the operating system calls this, "already exists", leads nowhere.
        let kind = if out.is_file() { std::io::ErrorKind::NotADirectory } else { e.kind() };
        Refused::Directory(out.to_owned(), kind)
    })?;
    for observation in &measured.observations {
        let run = &setup.model.runs[observation.run];
        let samples = observation.samples.iter().map(|s| (s.sweep, s.reading));
        let sweep = Sweep::new(out.join(format!("{}.csv", run.name)), samples);
        sweep.write(setup.model.alphabet.sweep_name(run.sweep), Unit::Deg, Unit::Um)?;
    }
    table(setup, measured, out)?;
    truth(setup, simulation, measured, radius_mm).write(&out.join("truth.json"))?;
    Ok(())
}

/// The known functions at the samples of the run that sees most of them.
fn table(setup: &Setup, measured: &Measured, out: &Path) -> Result<(), Refused> {
    let most = |r: &RunId| setup.derivation.runs[*r].known.len();
    let Some(run) = setup.derivation.runs.keys().max_by_key(most).filter(|r| most(r) > 0) else { return Ok(()) };
    let known = setup.derivation.runs[run]
        .known
        .iter()
        .map(|(f, _)| Known { name: known_name(&setup.model, *f), quantity: setup.quantity(*f) });
    let known: Vec<Known> = known.collect();
    let lines = measured.observations[run].samples.iter().map(|s| (s.sweep, s.known.clone()));
    let angle = setup.model.alphabet.sweep_name(setup.model.runs[run].sweep);
    Ok(Table::write(&out.join("table.csv"), angle, &known, lines)?)
}

fn truth(setup: &Setup, simulation: &Simulation, measured: &Measured, radius_mm: f64) -> Truth {
    let (first, last) = ((simulation.from_deg / 5.0).ceil() as i64, (simulation.to_deg / 5.0).floor() as i64);
    let function = |f: FunctionId| {
        let error = setup.model.functions[f].error;
        let unit = setup.quantity(f).deviation();
        let value = |deg: f64| unit.from_inner(measured.machine.value(error, deg.to_radians()));
        let points = (first..=last).map(|i| i as f64 * 5.0).map(|deg| (deg, value(deg))).collect();
        TruthFunction { name: setup.function_name(f), unit, points }
    };
    let names = setup.derivation.base.iter().map(|b| b.name.clone());
    Truth {
        seed: simulation.seed,
        radius_mm,
        samples: simulation.samples,
        noise_um: simulation.noise_um,
        range_deg: (simulation.from_deg, simulation.to_deg),
        angle: setup.model.runs.first().map_or("a", |r| setup.model.alphabet.sweep_name(r.sweep)).to_owned(),
        functions: setup.estimated().map(function).collect(),
        constants: names.zip(measured.machine.base(setup)).collect(),
    }
}
