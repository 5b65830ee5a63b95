//! From recordings to a fit.

use super::fill::fill;
use super::fit::{Estimator, Failure, Fit, FitError, How, Sample, Variance};
use super::recording::Recording;
use super::robust::weigh_down;
use super::seen::Seen;
use super::separation::Separation;
use super::setup::Setup;
use trunnion_codegen::ids::{BaseId, RunId};
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{self, Columns, Unsolved};

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
    let unordered = |r: &&R| !setup.model.runs[r.run()].nuisance.is_empty() && !r.is_ordered();
    if let Some(recording) = recordings.iter().find(unordered) {
        return Err(FitError::NoDirection(recording.run()).into());
    }
    let runs: Vec<RunId> = recordings.iter().map(Recording::run).collect();
    let steps = steps(setup, &runs, estimator)?;
    let (base, columns) = columns(setup, &runs, &steps);
    let mut problem = sized::estimator(&columns).ok_or(FitError::TooManyCoefficients(base.len()))?;
    for (recording, &step) in recordings.iter().zip(&steps) {
        fill(setup, recording, step, &base, &columns.of(step), problem.as_mut())?;
    }
    let sigma = match variance {
        Variance::Residual => None,
        Variance::Known(std) => Some(std),
    };
    let named = |coefficients: &[usize]| coefficients.iter().map(|&i| base[i]).collect::<Vec<_>>();
    let of = |step: Step| runs.iter().zip(&steps).filter(|(_, s)| **s == step).map(|(run, _)| *run).collect();
    let solved = problem.solve(sigma).map_err(|e| match e {
        Unsolved::TooFew { step, samples, needed } => {
            FitError::TooFewSamples { runs: of(step), samples: samples as usize, needed }
        }
        Unsolved::Confounded { step, coefficients } => {
            FitError::Confounded { runs: of(step), base: named(&coefficients) }
        }
        Unsolved::NotFinite => FitError::NotFinite,
    })?;
    let (condition, weakest) = solved.condition;
    let mut fit = Fit {
        estimator,
        separation: Separation { condition, weakest: named(&weakest) },
        base,
        values: solved.coefficients,
        covariance: solved.covariance,
        degrees_of_freedom: solved.degrees_of_freedom,
        rms: Vec::new(),
        looks: Vec::new(),
        traces: Vec::new(),
        histograms: Vec::new(),
        averages: Vec::new(),
        weighed_down: Vec::new(),
        steps,
        sensitivity: solved.sensitivity,
        seen: Vec::new(),
    };
    let determined = setup.derivation.determined_by(&setup.model, &fit.base).map_err(FitError::Algebra)?;
    fit.seen = determined.into_iter().map(|d| Seen::new(setup, d)).collect();
    if robust {
        fit.weighed_down = weigh_down(setup, recordings, &mut fit, &columns, problem.as_ref())?;
    }
    fit.look(setup, recordings, each).map_err(Failure::Recording)?;
    Ok(fit)
}

/// The step of each observation: those that see an estimated function come second.
fn steps(setup: &Setup, runs: &[RunId], estimator: Estimator) -> Result<Vec<Step>, FitError> {
    let base = &setup.derivation.base;
    let sees_function =
        |run: &RunId| setup.derivation.runs[*run].regressors.iter().any(|(b, _)| base[*b].estimates.is_some());
    match estimator {
        Estimator::Joint => Ok(vec![Step::First; runs.len()]),
        Estimator::TwoStep if runs.iter().all(sees_function) => Err(FitError::NoFirstStep),
        Estimator::TwoStep => {
            Ok(runs.iter().map(|run| if sees_function(run) { Step::Second } else { Step::First }).collect())
        }
    }
}

/// The base parameters that the observations see, and which of them are the columns of each step.
pub(super) fn columns(setup: &Setup, runs: &[RunId], steps: &[Step]) -> (Vec<BaseId>, Columns) {
    let seen = |step: Step, b: BaseId| {
        let mut of = runs.iter().zip(steps).filter(|(_, s)| **s == step);
        of.any(|(run, _)| setup.derivation.runs[*run].regressors.iter().any(|(c, _)| *c == b))
    };
    let mut columns = Columns::default();
    let mut base = Vec::new();
    for b in setup.derivation.base.keys() {
        let (first, second) = (seen(Step::First, b), seen(Step::Second, b));
        if first || second {
            let lists = [
                (first, &mut columns.first),
                (second && !first, &mut columns.own),
                (first && second, &mut columns.given),
            ];
            lists.into_iter().filter(|(is, _)| *is).for_each(|(_, list)| list.push(base.len()));
            base.push(b);
        }
    }
    (base, columns)
}
