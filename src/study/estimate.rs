//! An estimate, or why there is none in the names that a person knows: inside, runs and coefficients are positions.

use super::fit::{Estimator, Failure, Fit, FitError, How, Observation, Variance};
use super::recording::{Few, Recording};
use super::setup::Setup;
use super::solved;
use core::fmt;
use thiserror::Error;
use trunnion_codegen::algebra::AlgebraError;
use trunnion_codegen::ids::{BaseId, RunId};
use trunnion_solver::sized::LARGEST;

/// Why there is no estimate; runs and coefficients by name.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EstimateError {
    /// Too few samples for the coefficients.
    #[error("{}: {samples} samples where at least {needed} are needed\n  measure at more angles", .runs.join(", "))]
    TooFewSamples {
        /// The runs fitted together.
        runs: Vec<String>,
        /// Samples there are.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The samples do not tell coefficients apart.
    #[error(
        "{}: these samples cannot tell {} apart\n  measure at more angles over a longer arc, runs with `nuisance` in both directions, or leave terms out",
        .runs.join(", "),
        .coefficients.join(", ")
    )]
    Confounded {
        /// The runs fitted together.
        runs: Vec<String>,
        /// The coefficients concerned.
        coefficients: Vec<String>,
    },
    /// A run has terms that turn with the direction, and its samples are in no order in time.
    #[error(
        "{0}: the samples go up and down in no order, so that nobody knows which way the axes moved\n  \
         expected them in the order in which they were taken, or a run without `nuisance`"
    )]
    NoDirection(String),
    /// A sample, or a result, is not finite.
    #[error("a value is too large for the arithmetic\n  check the readings, the table and their units")]
    NotFinite,
    /// No run is without an estimated function, so there is no first step.
    #[error("two-step needs a run that does not see an estimated function\n  use the joint estimator")]
    NoFirstStep,
    /// More coefficients than the solver is built for.
    #[error(
        "{0} coefficients where at most {LARGEST} can be fitted together\n  leave runs out or use simpler functions"
    )]
    TooManyCoefficients(usize),
    /// What the readings determine could not be worked out.
    #[error("what these runs determine cannot be worked out: {0}\n  simplify the description")]
    Algebra(AlgebraError),
    /// Not a function that the model is made to find.
    #[error("`{0}` is not estimated\n  expected a name in `estimate = […]` of the model file")]
    NotEstimated(String),
}

impl EstimateError {
    pub(super) fn named(setup: &Setup, error: FitError) -> Self {
        let runs = |runs: Vec<RunId>| runs.into_iter().map(|run| setup.model.runs[run].name.clone()).collect();
        let coefficients =
            |base: Vec<BaseId>| base.into_iter().map(|b| setup.derivation.base[b].name.clone()).collect();
        match error {
            FitError::TooFewSamples { runs: of, samples, needed } => {
                Self::TooFewSamples { runs: runs(of), samples, needed }
            }
            FitError::Confounded { runs: of, base } => {
                Self::Confounded { runs: runs(of), coefficients: coefficients(base) }
            }
            FitError::NoDirection(run) => Self::NoDirection(setup.model.runs[run].name.clone()),
            FitError::NotFinite => Self::NotFinite,
            FitError::NoFirstStep => Self::NoFirstStep,
            FitError::TooManyCoefficients(count) => Self::TooManyCoefficients(count),
            FitError::Algebra(error) => Self::Algebra(error),
        }
    }

    /// The same with what a caller calls the runs, such as their files.
    #[must_use]
    pub fn rename(mut self, name: impl Fn(&str) -> String) -> Self {
        if let Self::TooFewSamples { runs, .. } | Self::Confounded { runs, .. } = &mut self {
            runs.iter_mut().for_each(|run| *run = name(run));
        }
        self
    }
}

/// Fits `observations`; a run that was measured several times is there as often.
///
/// # Errors
/// [`EstimateError`]
pub fn fit(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Result<Fit, EstimateError> {
    fit_with(setup, observations, estimator, Variance::Residual)
}

/// As [`fit`], with the variance of the readings from elsewhere.
///
/// # Errors
/// [`EstimateError`]
pub fn fit_with(
    setup: &Setup,
    observations: &[Observation],
    estimator: Estimator,
    variance: Variance,
) -> Result<Fit, EstimateError> {
    let how = How { estimator, variance, robust: false };
    solved::fit(setup, observations, how, |_, _| {}).map_err(|failure| match failure {
        Failure::Fit(error) => EstimateError::named(setup, error),
        Failure::Recording(never) => match never {},
    })
}

/// As [`fit`], of recordings that are gone through again and again instead of being kept; with it the observations that stand
/// for all samples in a [report](super::report_on).
///
/// # Errors
/// [`EstimateError`], or why they cannot be read.
pub fn fit_recorded<R: Recording>(
    setup: &Setup,
    recordings: &[R],
    how: How,
) -> Result<(Fit, Vec<Observation>), Failed<R::Error>> {
    let mut few: Vec<Few> = recordings.iter().map(|_| Few::default()).collect();
    let fit = solved::fit(setup, recordings, how, |at, sample| few[at].add(sample));
    let fit = fit.map_err(|failure| match failure {
        Failure::Fit(error) => Failed::Estimate(EstimateError::named(setup, error)),
        Failure::Recording(error) => Failed::Recording(error),
    })?;
    let standing = few.into_iter().zip(recordings).zip(&fit.looks);
    let standing = standing.map(|((few, recording), look)| few.standing_for(recording, &look.spikes));
    let standing = standing.collect::<Result<Vec<_>, _>>().map_err(Failed::Recording)?;
    Ok((fit, standing))
}

/// Why recordings give no estimate.
#[derive(Debug)]
pub enum Failed<E, Why = EstimateError> {
    /// They do not determine one.
    Estimate(Why),
    /// They cannot be read.
    Recording(E),
}

/// As the command line and JSON call it.
impl fmt::Display for Estimator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Joint => "joint",
            Self::TwoStep => "two-step",
        })
    }
}
