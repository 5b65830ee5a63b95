//! From recordings to a fit.

use super::fit::{Failure, Fit, How, Sample};
use super::problem::{Problem, step};
use super::recording::Recording;
use super::robust::weigh_down;
use super::setup::Setup;

/// Fits `recordings`; a run that was measured several times is there as often. They are gone through twice, once for the factor
/// and once for the residuals; `each` is called the second time for every sample, with its recording's position.
///
/// # Errors
/// [`Failure`]
pub fn fit<R: Recording>(
    setup: &Setup,
    recordings: &[R],
    how: How,
    each: impl FnMut(usize, &Sample),
) -> Result<Fit, Failure<R::Error>> {
    let How { estimator, variance, robust } = how;
    let mut problem = Problem::new(setup, recordings.iter().map(Recording::run).collect(), estimator)?;
    recordings.iter().try_for_each(|recording| problem.fill(setup, recording, |_| {}, |_| {}))?;
    let mut fit = problem.solve(setup, variance)?;
    fit.steps = recordings.iter().map(|recording| step(setup, estimator, recording.run())).collect();
    if robust {
        fit.weighed_down = weigh_down(setup, recordings, &mut fit, &problem.columns, problem.sum.as_ref())?;
    }
    fit.look(setup, recordings, each).map_err(Failure::Recording)?;
    Ok(fit)
}
