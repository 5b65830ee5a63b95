//! Least squares of fixed size for the measurement models of machine tools: sample by sample, inside the controller.
//!
//! ```
//! use trunnion_solver::tilting::{Joint, Lengths, NAMES};
//!
//! // A tilting table's two ball-bar runs, a bar of 150 mm; angles in rad, readings and known functions in mm.
//! let mut fit = Joint::new(Lengths { r: 150.0_f32 })?;
//! for i in 0..360_u16 {
//!     let a = f32::from(i).to_radians();
//!     fit.push_tilting(a, 0.002 * a.sin(), 0.0, 0.0)?;
//!     fit.push_separation(a, 0.001 * a.cos())?;
//! }
//! let estimate = fit.solve().map_err(|e| e.named(&NAMES).to_string())?;
//! let (eps_xa, std) = estimate.e_xa(1.0)?;
//! assert!(eps_xa.abs() < 1e-7 && std < 1e-7);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same for a machine of one's own: [`Machine`](https://docs.rs/trunnion-derive) writes it for a struct, and
//! `trunnion_codegen::build::model` for a model file. `no_std`, no heap, no unsafe code; every call ends in bounded time and none can panic,
//! which the repository shows by linking (`docs/controller.md` there, with the cost of each call on a Cortex-M4F).
//!
//! | module | holds | feature |
//! |---|---|---|
//! | [`lstsq`] | the streaming factor, its solution and condition, two steps | |
//! | [`tilting`] | the paper's tilting table T, as the generator prints it | |
//! | [`model`] | what the fit of a generated model may refuse | |
//! | `circle` | circles through probed points | `circle`, on by default |
//! | `DoubleDouble` | 31 digits for the factor, where the method itself is calibrated | `double-double` |
//! | `exechon` | the parallel machine of paper E: kinematics, dependent rotation | `exechon`, on by default |
//! | `probe` | a touch probe's offset | `probe`, on by default |
//! | `Machine` | the macro for a machine of one's own | `derive` |
//!
//! The feature `std` takes the standard library's mathematics in the place of `libm`.
//!
//! Equations are cited as T(7) and E(7), after the tilting-table and the Exechon paper, which
//! [the documentation](https://github.com/trunnion-metrology/trunnion/blob/main/docs/README.md) cites in full.
#![no_std]
#[cfg(feature = "sized")]
extern crate std;

mod block;
#[cfg(feature = "circle")]
pub mod circle;
#[cfg(feature = "double-double")]
mod double_double;
#[cfg(feature = "exechon")]
pub mod exechon;
#[doc(hidden)]
pub mod generated;
pub mod lstsq;
pub mod model;
#[cfg(feature = "probe")]
pub mod probe;
#[cfg(feature = "sized")]
pub mod sized;
pub mod tilting;
mod trig;

#[cfg(feature = "double-double")]
pub use double_double::DoubleDouble;
pub use lstsq::Real;
/// The crates that generated code and its callers speak in.
pub use {nalgebra, num_traits};

/// Derives the measurement model of a user's own machine.
#[cfg(feature = "derive")]
pub use trunnion_derive::Machine;
