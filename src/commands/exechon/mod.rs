//! `trunnion exechon`: on-machine measurement on a parallel machine whose tool turns as it moves.

mod arguments;
mod drm;
mod fk;
mod ik;
mod offset;
mod paper;
mod plan;
mod refused;
mod ring;

pub use refused::ExechonRefused;

use super::Refused;
use clap::Subcommand;

/// Commands for the parallel machine.
#[derive(Debug, Subcommand)]
pub enum Exechon {
    /// Struts, axes and dependent rotation of tool points and directions.
    Ik(ik::IkArguments),
    /// Tool points and directions of struts and axes.
    Fk(fk::FkArguments),
    /// The dependent rotation: of poses, as a map, or around a ring with its quintic.
    Drm(drm::DrmArguments),
    /// A touch probe's offset from touches in a ring, with and without the dependent rotation.
    Offset(offset::OffsetArguments),
    /// Best-fit circles, roundness and spread of a probed ring.
    Ring(ring::RingArguments),
    /// A measuring plan with the spindle angle of each touch, or an NC program.
    Plan(plan::TouchPlanArguments),
    /// The paper's experiments on the model, beside what it measured.
    Paper(paper::PaperArguments),
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
