//! Monte Carlo studies of every estimated function, with several estimators.

use super::estimate::{EstimateError, fit};
use super::fit::Estimator;
use super::monte_carlo::{Draws, Spread, Trial, monte_carlo};
use super::setup::Setup;
use super::told::Told;
use super::warning::{Warning, goes_round};
use thiserror::Error;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::quantity::Unit;

/// Distributions of the largest error of one function with one estimator, in the function's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// How it was estimated.
    pub estimator: Estimator,
    /// Name of the function.
    pub function: String,
    /// How far it is determined: of a sum of several errors, the error of the sum.
    pub told: Told,
    /// µrad or µm.
    pub unit: Unit,
    /// Where the errors come from; none of a function that is not seen.
    pub errors: Option<Errors>,
}

/// Distributions of the largest error by where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// From noise alone.
    pub noise: Spread,
    /// From linearisation alone.
    pub linearisation: Spread,
    /// From both.
    pub both: Spread,
}

/// Why there is no study.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The model has no estimated function.
    #[error("the model estimates no function\n  expected a name in `estimate = […]` of the model file")]
    NothingEstimated,
    /// There would be no estimate.
    #[error(transparent)]
    Estimate(#[from] EstimateError),
}

/// Every estimated function with every estimator; `done` is called after every machine.
///
/// # Errors
/// [`StudyError`]
pub fn studies(
    setup: &Setup,
    draws: Draws,
    estimators: &[Estimator],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Study>, StudyError> {
    let functions: Vec<FunctionId> = setup.estimated().collect();
    if functions.is_empty() {
        return Err(StudyError::NothingEstimated);
    }
    let mut studies = Vec::new();
    for &estimator in estimators {
        for &function in &functions {
            let (told, trials) = monte_carlo(setup, draws, estimator, function, done)?;
            let unit = setup.quantity(function).deviation();
            let spread = |of: fn(&Trial) -> f64| Spread::of(trials.iter().map(|t| unit.from_inner(of(t))).collect());
            let errors = || {
                let (noise, linearisation) = (spread(|t| t.noise)?, spread(|t| t.linearisation)?);
                Some(Errors { noise, linearisation, both: spread(|t| t.both)? })
            };
            let function = setup.function_name(function);
            studies.push(Study { estimator, function, told, unit, errors: errors() });
        }
    }
    Ok(studies)
}

/// What to be wary of before anything is drawn.
///
/// # Errors
/// [`EstimateError`]
pub fn design_warning(setup: &Setup, draws: Draws, estimator: Estimator) -> Result<Option<Warning>, EstimateError> {
    let separation = fit(setup, &setup.unread(draws.samples, draws.range), estimator)?.separation;
    Ok(Warning::hardly_separated(setup, &separation, goes_round(draws.range)))
}
