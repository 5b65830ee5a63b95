//! `trunnion simulate`: measurement files of a drawn machine.

use super::Refused;
use super::model::ModelArguments;
use super::simulated::SimulationArguments;
use clap::Args;
use std::path::PathBuf;
use trunnion::data::{Files, Guard, simulation_files};

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct SimulateArguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    simulation: SimulationArguments,
    /// Directory for the files: one CSV per run, the known functions, the truth.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replaces files of their names even if they were not simulated.
    #[arg(long)]
    force: bool,
}

impl SimulateArguments {
    /// Draws, measures, writes.
    pub fn run(self) -> Result<(), Refused> {
        let source = self.model.source()?;
        let (setup, simulation) = self.simulation.simulation(&self.model, &source)?;
        let drawn = simulation.draw(&setup);
        let files = simulation_files(&setup, &drawn, &self.out, Files::default())?;
        Ok(files.write(&self.out, &Guard { inputs: source.inputs(), force: self.force })?)
    }
}
