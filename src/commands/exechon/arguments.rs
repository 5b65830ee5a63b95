//! What several commands of the parallel machine take.

use super::ExechonRefused;
use crate::commands::reported::read;
use clap::{Args, ValueEnum};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trunnion::data::Stamp;
use trunnion::exechon::{BUILT_IN, Coordinates, read_machine};
use trunnion_solver::exechon::{Machine, Tilted};

/// Which machine.
#[derive(Debug, Args)]
pub struct Which {
    /// A machine file; without it the built-in src/exechon/xt700.toml.
    #[arg(long, value_name = "FILE")]
    machine: Option<PathBuf>,
}

impl Which {
    /// The file that is read, if there is one.
    pub fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.machine.as_deref().into_iter()
    }

    /// Reads it.
    pub fn read(&self) -> Result<Machine<f64>, ExechonRefused> {
        let name = self.machine.clone().unwrap_or_else(|| "src/exechon/xt700.toml".into());
        read_machine(self.machine.as_deref()).map_err(|problem| ExechonRefused::Machine(name, problem))
    }
}

/// What is said of the files of a command that has read touches.
pub fn read_files(which: &Which, touches: &Path, stamp: Stamp) -> Vec<Value> {
    let machine = which.machine.as_deref().map_or_else(
        || read("machine, built in", "src/exechon/xt700.toml", Stamp::of(BUILT_IN.as_bytes()).ok()),
        |file| read("machine", &file.display().to_string(), Stamp::of_file(file)),
    );
    vec![machine, read("touches", &touches.display().to_string(), Some(stamp))]
}

/// Coordinates of points and directions in files.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FrameName {
    /// Of the base: between the outer gimbals, z towards the platform.
    Base,
    /// Of the machine: the tool's at home.
    Machine,
}

impl From<FrameName> for Coordinates {
    fn from(name: FrameName) -> Self {
        match name {
            FrameName::Base => Self::Base,
            FrameName::Machine => Self::Machine,
        }
    }
}

/// What φ is counted from where the tool does not point as at home.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum TiltedName {
    /// From the machine's x axis seen along the tool: E(7) as it stands.
    Projected,
    /// From home's orientation carried to the tool's direction by the smallest rotation.
    Carried,
}

impl From<TiltedName> for Tilted {
    fn from(name: TiltedName) -> Self {
        match name {
            TiltedName::Projected => Self::Projected,
            TiltedName::Carried => Self::Carried,
        }
    }
}

/// Degrees, without a negative zero.
pub fn degrees(angle: f64) -> f64 {
    angle.to_degrees() + 0.0
}
