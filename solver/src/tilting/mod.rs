//! The tilting table measured with a ball-bar: the paper's two runs fitted sample by sample.
//!
//! The regressors are generated from `tilting-table-a` of the catalogue; this module only streams them into a
//! [`Factor`](crate::lstsq::Factor). Angles in rad, lengths and readings in mm.
//!
//! ```
//! use trunnion_solver::tilting::{Joint, ImpossibleRadius, regressors};
//!
//! let mut fit = Joint::new(150.0)?;
//! for i in 0..360 {
//!     let a = f64::from(i).to_radians();
//!     fit.push_tilting(a, 0.002 * a.sin(), [0.0, 0.0]).unwrap();
//!     fit.push_separation(a, 0.001 * a.cos()).unwrap();
//! }
//! let estimate = fit.solve().unwrap();
//! let (eps_xa, std) = estimate.eps_xa(1.0).unwrap();
//! assert!(eps_xa.abs() < 1e-12 && std < 1e-9);
//! # Ok::<(), ImpossibleRadius>(())
//! ```

mod estimate;
mod joint;
mod two_step;

/// The generated regressors of both runs and the basis of ε_xa: eqs. (7), (9), (10).
pub mod regressors {
    include!(concat!(env!("OUT_DIR"), "/tilting_table_a.rs"));
}

pub use estimate::{Estimate, FUNCTION, JointEstimate};
pub use joint::Joint;
pub use two_step::{TWO_STEP_NAMES, TwoStep, TwoStepError};

/// The bar's nominal length is not a positive finite number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImpossibleRadius;

impl core::fmt::Display for ImpossibleRadius {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the bar's nominal length is not a positive finite number")
    }
}

impl core::error::Error for ImpossibleRadius {}

fn checked<T: crate::Real>(radius: T) -> Result<T, ImpossibleRadius> {
    if radius > T::zero() && radius.is_finite() { Ok(radius) } else { Err(ImpossibleRadius) }
}
