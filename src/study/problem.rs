//! The problem that a fit solves, as far as it is a sum over the samples.

use super::fill::{Target, fill};
use super::fit::{Estimator, Failure, Fit, FitError, Variance};
use super::observation::Sample;
use super::recording::Recording;
use super::rows::Rows;
use super::seen::Seen;
use super::separation::Separation;
use super::setup::Setup;
use trunnion_codegen::ids::{BaseId, RunId};
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{self, Columns, Estimate, Unsolved};

/// What samples of some runs have come to.
pub(super) struct Problem {
    pub estimator: Estimator,
    /// The runs, each once.
    pub runs: Vec<RunId>,
    pub columns: Columns,
    pub sum: Box<dyn Estimate>,
}

impl Problem {
    /// Of no samples yet, for samples of these runs.
    pub fn new(setup: &Setup, mut runs: Vec<RunId>, estimator: Estimator) -> Result<Self, FitError> {
        runs.sort_unstable();
        runs.dedup();
        if estimator == Estimator::TwoStep && runs.iter().all(|run| sees_function(setup, *run)) {
            return Err(FitError::NoFirstStep);
        }
        let columns = columns(setup, &runs, estimator);
        let sum = sized::estimator(&columns);
        let sum = sum.ok_or_else(|| FitError::TooManyCoefficients(base(setup, &runs).len()))?;
        Ok(Self { estimator, runs, columns, sum })
    }

    /// Whether it is one of all runs of a set-up: what was read from bytes need not be.
    pub fn is_of_all(&self, setup: &Setup) -> bool {
        self.runs.iter().copied().eq(setup.model.runs.keys())
            && self.columns == columns(setup, &self.runs, self.estimator)
    }

    /// Takes the samples of a recording of one of its runs; `on_sample` is called for each, `on_rows` for the rows of every block.
    pub fn fill<R: Recording>(
        &mut self,
        setup: &Setup,
        recording: &R,
        on_sample: impl FnMut(&Sample),
        on_rows: impl FnMut(&Rows),
    ) -> Result<(), Failure<R::Error>> {
        let run = recording.run();
        if !setup.model.runs[run].nuisance.is_empty() && !recording.is_ordered() {
            return Err(FitError::NoDirection(run).into());
        }
        let step = step(setup, self.estimator, run);
        let base = base(setup, &self.runs);
        let into = Target { step, base: &base, columns: &self.columns.of(step), problem: self.sum.as_mut() };
        fill(setup, recording, into, on_sample, on_rows)
    }

    /// The estimate: a fit without what a second look at the samples tells.
    pub fn solve(&self, setup: &Setup, variance: Variance) -> Result<Fit, FitError> {
        let base = base(setup, &self.runs);
        let sigma = match variance {
            Variance::Residual => None,
            Variance::Known(std) => Some(std),
        };
        let named = |coefficients: &[usize]| coefficients.iter().map(|&i| base[i]).collect::<Vec<_>>();
        let of = |wanted: Step| {
            let own = |run: &&RunId| step(setup, self.estimator, **run) == wanted;
            self.runs.iter().filter(own).copied().collect()
        };
        let solved = self.sum.solve(sigma).map_err(|e| match e {
            Unsolved::TooFew { step, samples, needed } => {
                FitError::TooFewSamples { runs: of(step), samples: samples as usize, needed }
            }
            Unsolved::Confounded { step, coefficients } => {
                FitError::Confounded { runs: of(step), base: named(&coefficients) }
            }
            Unsolved::NotFinite => FitError::NotFinite,
        })?;
        let (condition, weakest) = solved.condition;
        let separation = Separation { condition, weakest: named(&weakest) };
        let determined = setup.derivation.determined_by(&setup.model, &base).map_err(FitError::Algebra)?;
        Ok(Fit {
            estimator: self.estimator,
            separation,
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
            of_factor: false,
            steps: Vec::new(),
            sensitivity: solved.sensitivity,
            seen: determined.into_iter().map(|d| Seen::new(setup, d)).collect(),
        })
    }
}

/// The step of a run: those that see an estimated function come second.
pub(super) fn step(setup: &Setup, estimator: Estimator, run: RunId) -> Step {
    match estimator {
        Estimator::TwoStep if sees_function(setup, run) => Step::Second,
        _ => Step::First,
    }
}

fn sees_function(setup: &Setup, run: RunId) -> bool {
    let base = &setup.derivation.base;
    setup.derivation.runs[run].regressors.iter().any(|(b, _)| base[*b].estimates.is_some())
}

fn sees(setup: &Setup, run: RunId, base: BaseId) -> bool {
    setup.derivation.runs[run].regressors.iter().any(|(b, _)| *b == base)
}

/// The base parameters that runs see, ascending.
fn base(setup: &Setup, runs: &[RunId]) -> Vec<BaseId> {
    setup.derivation.base.keys().filter(|b| runs.iter().any(|run| sees(setup, *run, *b))).collect()
}

/// Which of the base parameters that runs see are the columns of each step; a run may be there several times.
pub(super) fn columns(setup: &Setup, runs: &[RunId], estimator: Estimator) -> Columns {
    let mut columns = Columns::default();
    for (at, b) in base(setup, runs).into_iter().enumerate() {
        let seen = |wanted: Step| {
            let mut of = runs.iter().filter(|run| step(setup, estimator, **run) == wanted);
            of.any(|run| sees(setup, *run, b))
        };
        let (first, second) = (seen(Step::First), seen(Step::Second));
        let lists =
            [(first, &mut columns.first), (second && !first, &mut columns.own), (first && second, &mut columns.given)];
        lists.into_iter().filter(|(is, _)| *is).for_each(|(_, list)| list.push(at));
    }
    columns
}
