//! The mathematics that joins a description, its derivation and the solver: fits, exact simulation, what is neglected.
//!
//! Nothing here reads or writes a file or a terminal.

mod budget;
mod curve;
mod draw;
mod estimate;
mod fit;
mod limits;
mod monte_carlo;
mod neglected;
pub mod plan;
mod reach;
mod recovery;
mod report;
mod response;
mod seen;
mod separation;
mod setup;
mod simulate;
mod simulation;
mod slow;
mod studies;
mod supplement;
mod systematic;
mod text;
mod told;
mod visited;
mod warning;
mod weigh;
mod weights;

pub use budget::{Budget, COVERAGE, Combined, Instrument, Line, Source, Sources};
pub use curve::{Curve, CurvePoint};
pub use draw::{SimulatedMachine, draw};
pub use estimate::{EstimateError, fit, fit_with};
pub use fit::{Estimator, Fit, Observation, Sample, Variance};
pub use limits::ErrorLimits;
pub use monte_carlo::{Draws, Spread, Trial, monte_carlo};
pub use neglected::{Neglected, neglected};
pub use reach::OutOfRange;
pub use recovery::{RecoveredFunction, Recovery, recovery};
pub use report::{EstimatedCoefficient, Report, coefficient_unit, report};
pub use seen::Seen;
pub use separation::Separation;
pub use setup::{Setup, SetupError, bars, coordinate};
pub use simulate::grid;
pub use simulation::{Simulated, Simulation};
pub use studies::{Errors, Study, StudyError, design_warning, studies};
pub use supplement::{Checked, supplement};
pub use systematic::{Contribution, Systematic, systematic};
pub use told::Told;
pub use trunnion_solver::sized::LARGEST;
pub use visited::{marks, visited};
pub use warning::{WARN_CONDITION, Warning};
pub use weigh::{WeightError, weigh};
pub use weights::Weights;
