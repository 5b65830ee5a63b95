//! The budget checked as in Supplement 1 of the GUM (JCGM 101): the whole measurement many times over, every line drawn.
//!
//! Each time a machine within the limits is drawn and measured exactly, with noise, the instrument's errors, the bar's and the
//! set-up's lengths wrong by what is drawn for them. The middle 95 % of what the estimate is off by is set beside the budget's interval:
//! of the sum that the runs see, and of the function itself. Of a function that is not determined the second is a bound:
//! there the budget takes each error as large as its limit lets it be, in the worst shape.

use super::budget::{Instrument, Sources, covering};
use super::draw::Population;
use super::estimate::{EstimateError, fit_with};
use super::fit::{Estimator, Observation, Variance};
use super::monte_carlo::Draws;
use super::operator::Operator;
use super::seen::Seen;
use super::setup::{Setup, coordinate};
use super::slow::{SLOW, slow};
use super::told::Told;
use super::track::Tracks;
use super::visited::{between, in_unit, visited};
use chacha20::ChaCha8Rng;
use rand::{Rng, RngExt, SeedableRng};
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;
use typed_index_collections::TiVec;

/// Coordinates at which a function is looked at, ends included.
const STEPS: usize = 8;

/// A budget's interval beside that of the drawn measurements, at one coordinate, in the function's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// Name of the function.
    pub function: String,
    /// How far it is determined.
    pub told: Told,
    /// µrad or µm.
    pub unit: Unit,
    /// The coordinate, degrees or mm.
    pub at: f64,
    /// Half the interval of the sum that is seen: the budget's, the measurements'.
    pub sum: [f64; 2],
    /// Half the interval of the function.
    pub whole: [f64; 2],
}

/// A function at a coordinate, before anything is drawn.
struct Point<'a> {
    seen: &'a Seen,
    error: ErrorId,
    at: f64,
    basis: Vec<f64>,
}

/// Where a reading is taken, as the instrument's errors depend on it.
struct Place {
    /// A slow error's functions.
    waves: [f64; SLOW],
    /// The bar's nominal length, mm.
    bar: Option<f64>,
}

/// Compares the budget of every estimated function with `draws` of the whole measurement.
///
/// # Errors
/// [`EstimateError`] if these runs over this range give no estimate.
pub fn supplement(
    setup: &Setup,
    draws: Draws,
    estimator: Estimator,
    instrument: &Instrument,
) -> Result<Vec<Checked>, EstimateError> {
    let runs = || setup.model.runs.keys();
    let sweeps: TiVec<RunId, Vec<f64>> = runs().map(|run| setup.swept(run, draws.samples, draws.range)).collect();
    let tracks = Tracks::new(setup, &sweeps);
    let machines = Population::new(setup, tracks.exact(), draws.limits);
    // One measurement stands for all in what is proportional to the readings.
    let machine = machines.draw(&mut ChaCha8Rng::seed_from_u64(draws.seed));
    let observe = |(run, exact)| setup.observe(run, exact, &sweeps[run], &machine, || 0.0);
    let observations: Vec<Observation> = runs().zip(tracks.exact()).map(observe).collect();
    let fitted = fit_with(setup, &observations, estimator, Variance::Known(draws.noise / 3f64.sqrt()))?;
    let sources = Sources::new(setup, &observations, &fitted, draws.limits, instrument, false);
    let (mut points, mut weights, mut checked) = (Vec::new(), Vec::new(), Vec::new());
    for seen in fitted.functions().iter().filter(|seen| seen.extent() != Extent::NotSeen) {
        let function = seen.function();
        let (told, unit) = (seen.told(setup), setup.quantity(function).deviation());
        let of = setup.axis(function).map_or(Unit::Mm, |axis| coordinate(axis).coordinate());
        let range = visited(setup, function, runs().map(|run| (run, &sweeps[run])));
        for at in range.into_iter().flat_map(|range| between(range, STEPS)) {
            let budget = sources.function(seen, at).times(unit.from_inner(1.0));
            checked.push(Checked {
                function: setup.function_name(function),
                told: told.clone(),
                unit,
                at: in_unit(of, at),
                sum: [budget.of_the_sum().combined.expanded, 0.0],
                whole: [budget.combined.expanded, 0.0],
            });
            let error = setup.model.functions[function].error;
            points.push(Point { seen, error, at, basis: seen.basis(setup, at) });
            weights.push(sources.dependence().weights(&fitted.functional(setup, function, at)));
        }
    }
    let operator = Operator::new(tracks.samples(), weights);
    let place = |run: RunId, sweep: f64| {
        let mut waves = [0.0; SLOW];
        slow(sweep, &mut waves);
        Place { waves, bar: setup.bar(run) }
    };
    let places: Vec<Place> =
        sweeps.iter_enumerated().flat_map(|(run, sweeps)| sweeps.iter().map(move |s| place(run, *s))).collect();
    let trial = |[readings, estimates]: &mut [Vec<f64>; 2], (n, off): (usize, &mut [[f64; 2]])| {
        let mut random = ChaCha8Rng::seed_from_u64(draws.seed);
        random.set_stream(n as u64 + 1);
        let machine = machines.draw(&mut random);
        let common = Common::new(instrument, &mut random);
        let readings = &mut readings[..];
        tracks.read(&machine, &mut readings[..places.len()]);
        for (reading, place) in readings.iter_mut().zip(&places) {
            let noise = random.random_range(-1.0..=1.0) * draws.noise;
            *reading += noise + common.error(place, *reading);
        }
        tracks.explain(&machine, &mut readings[..places.len()]);
        operator.apply(readings, estimates);
        let parameters = machine.parameters(setup);
        for ((point, estimate), off) in points.iter().zip(estimates).zip(off) {
            let seen = point.seen.coefficients(machine.factors(point.error), &parameters);
            let sum: f64 = seen.zip(&point.basis).map(|(c, b)| c * b).sum();
            *off = [*estimate - sum, *estimate - machine.value(point.error, point.at)];
        }
    };
    let mut trials = vec![[0.0; 2]; draws.trials as usize * points.len()];
    let room = || [operator.readings(), operator.combinations()];
    trials.par_chunks_mut(points.len().max(1)).enumerate().for_each_init(room, trial);
    for (i, checked) in checked.iter_mut().enumerate() {
        let half = |which: usize| {
            let mut sizes: Vec<f64> = trials.iter().skip(i).step_by(points.len()).map(|off| off[which].abs()).collect();
            checked.unit.from_inner(covering(&mut sizes))
        };
        let (sum, whole) = (half(0), half(1));
        checked.sum[1] = sum;
        checked.whole[1] = whole;
    }
    Ok(checked)
}

/// What is the same in all runs of one measurement.
struct Common {
    /// Of the functions of a slow error, mm.
    slow: [f64; SLOW],
    proportional: f64,
    length: f64,
    expansion: f64,
}

impl Common {
    fn new(instrument: &Instrument, random: &mut impl Rng) -> Self {
        let mut bounded = |std: f64| random.random_range(-1.0..=1.0) * std * 3f64.sqrt();
        let (proportional, length) = (bounded(instrument.proportional), bounded(instrument.bar_length));
        let expansion = bounded(instrument.temperature) * instrument.expansion;
        let mut normal = || Normal::standard().inverse_cdf(random.random_range(f64::EPSILON..1.0));
        Self { slow: std::array::from_fn(|_| normal() * instrument.constant), proportional, length, expansion }
    }

    /// What the instrument adds to a reading, mm.
    fn error(&self, place: &Place, reading: f64) -> f64 {
        let constant: f64 = place.waves.iter().zip(&self.slow).map(|(w, s)| w * s).sum();
        let bar = place.bar.map_or(0.0, |bar| self.length + bar * self.expansion);
        constant + reading * self.proportional + bar
    }
}
