//! Streaming least squares of fixed size.
//!
//! A sample becomes one row of regressors and is rotated into a triangular [`Factor`]; coefficients, covariance and
//! condition come from the factor. Memory and time are constant, and two factors [merge](Factor::merge) into that of
//! both data sets.
//!
//! ```
//! use nalgebra::vector;
//! use trunnion_solver::lstsq::{Factor, student_t_95};
//!
//! let mut line = Factor::<f64, 2>::new();
//! for (x, y) in [(0.0, 1.1), (1.0, 2.9), (2.0, 5.2), (3.0, 6.8)] {
//!     line.push(&vector![1.0, x], y)?;
//! }
//! let fit = line.solve()?;
//! let slope = fit.coefficients[1];
//! let band = student_t_95::<f64>(fit.degrees_of_freedom) * fit.std()[1];
//! assert!((slope - 1.94).abs() < 1e-12 && (2.0 - slope).abs() < band);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Scaling
//!
//! The factor itself does not mind the columns' units. Every decision about them (rank, condition, which coefficients are
//! concerned) is made as if each column had unit norm, so it is the same in mm and in µm. What scaling cannot mend is
//! a badly placed origin: powers of x over a range far from zero are nearly parallel. Shift x to the middle of its range.
//!
//! # Accuracy
//!
//! Digits reached on the linear-regression sets of NIST's Statistical Reference Datasets: those of the worst coefficient,
//! of the worst standard deviation, and of the residual standard deviation, at most 15 as certified (where zero is certified,
//! those of the absolute error). *Shifted*: x less the middle of its range, over the power of two at or above the half range,
//! computed in the arithmetic under test; the result is expanded back to the certified variable exactly. In `f32` the data
//! and powers are rounded to seven digits before the fit sees them, and Wampler 4 and 5 bury coefficients of one under
//! residuals of 2·10⁵ and 2·10⁷. *Double-double* is the scalar `DoubleDouble` of the feature `double-double`, for who calibrates
//! the method itself: a push of 13 unknowns takes 40 times as long as in `f64`, a solution 17 times
//! (`cargo bench -p trunnion-solver --bench lstsq`).
//!
#![doc = include_str!("digits.md")]
//!
//! The ball-bar runs this crate is for are kinder: at 360 and at 36,000 samples a run, `f32` keeps the angular error within
//! 0.001 µrad of `f64` (`tests/single_precision.rs`).

#![expect(clippy::needless_range_loop, reason = "equations of matrices read by index; every bound is a constant")]

mod blocked;
mod columns;
mod condition;
mod error;
mod factor;
mod kernel;
mod order;
mod preconditioned;
mod real;
mod residual;
mod rotate;
mod solution;
mod solve;
#[cfg(feature = "sized")]
mod stored;
mod student;
mod subset;
mod triangle;
mod two_step;
mod upper;

pub use blocked::Blocked;
pub use condition::Condition;
pub use error::{Confounded, Named, Rejected, SolveError, Step, TwoStepError};
pub use factor::Factor;
pub use kernel::{Column, Kernel, Portable, ROWS};
pub use order::{Order, OrderError};
pub use real::Real;
pub use solution::Solution;
pub use student::student_t_95;
pub use subset::Subset;
pub use two_step::Sensitivity;
