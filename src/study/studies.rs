//! Monte Carlo studies of every estimated function, with several estimators.

use super::estimate::{EstimateError, fit};
use super::fit::Estimator;
use super::monte_carlo::{Draws, Trial, monte_carlo, noise_alone};
use super::setup::Setup;
use super::spread::Spread;
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
    /// On drawn machines; none where noise alone was drawn.
    pub machines: Option<MachineErrors>,
}

/// Distributions of the largest error on drawn machines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MachineErrors {
    /// From linearisation alone.
    pub linearisation: Spread,
    /// From noise and linearisation.
    pub both: Spread,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// Machines, and noise.
    Machines,
    /// Noise: what it does is the same on every machine.
    NoiseAlone,
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

/// Every estimated function with every estimator; `done` is called after every trial.
///
/// # Errors
/// [`StudyError`]
pub fn studies(
    setup: &Setup,
    draws: Draws,
    drawn: Drawn,
    estimators: &[Estimator],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Study>, StudyError> {
    let functions: Vec<FunctionId> = setup.estimated().collect();
    if functions.is_empty() {
        return Err(StudyError::NothingEstimated);
    }
    let of = |&estimator: &Estimator| functions.iter().map(move |&function| (estimator, function));
    let asked: Vec<(Estimator, FunctionId)> = estimators.iter().flat_map(of).collect();
    let study = |(&(estimator, function), (told, errors)): (&(Estimator, FunctionId), (Told, _))| Study {
        estimator,
        function: setup.function_name(function),
        told,
        unit: setup.quantity(function).deviation(),
        errors,
    };
    let spread = |&(_, function): &(Estimator, FunctionId), sizes: &mut dyn Iterator<Item = f64>| {
        let unit = setup.quantity(function).deviation();
        Spread::of(sizes.map(|size| unit.from_inner(size)).collect())
    };
    let errors: Vec<(Told, Option<Errors>)> = match drawn {
        Drawn::Machines => {
            let errors = |(asked, (told, trials)): (&_, (Told, Vec<Trial>))| {
                let spread = |of: fn(&Trial) -> f64| spread(asked, &mut trials.iter().map(of));
                let machines =
                    || Some(MachineErrors { linearisation: spread(|t| t.linearisation)?, both: spread(|t| t.both)? });
                (told, spread(|t| t.noise).map(|noise| Errors { noise, machines: machines() }))
            };
            asked.iter().zip(monte_carlo(setup, draws, &asked, done)?).map(errors).collect()
        }
        Drawn::NoiseAlone => {
            let errors = |(asked, (told, sizes)): (&_, (Told, Vec<f64>))| {
                (told, spread(asked, &mut sizes.into_iter()).map(|noise| Errors { noise, machines: None }))
            };
            asked.iter().zip(noise_alone(setup, draws, &asked, done)?).map(errors).collect()
        }
    };
    Ok(asked.iter().zip(errors).map(study).collect())
}

/// What to be wary of before anything is drawn.
///
/// # Errors
/// [`EstimateError`]
pub fn design_warning(setup: &Setup, draws: Draws, estimator: Estimator) -> Result<Option<Warning>, EstimateError> {
    let separation = fit(setup, &setup.unread(draws.samples, draws.range), estimator)?.separation;
    Ok(Warning::hardly_separated(setup, &separation, goes_round(draws.range)))
}
