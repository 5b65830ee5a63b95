//! The mathematics that joins a description, its derivation and the solver: fits, exact simulation, what is neglected.
//!
//! Nothing here reads or writes a file or a terminal.

mod curve;
mod draw;
mod estimate;
mod fit;
mod least_squares;
mod monte_carlo;
mod neglected;
pub mod plan;
mod recovery;
mod report;
mod setup;
mod simulate;
mod simulation;
mod studies;
mod systematic;
mod text;
mod warning;
mod weigh;
mod weights;

pub use curve::{Curve, CurvePoint};
pub use draw::{ErrorLimits, SimulatedMachine, draw};
pub use estimate::{EstimateError, fit, fit_with};
pub use fit::{Estimator, Fit, Observation, Sample, Variance};
pub use least_squares::{LARGEST, Separation};
pub use monte_carlo::{Draws, Spread, Trial, monte_carlo};
pub use neglected::{Neglected, neglected};
pub use recovery::{RecoveredFunction, Recovery, recovery};
pub use report::{EstimatedCoefficient, Report, coefficient_unit, report};
pub use setup::{Setup, SetupError, bars, coordinate};
pub use simulate::grid;
pub use simulation::{Simulated, Simulation};
pub use studies::{Study, StudyError, design_warning, studies};
pub use systematic::{Contribution, Systematic, systematic};
pub use warning::{WARN_CONDITION, Warning};
pub use weigh::{WeightError, weigh};
pub use weights::Weights;
