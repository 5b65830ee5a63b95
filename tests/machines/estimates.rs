//! Both estimates and their covariance, held to dense least squares.

use super::space::Space;
use super::told::{coefficients, definitions};
use super::{Case, together};
use nalgebra::{DMatrix, DVector, RowDVector};
use rand::{Rng, RngExt};
use trunnion::study::{EstimateError, Estimator, Fit, LARGEST, Observation, Sample, Variance, fit_with};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::{BaseId, RunId};

/// Half width of the noise, mm.
const NOISE: f64 = 1e-3;
/// What rounding in a row, of factors that cancel, may do to an estimate: times the condition.
const DIGITS: f64 = 1e-9;

/// Estimates of all parameters per weighted reading of the first step's runs and of the second's; a joint one has no second.
struct Solved {
    inverse: [DMatrix<f64>; 2],
    readings: [DVector<f64>; 2],
    /// Of a weighted reading, from the residuals of its step.
    variance: [f64; 2],
    condition: f64,
}

impl Solved {
    /// Least squares of the first rows; then of the second, where what the first determine is given.
    fn new(case: &Case, [first, second]: [DMatrix<f64>; 2], readings: [DVector<f64>; 2]) -> Self {
        let one = Space::new(&first, &case.within);
        let two = Space::new(&second, &one.null);
        let given = DMatrix::identity(case.within.nrows(), case.within.nrows()) - &two.inverse * &second;
        let inverse = [given * &one.inverse, two.inverse];
        let estimate = &inverse[0] * &readings[0] + &inverse[1] * &readings[1];
        let variance = |rows: &DMatrix<f64>, readings: &DVector<f64>, rank: usize| {
            (rows * &estimate - readings).norm_squared() / rows.nrows().saturating_sub(rank).max(1) as f64
        };
        let variance = [variance(&first, &readings[0], one.rank), variance(&second, &readings[1], two.rank)];
        Self { inverse, readings, variance, condition: one.condition.max(two.condition) }
    }

    /// Estimates of linear functions of the parameters, one a row of `of`.
    fn values(&self, of: &DMatrix<f64>) -> DVector<f64> {
        of * (&self.inverse[0] * &self.readings[0] + &self.inverse[1] * &self.readings[1])
    }

    /// Their covariance.
    fn covariance(&self, of: &DMatrix<f64>, known: Variance) -> DMatrix<f64> {
        let step = |i: usize| {
            let variance = if let Variance::Known(std) = known { std * std } else { self.variance[i] };
            let by = of * &self.inverse[i];
            &by * by.transpose() * variance
        };
        step(0) + step(1)
    }

    /// Both, held to what was fitted.
    fn hold(&self, of: &DMatrix<f64>, variance: Variance, values: &DVector<f64>, covariance: &DMatrix<f64>) {
        let unit = self.covariance(of, Variance::Known(1.0)).diagonal().map(f64::sqrt);
        let size = self.readings.iter().map(DVector::norm).fold(0.0, f64::max);
        let off = (self.values(of) - values).component_div(&unit).amax();
        assert!(off <= DIGITS * self.condition * size, "values: {off:e} of {size:e}, condition {}", self.condition);
        let expected = self.covariance(of, variance);
        let scale =
            if let Variance::Known(std) = variance { std * std } else { self.variance[0].max(self.variance[1]) };
        let off = DMatrix::from_fn(of.nrows(), of.nrows(), |i, j| {
            (expected[(i, j)] - covariance[(i, j)]).abs() / (unit[i] * unit[j])
        });
        let floor = (DIGITS * size * self.condition).powi(2);
        let bound = DIGITS * self.condition * scale + floor;
        assert!(off.amax() <= bound, "covariance: {:e} of {scale:e}, condition {}", off.amax(), self.condition);
    }
}

pub fn check(case: &Case, random: &mut impl Rng) {
    let parameters = &case.within * DVector::from_fn(case.within.ncols(), |_, _| random.random_range(-1.0..1.0));
    for (noise, variance) in [(0.0, Variance::Known(0.7)), (NOISE, Variance::Residual)] {
        let observations = observations(case, &parameters, noise, random);
        for estimator in [Estimator::Joint, Estimator::TwoStep] {
            match fit_with(&case.setup, &observations, estimator, variance) {
                Ok(fit) => compare(case, &observations, &fit, variance),
                Err(error) => refused(case, estimator, &error),
            }
        }
    }
}

/// The fit is that of the reference: of the base parameters, and of every function that is seen.
fn compare(case: &Case, observations: &[Observation], fit: &Fit, variance: Variance) {
    let steps = match fit.estimator {
        Estimator::Joint => vec![0; observations.len()],
        Estimator::TwoStep => (0..observations.len()).map(|n| usize::from(sees_function(case, n))).collect(),
    };
    let base = solved(case, observations, &case.folded, &steps);
    base.hold(&definitions(case), variance, &fit.values, &fit.covariance);
    // What is left out of a run is made up for by set-ups and locations: functions are as if it were not.
    let whole = (fit.estimator == Estimator::Joint && case.whole != case.folded)
        .then(|| solved(case, observations, &case.whole, &steps));
    for seen in fit.functions() {
        let names = coefficients(case, seen.function());
        for x in [-1.3, 0.4, 5.1] {
            let mut sum = RowDVector::zeros(case.reference.width());
            for (term, value) in seen.determination.seen.iter().zip(seen.basis(&case.setup, x)) {
                sum += case.reference.unit(&names[usize::from(term.term)]) * value;
            }
            seen.others(&case.setup, x).iter().for_each(|(j, f)| sum += case.reference.unit(case.name(*j)) * *f);
            let (value, std) = fit.function(&case.setup, seen.function(), x);
            let by = whole.as_ref().filter(|_| seen.extent() == Extent::Determined).unwrap_or(&base);
            let sum = DMatrix::from_rows(&[sum]);
            if (&sum * &case.within).amax() > 0.0 {
                by.hold(&sum, variance, &DVector::from_element(1, value), &DMatrix::from_element(1, 1, std * std));
            }
        }
    }
}

fn solved(case: &Case, observations: &[Observation], runs: &[DMatrix<f64>], steps: &[usize]) -> Solved {
    let of = |step: usize| {
        let own = || observations.iter().enumerate().filter(move |(n, _)| steps[*n] == step);
        let rows: Vec<DMatrix<f64>> = own().map(|(n, o)| &runs[n] * o.weight.sqrt()).collect();
        let readings = own().flat_map(|(n, o)| less_known(case, n, o).into_iter().map(|r| r * o.weight.sqrt()));
        let readings: Vec<f64> = readings.collect();
        (together(&rows, case.reference.width()), DVector::from_vec(readings))
    };
    let ((first, of_first), (second, of_second)) = (of(0), of(1));
    Solved::new(case, [first, second], [of_first, of_second])
}

/// Readings less the share of known functions.
fn less_known(case: &Case, n: usize, observation: &Observation) -> Vec<f64> {
    let listed = &case.setup.derivation.runs[RunId::from(n)].known;
    let less = |(i, sample): (usize, &Sample)| {
        let factor = |function| case.known[n][i].known[&case.setup.function_name(function)];
        let share: f64 = listed.iter().zip(&sample.known).map(|((f, _), value)| factor(*f) * value).sum();
        sample.reading - share
    };
    observation.samples.iter().enumerate().map(less).collect()
}

/// Whether a run sees what is to be found.
fn sees_function(case: &Case, n: usize) -> bool {
    let derivation = &case.setup.derivation;
    let sees = derivation.runs[RunId::from(n)].regressors.iter().any(|(b, _)| derivation.base[*b].estimates.is_some());
    if case.reference.machine.assumed.is_empty() {
        let axes = case.reference.machine.axes();
        let mut estimated = axes.flat_map(|a| (0..6).filter(|c| a.estimated[*c]).flat_map(|c| a.coefficients(c)));
        let own = |name: String| case.folded[n].column(case.reference.place(&name)).amax() > 0.0;
        assert_eq!(sees, estimated.any(own), "run {n} is of the second step");
    }
    sees
}

/// There is no fit only where the reference has none either.
fn refused(case: &Case, estimator: Estimator, error: &EstimateError) {
    let runs = 0..case.folded.len();
    let first: Vec<usize> = runs.filter(|n| estimator == Estimator::Joint || !sees_function(case, *n)).collect();
    match error {
        EstimateError::TooManyCoefficients(_) => assert!(case.space.rank > LARGEST),
        EstimateError::NoFirstStep => assert!(estimator == Estimator::TwoStep && first.is_empty()),
        EstimateError::Confounded { .. } => {
            let derived = &case.setup.derivation.runs;
            let mut seen: Vec<BaseId> =
                first.iter().flat_map(|n| derived[RunId::from(*n)].regressors.iter().map(|(b, _)| *b)).collect();
            seen.sort_unstable();
            seen.dedup();
            let rows: Vec<DMatrix<f64>> = first.iter().map(|n| case.folded[*n].clone()).collect();
            let rank = Space::new(&together(&rows, case.reference.width()), &case.within).rank;
            assert!(rank < seen.len(), "{error}");
        }
        _ => panic!("{error}"),
    }
}

fn observations(case: &Case, parameters: &DVector<f64>, noise: f64, random: &mut impl Rng) -> Vec<Observation> {
    let derived = &case.setup.derivation.runs;
    let runs = case.sweeps.iter().enumerate().map(|(n, sweeps)| {
        let run = RunId::from(n);
        let sample = |(i, sweep): (usize, &f64)| {
            let mut sample =
                Sample { sweep: *sweep, direction: 1.0, reading: 0.0, known: Vec::new(), known_std: Vec::new() };
            sample.reading = (case.folded[n].row(i) * parameters)[0] + noise * random.random_range(-1.0..1.0);
            for (function, _) in &derived[run].known {
                let value = random.random_range(-1e-3..1e-3);
                sample.reading += case.known[n][i].known[&case.setup.function_name(*function)] * value;
                sample.known.push(value);
            }
            sample
        };
        Observation { run, weight: [1.0, 0.25, 4.0][n % 3], samples: sweeps.iter().enumerate().map(sample).collect() }
    });
    runs.collect()
}
