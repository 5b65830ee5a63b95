//! `trunnion simulate`: measurement files of a drawn machine.

use super::Refused;
use super::model::ModelArguments;
use super::simulated::SimulationArguments;
use clap::Args;
use std::path::PathBuf;
use trunnion::data::write_simulation;

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
}

impl SimulateArguments {
    /// Draws, measures, writes.
    pub fn run(self) -> Result<(), Refused> {
        let (setup, simulation) = self.simulation.simulation(&self.model)?;
        Ok(write_simulation(&setup, &simulation, &simulation.measure(&setup), &self.out)?)
    }
}
