//! The two estimators for any model and any set of runs.
//!
//! *Joint*: all runs in one least-squares problem. *Two-step*, the paper's: the runs without an estimated function first,
//! then the others with those coefficients put in; their covariance is carried along: with e = P₁(y₁ − K k) and
//! G = −P₁K, `cov e = s₁² (E'E)⁻¹ + G cov k G'`.

use super::least_squares::{self, Separation, Solved, Unsolved};
use super::setup::Setup;
use super::weights::Weights;
use nalgebra::{DMatrix, DVector};
use trunnion_codegen::ids::{BaseId, FunctionId, RunId};

/// How the runs are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Estimator {
    /// All runs at once.
    #[default]
    Joint,
    /// The runs without an estimated function first.
    TwoStep,
}

/// One sample of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The sweep, rad.
    pub sweep: f64,
    /// The reading, mm.
    pub reading: f64,
    /// Values of the run's known functions (mm or rad), in the order of its derivation.
    pub known: Vec<f64>,
}

/// The data of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The run.
    pub run: RunId,
    /// Weight of each sample: one over the variance of its reading, up to a common factor.
    pub weight: f64,
    /// Its samples.
    pub samples: Vec<Sample>,
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

impl Observation {
    /// A run at the given sweeps (rad) with all readings zero: for what does not depend on readings.
    pub fn zero(setup: &Setup, run: RunId, sweeps: &[f64]) -> Self {
        let known = vec![0.0; setup.derivation.runs[run].known.len()];
        let samples = sweeps.iter().map(|&sweep| Sample { sweep, reading: 0.0, known: known.clone() }).collect();
        Self { run, weight: 1.0, samples }
    }
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
    /// A sample, or a result, is not finite.
    NotFinite,
    /// No run is without an estimated function, so there is no first step.
    NoFirstStep,
    /// More coefficients than the solver is built for.
    TooManyCoefficients(usize),
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
    /// How well the samples separate the base parameters.
    pub separation: Separation,
    steps: Vec<Step>,
}

/// A least-squares problem: unknown `columns` from `observations`, `given` columns from the step before.
#[derive(Clone, Debug)]
struct Step {
    observations: Vec<usize>,
    columns: Vec<BaseId>,
    given: Vec<BaseId>,
    /// (E'WE)⁻¹
    inverse: DMatrix<f64>,
    /// ∂columns/∂given
    gain: DMatrix<f64>,
}

/// Fits `observations`; each run at most once.
///
/// # Errors
/// [`FitError`]
pub fn fit(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Result<Fit, FitError> {
    fit_with(setup, observations, estimator, Variance::Residual)
}

/// As [`fit`], with the variance of the readings from elsewhere.
///
/// # Errors
/// [`FitError`]
pub fn fit_with(
    setup: &Setup,
    observations: &[Observation],
    estimator: Estimator,
    variance: Variance,
) -> Result<Fit, FitError> {
    let sees_function = |o: &Observation| {
        setup.derivation.runs[o.run].regressors.iter().any(|(b, _)| setup.derivation.base[*b].estimates.is_some())
    };
    let all: Vec<usize> = (0..observations.len()).collect();
    let plan: Vec<Vec<usize>> = match estimator {
        Estimator::Joint => vec![all],
        Estimator::TwoStep => {
            let (second, first): (Vec<_>, Vec<_>) = all.into_iter().partition(|&i| sees_function(&observations[i]));
            if first.is_empty() {
                return Err(FitError::NoFirstStep);
            }
            vec![first, second]
        }
    };
    let base_count = setup.derivation.base.len();
    let mut values = DVector::zeros(base_count);
    let mut covariance = DMatrix::zeros(base_count, base_count);
    let at = |row: BaseId, column: BaseId| (usize::from(row), usize::from(column));
    let mut steps: Vec<Step> = Vec::new();
    let mut separation = Separation { condition: 1.0, weakest: Vec::new() };
    let mut degrees_of_freedom = 0;
    for members in plan.into_iter().filter(|m| !m.is_empty()) {
        let known: Vec<BaseId> = steps.iter().flat_map(|s| s.columns.iter().copied()).collect();
        let (step, solved) = solve(setup, observations, members, &known, &values)?;
        degrees_of_freedom = solved.samples.saturating_sub(step.columns.len() as u32);
        let variance = match variance {
            Variance::Residual => solved.rss / f64::from(degrees_of_freedom),
            Variance::Known(std) => std * std,
        };
        let given =
            DMatrix::from_fn(step.given.len(), step.given.len(), |i, j| covariance[at(step.given[i], step.given[j])]);
        let cross = &step.gain * &given;
        let own = &step.inverse * variance + &cross * step.gain.transpose();
        for (i, &b) in step.columns.iter().enumerate() {
            values[usize::from(b)] = solved.coefficients[i];
            for (j, &c) in step.columns.iter().enumerate() {
                covariance[at(b, c)] = own[(i, j)];
            }
            for (j, &c) in step.given.iter().enumerate() {
                covariance[at(b, c)] = cross[(i, j)];
                covariance[at(c, b)] = cross[(i, j)];
            }
        }
        let (condition, weakest) = solved.condition;
        if condition > separation.condition {
            separation = Separation { condition, weakest: weakest.iter().map(|&i| step.columns[i]).collect() };
        }
        steps.push(step);
    }
    let mut base: Vec<BaseId> = steps.iter().flat_map(|s| s.columns.iter().copied()).collect();
    base.sort_unstable();
    let rms = observations.iter().map(|o| rms(setup, o, &values)).collect();
    Ok(Fit {
        estimator,
        values: DVector::from_iterator(base.len(), base.iter().map(|&b| values[usize::from(b)])),
        covariance: DMatrix::from_fn(base.len(), base.len(), |i, j| covariance[at(base[i], base[j])]),
        base,
        degrees_of_freedom,
        rms,
        separation,
        steps,
    })
}

fn solve(
    setup: &Setup,
    observations: &[Observation],
    members: Vec<usize>,
    known: &[BaseId],
    values: &DVector<f64>,
) -> Result<(Step, Solved), FitError> {
    let seen = |b: &BaseId| {
        members.iter().any(|&m| setup.derivation.runs[observations[m].run].regressors.iter().any(|(c, _)| c == b))
    };
    let (given, columns): (Vec<BaseId>, Vec<BaseId>) =
        setup.derivation.base.keys().filter(seen).partition(|b| known.contains(b));
    let too_many = FitError::TooManyCoefficients(columns.len());
    let mut factor = least_squares::factor(columns.len()).ok_or_else(|| too_many.clone())?;
    // One further factor per given column: its regression on the unknown columns is the gain.
    let mut gains =
        given.iter().map(|_| least_squares::factor(columns.len())).collect::<Option<Vec<_>>>().ok_or(too_many)?;
    let mut row = vec![0.0; columns.len()];
    for &m in &members {
        let observation = &observations[m];
        let place = |list: &[BaseId]| -> Vec<Option<usize>> {
            let regressors = setup.derivation.runs[observation.run].regressors.iter();
            regressors.map(|(b, _)| list.iter().position(|c| c == b)).collect()
        };
        let (own, fixed) = (place(&columns), place(&given));
        let mut evaluator = setup.row(observation.run);
        for sample in &observation.samples {
            let (regressors, factors) = evaluator.at(sample.sweep);
            row.fill(0.0);
            let mut y = sample.reading - factors.iter().zip(&sample.known).map(|(f, k)| f * k).sum::<f64>();
            for ((&x, at), k) in regressors.iter().zip(&own).zip(&fixed) {
                if let Some(at) = at {
                    row[*at] = x;
                }
                if let Some(k) = k {
                    y -= x * values[usize::from(given[*k])];
                }
            }
            factor.push(&row, y, observation.weight).map_err(|_| FitError::NotFinite)?;
            for (&x, k) in regressors.iter().zip(&fixed) {
                if let Some(k) = k {
                    gains[*k].push(&row, -x, observation.weight).map_err(|_| FitError::NotFinite)?;
                }
            }
        }
    }
    let runs = || members.iter().map(|&m| observations[m].run).collect::<Vec<_>>();
    let named = |e: Unsolved| match e {
        Unsolved::TooFew { samples, needed } => {
            FitError::TooFewSamples { runs: runs(), samples: samples as usize, needed }
        }
        Unsolved::Confounded { columns: c, .. } => {
            FitError::Confounded { runs: runs(), base: c.iter().map(|&i| columns[i]).collect() }
        }
        Unsolved::NotFinite => FitError::NotFinite,
    };
    let solved = factor.solve().map_err(named)?;
    let mut gain = DMatrix::zeros(columns.len(), given.len());
    for (k, factor) in gains.iter().enumerate() {
        gain.set_column(k, &factor.solve().map_err(named)?.coefficients);
    }
    let step = Step { observations: members.clone(), inverse: solved.inverse.clone(), columns, given, gain };
    Ok((step, solved))
}

fn rms(setup: &Setup, observation: &Observation, values: &DVector<f64>) -> f64 {
    let regressors = &setup.derivation.runs[observation.run].regressors;
    let mut evaluator = setup.row(observation.run);
    let square = |sample: &Sample| {
        let (row, factors) = evaluator.at(sample.sweep);
        let known: f64 = factors.iter().zip(&sample.known).map(|(f, k)| f * k).sum();
        let model: f64 = row.iter().zip(regressors).map(|(x, (b, _))| x * values[usize::from(*b)]).sum();
        (sample.reading - known - model).powi(2)
    };
    let sum: f64 = observation.samples.iter().map(square).sum();
    (sum / observation.samples.len().max(1) as f64).sqrt()
}

impl Fit {
    /// Value and standard deviation of an estimated function at a coordinate of its axis (mm or rad).
    pub fn function(&self, setup: &Setup, function: FunctionId, x: f64) -> (f64, f64) {
        let g = self.functional(setup, function, x);
        (g.dot(&self.values), (&self.covariance * &g).dot(&g).max(0.0).sqrt())
    }

    /// How the value of a function at `x` depends on each reading.
    pub fn sensitivity(&self, setup: &Setup, observations: &[Observation], function: FunctionId, x: f64) -> Weights {
        self.backwards(
            setup,
            observations,
            self.expand(&self.functional(setup, function, x), setup.derivation.base.len()),
        )
    }

    /// How a base parameter depends on each reading.
    pub fn coefficient_sensitivity(&self, setup: &Setup, observations: &[Observation], base: BaseId) -> Weights {
        let mut one = DVector::zeros(setup.derivation.base.len());
        one[usize::from(base)] = 1.0;
        self.backwards(setup, observations, one)
    }

    fn backwards(&self, setup: &Setup, observations: &[Observation], mut weight: DVector<f64>) -> Weights {
        // Backwards through the steps: what a later step makes of its given columns counts for the step before.
        let mut of = vec![Vec::new(); observations.len()];
        for step in self.steps.iter().rev() {
            let own = DVector::from_iterator(step.columns.len(), step.columns.iter().map(|&b| weight[usize::from(b)]));
            for (k, &b) in step.given.iter().enumerate() {
                weight[usize::from(b)] += step.gain.column(k).dot(&own);
            }
            let u = &step.inverse * own;
            for &o in &step.observations {
                let observation = &observations[o];
                let regressors = &setup.derivation.runs[observation.run].regressors;
                let place: Vec<Option<usize>> =
                    regressors.iter().map(|(b, _)| step.columns.iter().position(|c| c == b)).collect();
                let mut evaluator = setup.row(observation.run);
                let one = |s: &Sample| {
                    let (row, _) = evaluator.at(s.sweep);
                    row.iter().zip(&place).filter_map(|(x, p)| Some(x * u[(*p)?])).sum::<f64>() * observation.weight
                };
                of[o] = observation.samples.iter().map(one).collect();
            }
        }
        Weights(of)
    }

    fn functional(&self, setup: &Setup, function: FunctionId, x: f64) -> DVector<f64> {
        let mut g = DVector::zeros(self.base.len());
        for (b, value) in setup.basis(function, x) {
            if let Ok(at) = self.base.binary_search(&b) {
                g[at] = value;
            }
        }
        g
    }

    fn expand(&self, g: &DVector<f64>, size: usize) -> DVector<f64> {
        let mut all = DVector::zeros(size);
        for (&b, v) in self.base.iter().zip(g.iter()) {
            all[usize::from(b)] = *v;
        }
        all
    }
}
