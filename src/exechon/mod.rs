//! On-machine measurement on an Exechon-type parallel machine: machine files, pose files, probing plans, ring tests.
//!
//! The mathematics is the solver's ([`trunnion_solver::exechon`], [`circle`](trunnion_solver::circle),
//! [`probe`](trunnion_solver::probe)); here it meets files, NC programs and pictures. Coordinates are those of the machine
//! (the tool's at home) unless a name says base.

mod budget;
mod compensation;
mod input;
mod machine;
mod nc;
mod offset;
mod paper;
mod pictures;
mod plan;
mod ring;
mod simulate;
mod solved;

pub use budget::{ProbedBudget, ProbedPart, Tried};
pub use compensation::{Compensation, CompensationError};
pub use input::InputError;
pub use machine::{BUILT_IN, MachineFileError, read_machine};
pub use nc::{NcError, ring_program};
pub use offset::{Gauge, Met, OffsetReport, ReversalReport, Scattered, offset_report};
pub use paper::{ExperimentError, Experiments, OffsetRow, RING_CENTRES, experiments};
pub use pictures::{PictureError, drm_map, machine_picture, offset_picture, quintic_picture, ring_picture};
pub use plan::{Feature, PlanError, PlannedTouch, plan};
pub use ring::{ProbeKnown, RingError, RingReport, ring_report, ring_report_of};
pub use simulate::{Probe, SimulatedTouch, simulate};
pub use solved::{Coordinates, Path, SolvedPose, forward, inverse};

use trunnion_solver::exechon::{KinematicsError, Machine, Pose, RotationError, Target, TargetError, Tilted};

/// The pose whose tool is at a point and direction of machine coordinates, from home.
///
/// # Errors
/// [`PointError`].
pub fn pose_at(machine: &Machine<f64>, point: [f64; 3], direction: [f64; 3]) -> Result<Pose<f64>, PointError> {
    let frame = machine.frame();
    let target = Target::new(frame.point_to_base(point), frame.direction_to_base(direction))?;
    Ok(machine.inverse(&target, &machine.home().start())?)
}

/// The dependent rotation, rad, with the tool at a point and direction of machine coordinates.
///
/// # Errors
/// [`PointError`].
pub fn rotation_at(machine: &Machine<f64>, point: [f64; 3], direction: [f64; 3]) -> Result<f64, PointError> {
    Ok(machine.dependent_rotation(&pose_at(machine, point, direction)?, Tilted::Projected)?)
}

/// The tool direction at home, in machine coordinates.
pub const ALONG: [f64; 3] = [0.0, 0.0, 1.0];

/// Why the machine cannot be at a point.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointError {
    /// The point or direction is none.
    #[error("{0}")]
    Target(#[from] TargetError<f64>),
    /// The machine does not reach it.
    #[error("{0}")]
    Kinematics(#[from] KinematicsError<f64>),
    /// The dependent rotation is undefined there.
    #[error("{0}")]
    Rotation(#[from] RotationError),
}

impl PointError {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Target(TargetError::NotUnit { .. }) => {
                "expected a direction of length 1 to 6 digits: divide it by its length, and write all its digits"
            }
            Self::Target(TargetError::ZeroDirection) => "expected the tool's direction i,j,k, of length 1",
            Self::Target(_) => "expected numbers such as 12.5",
            Self::Kinematics(KinematicsError::Singular(_)) => {
                "move the point or tilt the tool away from the singularity"
            }
            Self::Kinematics(KinematicsError::OutOfRange { .. }) => {
                "expected a pose within the strokes: move the point, or correct the limits in the machine file"
            }
            Self::Kinematics(_) => "expected a point in the workspace: are the frame and the units right?",
            Self::Rotation(_) => "tilt the tool otherwise",
        }
    }
}
