//! Weights of runs.

use super::fit::Observation;
use super::recording::Recording;
use super::setup::Setup;
use thiserror::Error;
use trunnion_codegen::ids::RunId;

/// Weights beyond this, or below its inverse, leave one of the runs without a say in double precision.
pub const MOST_WEIGHT: f64 = 1e9;

/// Why a run cannot have a weight.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WeightError {
    /// The model has no such run.
    #[error("the model has no run `{run}`\n  expected {}", .runs.join(", "))]
    UnknownRun {
        /// The name given.
        run: String,
        /// The runs of the model.
        runs: Vec<String>,
    },
    /// A run has two weights.
    #[error("run `{0}` is given twice\n  expected a run's weight once")]
    Twice(String),
    /// A weight beyond use: the run and its weight.
    #[error("run `{0}`: weight {1:e} is beyond use\n  expected a weight from 1e-9 to 1e9")]
    OutOfRange(String, f64),
}

/// A recording whose samples can be given a weight.
pub trait Weighed: Recording {
    /// Gives them one.
    fn weigh(&mut self, weight: f64);
}

impl Weighed for Observation {
    fn weigh(&mut self, weight: f64) {
        self.weight = weight;
    }
}

/// Gives recordings of runs the weights by these runs' names: one over the variance of a reading, up to a common factor.
/// Those without one keep theirs.
///
/// # Errors
/// [`WeightError`]
pub fn weigh<W: Weighed>(setup: &Setup, runs: &mut [W], weights: &[(&str, f64)]) -> Result<(), WeightError> {
    let mut weighed: Vec<RunId> = Vec::new();
    for &(name, weight) in weights {
        let Some(run) = setup.run(name) else {
            let runs = setup.model.runs.iter().map(|run| run.name.clone()).collect();
            return Err(WeightError::UnknownRun { run: name.to_owned(), runs });
        };
        if !(1.0 / MOST_WEIGHT..=MOST_WEIGHT).contains(&weight) {
            return Err(WeightError::OutOfRange(name.to_owned(), weight));
        }
        if weighed.contains(&run) {
            return Err(WeightError::Twice(name.to_owned()));
        }
        weighed.push(run);
        runs.iter_mut().filter(|own| own.run() == run).for_each(|own| own.weigh(weight));
    }
    Ok(())
}
