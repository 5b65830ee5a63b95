//! The largest error of an estimated function over many drawn machines, and where it comes from.

use super::draw::draw;
use super::estimate::{EstimateError, fit};
use super::fit::{Estimator, Observation};
use super::limits::ErrorLimits;
use super::setup::Setup;
use super::told::Told;
use super::visited::{between, visited};
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use typed_index_collections::TiVec;

/// What is drawn, and how often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draws {
    /// Number of machines.
    pub trials: u64,
    /// Samples of each run.
    pub samples: usize,
    /// First and last sweep, rad.
    pub range: (f64, f64),
    /// Bounds of the errors.
    pub limits: ErrorLimits,
    /// Half width of the uniform noise, mm.
    pub noise: f64,
    /// SimulatedMachine n is drawn from stream n of this seed, whatever thread does it.
    pub seed: u64,
}

/// Largest error of the function over the range on one machine, in its own unit (mm or rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// From noise alone: any linear model must give the same.
    pub noise: f64,
    /// From linearisation alone.
    pub linearisation: f64,
    /// From both.
    pub both: f64,
}

/// Distribution of one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// 95 % are smaller.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Distribution of `values`; `None` for no values.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let quantile = |p: f64| {
            let at = p * (values.len() - 1) as f64;
            let (low, high) = (values[at.floor() as usize], values[at.ceil() as usize]);
            low + (high - low) * at.fract()
        };
        let max = *values.last()?;
        Some(Self {
            mean: values.iter().sum::<f64>() / values.len() as f64,
            median: quantile(0.5),
            p95: quantile(0.95),
            max,
        })
    }
}

/// Factors of a run's known functions at each of its samples.
struct KnownFactors(Vec<Vec<f64>>);

impl KnownFactors {
    fn new(setup: &Setup, run: RunId, sweeps: &[f64]) -> Self {
        let mut row = setup.row(run);
        Self(sweeps.iter().map(|&sweep| row.at(sweep, 1.0).1.to_vec()).collect())
    }

    /// Takes the known functions' part from the readings.
    fn subtract(&self, readings: &mut [f64], known: &[Vec<f64>]) {
        for ((reading, known), factors) in readings.iter_mut().zip(known).zip(&self.0) {
            *reading -= factors.iter().zip(known).map(|(f, k)| f * k).sum::<f64>();
        }
    }
}

/// Steps between the points at which a function's error is looked at.
const POINTS: usize = 1440;

/// Draws machines, simulates all runs exactly and estimates one function, or the sum it is seen in; without trials where it is
/// not seen; `done` is called after every machine.
///
/// # Errors
/// [`EstimateError`] if these runs over this range do not determine the function.
pub fn monte_carlo(
    setup: &Setup,
    draws: Draws,
    estimator: Estimator,
    function: FunctionId,
    done: &(dyn Fn() + Sync),
) -> Result<(Told, Vec<Trial>), EstimateError> {
    let runs = || setup.model.runs.keys();
    let sweeps: TiVec<RunId, Vec<f64>> = runs().map(|run| setup.swept(run, draws.samples, draws.range)).collect();
    let exact: TiVec<RunId, ExactReading> = runs().map(|run| setup.exact(run, &sweeps[run])).collect();
    // The estimate is linear in the readings: its matrix is worked out once, on readings of zero.
    let observations: Vec<Observation> = runs().map(|run| Observation::zero(setup, run, &sweeps[run])).collect();
    let estimate = fit(setup, &observations, estimator)?;
    let Some(seen) = estimate.seen(function) else {
        return Err(EstimateError::NotEstimated(setup.function_name(function)));
    };
    let told = seen.told(setup);
    if told.extent == Extent::NotSeen {
        return Ok((told, Vec::new()));
    }
    let operator = estimate.coefficient_sensitivities(setup, &observations, seen);
    let range = visited(setup, function, runs().map(|run| (run, &sweeps[run])));
    let points: Vec<(f64, Vec<f64>)> =
        range.into_iter().flat_map(|range| between(range, POINTS)).map(|x| (x, seen.basis(setup, x))).collect();
    let factors: TiVec<RunId, KnownFactors> = runs().map(|run| KnownFactors::new(setup, run, &sweeps[run])).collect();
    let error = setup.model.functions[function].error;

    let trial = |n: u64| {
        let mut random = ChaCha8Rng::seed_from_u64(draws.seed);
        random.set_stream(n);
        let machine = draw(setup, &exact.raw, draws.limits, &mut random);
        let apply = |readings: &[Vec<f64>]| -> Vec<f64> { operator.iter().map(|w| w.apply(readings)).collect() };
        let clean: Vec<Vec<f64>> = runs()
            .map(|run| {
                let mut y: Vec<f64> = exact[run].values(&machine).collect();
                factors[run].subtract(&mut y, &setup.true_known(run, &exact[run], &machine));
                y
            })
            .collect();
        let width = draws.noise;
        let noise: Vec<Vec<f64>> =
            runs().map(|run| sweeps[run].iter().map(|_| random.random_range(-1.0..=1.0) * width).collect()).collect();
        // What is seen only together with other errors is compared with what is seen: the sum.
        let base = (seen.extent() == Extent::UpTo).then(|| machine.base(setup));
        let (systematic, random_part) = (apply(&clean), apply(&noise));
        let mut worst = Trial { noise: 0.0, linearisation: 0.0, both: 0.0 };
        for (x, basis) in &points {
            let value = |c: &[f64]| basis.iter().zip(c).map(|(b, c)| b * c).sum::<f64>();
            let truth = base.as_ref().map_or_else(|| machine.value(error, *x), |base| seen.truth(setup, base, *x));
            let (s, r) = (value(&systematic) - truth, value(&random_part));
            worst.noise = worst.noise.max(r.abs());
            worst.linearisation = worst.linearisation.max(s.abs());
            worst.both = worst.both.max((s + r).abs());
        }
        done();
        worst
    };
    Ok((told, (0..draws.trials).into_par_iter().map(trial).collect()))
}
