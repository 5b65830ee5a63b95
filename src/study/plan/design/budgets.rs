//! What a set of runs would give from all sources of uncertainty.

use super::pool::Measured;
use crate::study::budget::{Source, Sources};
use crate::study::visited::{between, sweeps, visited};
use crate::study::{EstimateError, Estimator, Setup, Variance, fit_with};
use trunnion_codegen::ids::FunctionId;

/// Coordinates at which a function is looked at, less one.
const STEPS: usize = 24;

/// A function's largest expanded uncertainty over the coordinates that the runs visit, mm or rad; readings and tables are taken as
/// zero, so what is proportional to them is not in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budgeted {
    /// The function.
    pub function: FunctionId,
    /// From all that depends on what is measured.
    pub measured: f64,
    /// With what the model takes as exact, which no run makes less uncertain.
    pub whole: f64,
}

/// Of each function what these runs would give.
///
/// # Errors
/// [`EstimateError`] where the runs give none.
pub fn budgets(setup: &Setup, functions: &[FunctionId], measured: &Measured) -> Result<Vec<Budgeted>, EstimateError> {
    let observations = setup.unread(measured.samples, measured.range);
    let fit = fit_with(setup, &observations, Estimator::Joint, Variance::Known(measured.sigma))?;
    let sources = Sources::new(setup, &observations, &fit, measured.limits, &measured.instrument, false);
    let largest = |&function: &FunctionId| {
        let range = visited(setup, function, sweeps(&observations));
        let points = range.into_iter().flat_map(|range| between(range, STEPS));
        let nothing = Budgeted { function, measured: 0.0, whole: 0.0 };
        let Some(seen) = fit.seen(function) else { return Budgeted { measured: f64::INFINITY, ..nothing } };
        points.fold(nothing, |largest, x| {
            let budget = sources.function(seen, x);
            let measured = budget.without(Source::Assumptions).combined.expanded;
            Budgeted {
                function,
                measured: largest.measured.max(measured),
                whole: largest.whole.max(budget.combined.expanded),
            }
        })
    };
    Ok(functions.iter().map(largest).collect())
}
