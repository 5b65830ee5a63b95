//! What a set of runs would give from all sources of uncertainty.

use super::pool::Measured;
use super::proposal::DesignError;
use crate::study::budget::Sources;
use crate::study::visited::{between, visited};
use crate::study::{Estimator, Observation, Setup, Variance, fit_with};
use trunnion_codegen::ids::FunctionId;

/// Coordinates at which a function is looked at, less one.
const STEPS: usize = 24;

/// Of each function, the largest expanded uncertainty over the coordinates that the runs visit, mm or rad; readings and tables are
/// taken as zero, so what is proportional to them is not in it.
///
/// # Errors
/// [`DesignError`] where the runs give no estimate.
pub(super) fn budgets(
    setup: &Setup,
    functions: &[FunctionId],
    measured: &Measured,
) -> Result<Vec<(FunctionId, f64)>, DesignError> {
    let sweeps = |run| setup.swept(run, measured.samples, measured.range);
    let observations: Vec<Observation> =
        setup.model.runs.keys().map(|run| Observation::zero(setup, run, &sweeps(run))).collect();
    let fit = fit_with(setup, &observations, Estimator::Joint, Variance::Known(measured.sigma))?;
    let sources = Sources::new(setup, &observations, &fit, measured.limits, &measured.instrument, false);
    let largest = |&function: &FunctionId| {
        let range = visited(setup, function, setup.model.runs.keys().map(|run| (run, sweeps(run))));
        let points = range.into_iter().flat_map(|range| between(range, STEPS));
        let u95 = |x: f64| fit.seen(function).map_or(f64::INFINITY, |seen| sources.function(seen, x).combined.expanded);
        (function, points.map(u95).fold(0.0, f64::max))
    };
    Ok(functions.iter().map(largest).collect())
}
