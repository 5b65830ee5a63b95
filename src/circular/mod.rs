//! The circular test of ISO 230-4: its figures, and what else is read from the trace of a ball-bar.
//!
//! ```
//! use trunnion::circular::{Test, Trace, Traces, circular};
//!
//! // An ellipse: X travels 10 µm more than Y over 300 mm.
//! let step = |k: u32| f64::from(k).to_radians();
//! let trace = || Trace::new((0..360).map(|k| (step(k), 0.0025 * (2.0 * step(k)).cos())));
//! let traces = Traces::Both { clockwise: trace()?, counterclockwise: trace()? };
//! let result = circular(&Test { traces, radius: trunnion::data::Radius::new(150.0)?, plane: Default::default(), feed: None })?;
//! assert!((result.paths[0].circles.zone.width() - 0.005).abs() < 1e-7);
//! let both = result.both.as_ref().unwrap();
//! assert!((both.circles.least_squares.roundness() - 0.005).abs() < 1e-7 && both.hysteresis.unwrap().deviation < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Nothing here reads or writes a file or a terminal. Lengths are in mm and angles in rad.

mod circles;
mod direction;
mod effects;
mod error;
mod figures;
mod picture;
mod plane;
mod profile;
mod spikes;
mod terms;
mod text;
mod trace;
mod undetermined;

pub use circles::{At, Circles, Radial};
pub use direction::Direction;
pub use effects::{Effect, Estimate, Scatter};
pub use error::{CircularError, Which};
pub use figures::{Both, Circular, Path, Test, Warning, circular};
pub use picture::picture;
pub use plane::{Axis, Plane, Reversal};
pub use profile::Profile;
pub use spikes::{Height, Spike};
pub use terms::{Measure, Term};
pub use trace::{Trace, TraceError, Traces};
pub use undetermined::Undetermined;
