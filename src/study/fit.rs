//! The two estimators for any model and any set of runs.
//!
//! *Joint*: all runs in one least-squares problem. *Two-step*, the paper's: the runs without an estimated function first,
//! then the others with those coefficients put in, their covariance carried along
//! ([`Order`](trunnion_solver::lstsq::Order)).

use super::histogram::{Counting, Histogram};
use super::hysteresis::Averages;
use super::misfit::{Look, Looking};
pub use super::observation::{Observation, Sample};
use super::recording::Recording;
use super::rows::{Rows, Taken, blocks};
use super::seen::Seen;
use super::separation::Separation;
use super::setup::Setup;
use super::trace::{Trace, Tracing};
use super::weighed_down::WeighedDown;
use core::convert::Infallible;
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use trunnion_codegen::algebra::AlgebraError;
use trunnion_codegen::graph::Lanes;
use trunnion_codegen::ids::{BaseId, FunctionId, RunId};
use trunnion_solver::lstsq::Step;

/// How the runs are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// All runs at once.
    #[default]
    Joint,
    /// The runs without an estimated function first.
    TwoStep,
}

/// The variance of a reading of weight one.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Variance {
    /// From the residuals.
    #[default]
    Residual,
    /// The square of this standard deviation, mm.
    Known(f64),
}

/// How a fit is made.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct How {
    /// How the runs are combined.
    pub estimator: Estimator,
    /// Where the readings' variance comes from.
    pub variance: Variance,
    /// Readings far off the others are weighed down (Huber); their variance is then from the residuals.
    pub robust: bool,
}

/// Why there is no estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum FitError {
    /// Too few samples for the coefficients.
    TooFewSamples {
        /// The runs of the step that failed.
        runs: Vec<RunId>,
        /// Samples there are.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The samples do not tell coefficients apart.
    Confounded {
        /// The runs of the step that failed.
        runs: Vec<RunId>,
        /// The base parameters concerned.
        base: Vec<BaseId>,
    },
    /// A run has terms that turn with the direction, and its samples are in no order in time.
    NoDirection(RunId),
    /// A sample, or a result, is not finite.
    NotFinite,
    /// No run is without an estimated function, so there is no first step.
    NoFirstStep,
    /// More coefficients than the solver is built for.
    TooManyCoefficients(usize),
    /// What they determine could not be worked out.
    Algebra(AlgebraError),
}

/// An estimate of the base parameters.
#[derive(Clone, Debug)]
pub struct Fit {
    /// How it was made.
    pub estimator: Estimator,
    /// Base parameters that were estimated, ascending.
    pub base: Vec<BaseId>,
    /// Their values, in the order of `base`.
    pub values: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// Degrees of freedom of the residuals that set the scale of the estimated functions' uncertainty.
    pub degrees_of_freedom: u32,
    /// Root mean square of each observation's residuals, mm.
    pub rms: Vec<f64>,
    /// What each observation's residuals look like.
    pub looks: Vec<Look>,
    /// Each observation over its sweep.
    pub traces: Vec<Trace>,
    /// Each observation's residuals, counted.
    pub histograms: Vec<Histogram>,
    /// Each observation's readings in either direction.
    pub(super) averages: Vec<Averages>,
    /// How well the samples separate the base parameters.
    pub separation: Separation,
    /// What was weighed down in each observation; none of a fit that is not robust.
    pub weighed_down: Vec<WeighedDown>,
    /// Made of a factor: what only its samples would tell is not there, neither `traces` nor `histograms` nor residuals far out.
    pub of_factor: bool,
    /// The step of each observation.
    pub(super) steps: Vec<Step>,
    /// The estimated functions as `base` gives them.
    pub(super) seen: Vec<Seen>,
    /// By how much a sample of each step moves the base parameters, in the order of `base`.
    pub(super) sensitivity: [DMatrix<f64>; 2],
}

/// Why recordings give no estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure<E> {
    /// They do not determine one.
    Fit(FitError),
    /// They cannot be read.
    Recording(E),
}

impl<E> From<FitError> for Failure<E> {
    fn from(error: FitError) -> Self {
        Self::Fit(error)
    }
}

impl Fit {
    /// The estimated functions as these readings give them.
    pub fn functions(&self) -> &[Seen] {
        &self.seen
    }

    /// Goes through the residuals.
    pub(super) fn look<R: Recording>(
        &mut self,
        setup: &Setup,
        recordings: &[R],
        mut each: impl FnMut(usize, &Sample),
    ) -> Result<(), R::Error> {
        for (at, recording) in recordings.iter().enumerate() {
            let (mut looking, mut averages) = (Looking::default(), Averages::default());
            let (mut tracing, mut counting) = (Tracing::default(), Counting::default());
            let on_sample = |sample: &Sample| {
                averages.add(sample);
                each(at, sample);
            };
            self.residuals_of(setup, recording, on_sample, |taken, residual| {
                looking.add(residual);
                tracing.add(taken, residual);
                counting.add(residual);
            })?;
            let mut look = looking.look();
            self.traces.push(tracing.trace());
            self.histograms.push(counting.histogram(look.deviation.unwrap_or(look.rms)));
            if !self.weighed_down.is_empty() {
                // They are told as what was weighed down.
                look.spikes.clear();
            }
            self.rms.push(look.rms);
            self.looks.push(look);
            self.averages.push(averages);
        }
        Ok(())
    }

    /// Readings less what the estimate makes of them, mm, in the order of the samples.
    pub fn residuals<R: Recording<Error = Infallible>>(&self, setup: &Setup, recording: &R) -> Vec<f64> {
        let mut residuals = Vec::new();
        let Ok(()) = self.residuals_of(setup, recording, |_| {}, |_, residual| residuals.push(residual));
        residuals
    }

    fn residuals_of<R: Recording>(
        &self,
        setup: &Setup,
        recording: &R,
        on_sample: impl FnMut(&Sample),
        mut each: impl FnMut(Taken, f64),
    ) -> Result<(), R::Error> {
        let places = self.places(setup, recording.run());
        blocks(setup, recording, on_sample, |rows| {
            let residuals = self.residual(rows, &places);
            rows.taken().iter().zip(residuals).for_each(|(taken, residual)| each(*taken, residual));
        })
    }

    /// Residuals of a block; `places` are those of its run's base parameters.
    pub(super) fn residual(&self, rows: &Rows, places: &[Option<usize>]) -> Lanes {
        let mut residuals = rows.explained();
        for (x, at) in rows.regressors().zip(places) {
            let value = at.map_or(0.0, |at| self.values[at]);
            residuals.iter_mut().zip(x).for_each(|(residual, x)| *residual -= x * value);
        }
        residuals
    }

    /// The step of an observation.
    pub(super) fn step(&self, observation: usize) -> Step {
        self.steps.get(observation).copied().unwrap_or(Step::First)
    }

    /// An estimated function as these readings give it.
    pub fn seen(&self, function: FunctionId) -> Option<&Seen> {
        self.seen.iter().find(|s| s.function() == function)
    }

    /// Value and standard deviation of an estimated function, or of the sum it is seen in, at a coordinate of its axis (mm or
    /// rad).
    pub fn function(&self, setup: &Setup, function: FunctionId, x: f64) -> (f64, f64) {
        let g = self.functional(setup, function, x);
        (g.dot(&self.values), (&self.covariance * &g).dot(&g).max(0.0).sqrt())
    }

    /// A base parameter alone, in the order of `base`.
    pub(super) fn coefficient(&self, base: BaseId) -> DVector<f64> {
        self.placed([([(base, 1.0)].as_slice(), 1.0)])
    }

    /// Combinations of base parameters, each times a factor, in the order of `base`.
    pub(super) fn placed<'a>(
        &self,
        combinations: impl IntoIterator<Item = (&'a [(BaseId, f64)], f64)>,
    ) -> DVector<f64> {
        let mut placed = DVector::zeros(self.base.len());
        for (combination, factor) in combinations {
            for (b, f) in combination {
                if let Ok(at) = self.base.binary_search(b) {
                    placed[at] += f * factor;
                }
            }
        }
        placed
    }

    /// By how much a reading of an observation moves the base parameters, times its weight and its row.
    pub(super) fn sensitivity_of(&self, observation: usize) -> &DMatrix<f64> {
        &self.sensitivity[usize::from(self.step(observation) == Step::Second)]
    }

    /// Where the base parameters that a run sees are in `base`.
    pub(super) fn places(&self, setup: &Setup, run: RunId) -> Vec<Option<usize>> {
        let regressors = setup.derivation.runs[run].regressors.iter();
        regressors.map(|(b, _)| self.base.binary_search(b).ok()).collect()
    }

    /// What a function, as it is seen, is in base parameters.
    pub(super) fn functional_of(&self, setup: &Setup, seen: &Seen, x: f64) -> DVector<f64> {
        self.placed(seen.combinations().zip(seen.basis(setup, x)))
    }

    pub(super) fn functional(&self, setup: &Setup, function: FunctionId, x: f64) -> DVector<f64> {
        self.seen(function).map_or_else(|| DVector::zeros(self.base.len()), |seen| self.functional_of(setup, seen, x))
    }
}
