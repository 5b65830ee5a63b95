//! The part of a fit that is a sum: what samples have come to, however many they are.
//!
//! Factors of one set-up merge in any order, and are written to bytes and read from them; so the samples of many machines, or of one
//! that are kept in many places, are taken where they lie.

mod bytes;

pub use bytes::BytesError;

use super::estimate::{EstimateError, Failed};
use super::fit::{Estimator, Failure, Fit, Variance};
use super::problem::Problem;
use super::recording::Recording;
use super::setup::Setup;
use thiserror::Error;
use trunnion_solver::sized::NotTaken;

/// What samples of a set-up's runs have come to.
pub struct Factor {
    /// Which set-up it is of: its [digest](Setup::digest).
    of: [u8; 32],
    problem: Problem,
}

/// Why a factor cannot be used so.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FactorError {
    /// Of another model, other lengths, or another estimator.
    #[error("a factor of another model, other lengths or another estimator\n  expected factors of one set-up")]
    Other,
    /// The solver does not take it.
    #[error("the factor cannot be taken: {0}\n  expected a factor of fewer samples")]
    NotTaken(NotTaken),
    /// Its samples give no estimate.
    #[error(transparent)]
    Estimate(#[from] EstimateError),
}

impl Factor {
    /// Of no samples yet.
    ///
    /// # Errors
    /// [`EstimateError`] where the estimator does not suit the runs.
    pub fn new(setup: &Setup, estimator: Estimator) -> Result<Self, EstimateError> {
        let problem = Problem::new(setup, setup.model.runs.keys().collect(), estimator);
        let problem = problem.map_err(|e| EstimateError::named(setup, e))?;
        Ok(Self { of: setup.digest(), problem })
    }

    fn is_of(&self, setup: &Setup) -> bool {
        self.of == setup.digest() && self.problem.is_of_all(setup)
    }

    /// How the runs are combined.
    pub fn estimator(&self) -> Estimator {
        self.problem.estimator
    }

    /// Samples taken.
    pub fn samples(&self) -> u64 {
        self.problem.sum.stored().iter().map(|step| u64::from(step.samples)).sum()
    }

    /// Takes the samples of a run of `setup`, the one that it was made of.
    ///
    /// # Errors
    /// [`FactorError`], or why the samples cannot be had; some of them may be taken then.
    pub fn push<R: Recording>(&mut self, setup: &Setup, recording: &R) -> Result<(), Failed<R::Error, FactorError>> {
        if !self.is_of(setup) {
            return Err(Failed::Estimate(FactorError::Other));
        }
        self.problem.fill(setup, recording).map_err(|failure| match failure {
            Failure::Fit(e) => Failed::Estimate(EstimateError::named(setup, e).into()),
            Failure::Recording(e) => Failed::Recording(e),
        })
    }

    /// Takes all samples of another.
    ///
    /// # Errors
    /// [`FactorError`]; nothing is taken then.
    pub fn merge(&mut self, other: &Self) -> Result<(), FactorError> {
        let (own, others) = (&self.problem, &other.problem);
        let alike = own.estimator == others.estimator && own.runs == others.runs && own.columns == others.columns;
        if self.of != other.of || !alike {
            return Err(FactorError::Other);
        }
        self.problem.sum.absorb(&other.problem.sum.stored()).map_err(FactorError::NotTaken)
    }

    /// The estimate of its samples: a fit without what a second look at them tells, such as residuals.
    ///
    /// # Errors
    /// [`FactorError`]
    pub fn solve(&self, setup: &Setup, variance: Variance) -> Result<Fit, FactorError> {
        if !self.is_of(setup) {
            return Err(FactorError::Other);
        }
        self.problem.solve(setup, variance).map_err(|e| EstimateError::named(setup, e).into())
    }
}

impl Clone for Factor {
    fn clone(&self) -> Self {
        let Problem { estimator, runs, columns, sum } = &self.problem;
        let problem = Problem { estimator: *estimator, runs: runs.clone(), columns: columns.clone(), sum: sum.copy() };
        Self { of: self.of, problem }
    }
}

impl core::fmt::Debug for Factor {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Factor").field("estimator", &self.estimator()).field("samples", &self.samples()).finish()
    }
}
