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

mod condition;
mod error;
mod factor;
mod real;
mod solution;
mod solve;
mod student;
mod subset;
mod triangle;

pub use condition::Condition;
pub use error::{Confounded, Rejected, SolveError};
pub use factor::Factor;
pub use real::Real;
pub use solution::Solution;
pub use student::student_t_95;
pub use subset::Subset;
