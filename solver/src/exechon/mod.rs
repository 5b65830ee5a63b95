//! The Exechon-type parallel machine: three struts carry a platform, on it the C axis, the A axis and the spindle.
//!
//! After paper E, whose equations are cited as E(7). Lengths in mm, angles in rad. Base coordinates (BP) have their origin
//! midway between the outer gimbals U1 and U3, x through both, z towards the platform; [machine coordinates](Frame) are the
//! tool's at home.
//!
//! The tool point and direction leave the turn of the tool about its own axis to the struts: the *dependent rotation*
//! ([`Machine::dependent_rotation`]).
//!
//! ```
//! use trunnion_solver::exechon::{Dimensions, Home, Limits, Machine, Range, Target};
//!
//! let machine = Machine::new(
//!     Dimensions { xu: 450.0, ys2: 450.0, xr: 150.0, yr5: 150.0, ycp: 25.0, zc: 375.0, yt: -30.0, tz: 380.0 },
//!     Home { strut: 1438.0, a: -core::f64::consts::FRAC_PI_4 },
//!     Limits {
//!         struts: Range { low: 950.0, high: 1650.0 },
//!         a: Range { low: -1.6, high: 1.6 },
//!         c: Range { low: -4.8, high: 4.8 },
//!     },
//! )?;
//! let frame = machine.frame();
//! let target = Target::new(frame.point_to_base([-319.135, 198.236, -168.0]), *machine.home().direction())?;
//! let pose = machine.inverse(&target, &machine.home().start())?;
//! let phi = machine.dependent_rotation(&pose, Default::default())?;
//! assert!((phi.to_degrees() - 16.36).abs() < 0.01);
//!
//! let again = machine.forward(&pose.joints, &machine.home().start())?;
//! assert!((again.point[0] - target.point()[0]).abs() < 1e-9);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! The equations and their derivatives (`equations`) are generated from their symbolic form.

mod error;
mod forward;
mod frame;
mod inverse;
mod limits;
mod machine;
mod newton;
mod pole;
mod pose;
mod rotation;
mod target;
mod vector;

/// The generated functions: E(1)–E(5) with the derivatives by the platform's position.
pub mod equations {
    include!(concat!(env!("OUT_DIR"), "/exechon.rs"));
}

pub use error::{Dimension, Input, KinematicsError, Limit, MachineError, RotationError, Singularity, TargetError};
pub use frame::Frame;
pub use limits::{Limits, Range};
pub use machine::{Dimensions, Home, Machine};
pub use pose::{Branch, Joints, Pose, Start};
pub use rotation::Tilted;
pub use target::Target;
pub use vector::Vector;
