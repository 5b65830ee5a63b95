//! The mathematics that joins a description, its derivation and the solver: fits, exact simulation, what is neglected.
//!
//! Nothing here reads or writes a file or a terminal.

mod draw;
mod fit;
mod least_squares;
mod monte_carlo;
mod neglected;
pub mod plan;
mod report;
mod setup;
mod simulate;
mod systematic;
mod weights;

pub use draw::{Limits, Machine, draw};
pub use fit::{Estimator, Fit, FitError, Observation, Sample, Variance, fit, fit_with};
pub use least_squares::{LARGEST, Separation};
pub use monte_carlo::{Plan, Spread, Trial, monte_carlo};
pub use neglected::{Neglected, neglected};
pub use report::{Coefficient, Curve, Point, Report, WARN_CONDITION, Warning, coefficient_unit, report};
pub use setup::{Setup, SetupError, coordinate};
pub use simulate::grid;
pub use systematic::{Systematic, Term, systematic};
pub use weights::Weights;
