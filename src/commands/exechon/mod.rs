//! `trunnion exechon`: on-machine measurement on a parallel machine whose tool turns as it moves.

mod drm;
mod failed;
mod fk;
mod ik;
mod offset;
mod paper;
mod plan;
mod ring;
mod spool;

pub use failed::Failed;

use super::Refused;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use trunnion::exechon::{Coordinates, read_machine};
use trunnion_solver::exechon::{Machine, Tilted};

/// Commands for the parallel machine.
#[derive(Debug, Subcommand)]
pub enum Exechon {
    /// Struts, axes and dependent rotation of tool points and directions.
    Ik(ik::Ik),
    /// Tool points and directions of struts and axes.
    Fk(fk::Fk),
    /// The dependent rotation: of poses, as a map, or around a ring with its quintic.
    Drm(drm::Drm),
    /// A touch probe's offset from touches in a ring, with and without the dependent rotation.
    Offset(offset::Offset),
    /// Best-fit circles, roundness and spread of a probed ring.
    Ring(ring::Ring),
    /// A measuring plan with the spindle angle of each touch, or an NC program.
    Plan(plan::Plan),
    /// The paper's experiments on the model, beside what it measured.
    Paper(paper::Paper),
}

impl Exechon {
    /// Runs the command.
    pub fn run(self) -> Result<(), Refused> {
        let done = match self {
            Self::Ik(c) => c.run(),
            Self::Fk(c) => c.run(),
            Self::Drm(c) => c.run(),
            Self::Offset(c) => c.run(),
            Self::Ring(c) => c.run(),
            Self::Plan(c) => c.run(),
            Self::Paper(c) => c.run(),
        };
        Ok(done?)
    }
}

/// Which machine.
#[derive(Debug, Args)]
struct Which {
    /// A machine file; without it the built-in src/exechon/xt700.toml.
    #[arg(long, value_name = "FILE")]
    machine: Option<PathBuf>,
}

impl Which {
    fn read(&self) -> Result<Machine<f64>, Failed> {
        let name = self.machine.clone().unwrap_or_else(|| "src/exechon/xt700.toml".into());
        read_machine(self.machine.as_deref()).map_err(|problem| Failed::Machine(name, problem))
    }
}

/// Coordinates of points and directions in files.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum FrameName {
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
enum TiltedName {
    /// From the machine's x axis seen along the tool: (7) as it stands.
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
fn degrees(angle: f64) -> f64 {
    angle.to_degrees() + 0.0
}

/// `X,Y,…` as N numbers.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let values: Result<Vec<f64>, _> = text.split(',').map(|field| field.trim().parse::<f64>()).collect();
    let values = values.ok().filter(|values| values.iter().all(|v| v.is_finite()));
    let array = values.and_then(|values| <[f64; N]>::try_from(values).ok());
    array.ok_or_else(|| format!("expected {N} numbers separated by commas, such as {}", ["1.5"; N].join(",")))
}
