//! The part of a fit that is a sum: what samples have come to, however many they are.
//!
//! Factors of one set-up merge in any order, and are written to bytes and read from them; so the samples of many machines, or of one
//! that are kept in many places, are taken where they lie. Beside the triangle a factor keeps, of each run, where its samples were
//! and how large and how alike their residuals will be: all that a report needs but what only the samples themselves tell.

mod bytes;
mod cells;
mod kept;
mod reader;
mod squares;

pub use reader::BytesError;

use super::estimate::{EstimateError, Failed};
use super::fit::{Estimator, Failure, Fit, Variance};
use super::observation::Observation;
use super::problem::{Problem, step};
use super::recording::Recording;
use super::rows::Rows;
use super::setup::Setup;
use cells::Cells;
use kept::Kept;
use squares::Squaring;
use thiserror::Error;
use trunnion_solver::sized::NotTaken;

/// What samples of a set-up's runs have come to.
pub struct Factor {
    /// Which set-up it is of: its [digest](Setup::digest).
    of: [u8; 32],
    problem: Problem,
    /// Of each run and weight what else is kept, in their order.
    kept: Vec<Kept>,
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
        Ok(Self { of: setup.digest(), problem, kept: Vec::new() })
    }

    fn is_of(&self, setup: &Setup) -> bool {
        self.of == setup.digest() && self.problem.is_of_all(setup) && self.kept.iter().all(|kept| kept.is_of(setup))
    }

    /// How the runs are combined.
    pub fn estimator(&self) -> Estimator {
        self.problem.estimator
    }

    /// Samples taken.
    pub fn samples(&self) -> u64 {
        self.problem.sum.stored().iter().map(|step| u64::from(step.samples)).sum()
    }

    /// Whether all known functions were zero in all samples: whoever had no table for them.
    pub fn without_table(&self) -> bool {
        !self.kept.iter().any(|kept| kept.cells.has_known())
    }

    /// Takes the samples of a run of `setup`, the one that it was made of.
    ///
    /// # Errors
    /// [`FactorError`], or why the samples cannot be had; none of them is taken then.
    pub fn push<R: Recording>(&mut self, setup: &Setup, recording: &R) -> Result<(), Failed<R::Error, FactorError>> {
        if !self.is_of(setup) {
            return Err(Failed::Estimate(FactorError::Other));
        }
        let (run, before) = (recording.run(), self.problem.sum.copy());
        let mut cells = Cells::default();
        let mut squaring = Squaring::new(setup.derivation.runs[run].regressors.len());
        let filled = self.problem.fill(setup, recording, |sample| cells.add(sample), |rows: &Rows| squaring.add(rows));
        filled.map_err(|failure| {
            self.problem.sum = before;
            match failure {
                Failure::Fit(e) => Failed::Estimate(EstimateError::named(setup, e).into()),
                Failure::Recording(e) => Failed::Recording(e),
            }
        })?;
        Kept::new(run, recording.weight(), cells, squaring).put_to(&mut self.kept);
        Ok(())
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
        self.problem.sum.absorb(&other.problem.sum.stored()).map_err(FactorError::NotTaken)?;
        other.kept.iter().for_each(|kept| kept.put_to(&mut self.kept));
        Ok(())
    }

    /// The estimate of its samples, and observations that stand for all of them in a [report](super::report_on), one for each run
    /// and weight.
    ///
    /// Of the residuals it has the size and the correlation of neighbours, and nothing that is seen in single samples: no traces, no
    /// histograms, none far out.
    ///
    /// # Errors
    /// [`FactorError`]
    pub fn solve(&self, setup: &Setup, variance: Variance) -> Result<(Fit, Vec<Observation>), FactorError> {
        if !self.is_of(setup) {
            return Err(FactorError::Other);
        }
        let mut fit = self.problem.solve(setup, variance).map_err(|e| EstimateError::named(setup, e))?;
        let kept = || self.kept.iter();
        fit.of_factor = true;
        fit.steps = kept().map(|kept| step(setup, self.problem.estimator, kept.run)).collect();
        fit.looks = kept().map(|kept| kept.look(setup, &fit)).collect();
        fit.rms = fit.looks.iter().map(|look| look.rms).collect();
        fit.averages = kept().map(|kept| kept.cells.averages()).collect();
        let observations = kept().map(|kept| kept.observation(setup, &fit)).collect();
        Ok((fit, observations))
    }
}

impl Clone for Factor {
    fn clone(&self) -> Self {
        let Problem { estimator, runs, columns, sum } = &self.problem;
        let problem = Problem { estimator: *estimator, runs: runs.clone(), columns: columns.clone(), sum: sum.copy() };
        Self { of: self.of, problem, kept: self.kept.clone() }
    }
}

impl core::fmt::Debug for Factor {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Factor").field("estimator", &self.estimator()).field("samples", &self.samples()).finish()
    }
}
