//! A drawn machine and its noisy readings.

use super::draw::{Population, SimulatedMachine};
use super::fit::Observation;
use super::limits::ErrorLimits;
use super::monte_carlo::Draws;
use super::setup::Setup;
use super::simulate::grid;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::quantity::Unit;
use typed_index_collections::TiVec;

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simulation {
    /// Seed of the random numbers: the same seed gives the same machine and readings.
    pub seed: u64,
    /// Samples of each run; of each direction where it has terms that turn with it.
    pub samples: usize,
    /// Half width of the uniform noise of the readings, µm.
    pub noise_um: f64,
    /// Bounds of the errors.
    pub limits: ErrorLimits,
    /// First angle and end of the range, degrees; the last sample is one step before the end. A run of which an axis would
    /// leave its range is swept as far as it goes.
    pub range_deg: (f64, f64),
}

/// A machine and what was read on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated {
    /// The machine.
    pub machine: SimulatedMachine,
    /// Every run of the model.
    pub observations: TiVec<RunId, Observation>,
}

impl Simulation {
    /// First angle and end, rad.
    pub fn range(&self) -> (f64, f64) {
        (self.range_deg.0.to_radians(), self.range_deg.1.to_radians())
    }

    /// A run's sweep at every sample, rad: over the range, as far as its axes go.
    pub fn sweeps(&self, setup: &Setup, run: RunId) -> Vec<f64> {
        let (first, end) = setup.sweep_range(run, self.range());
        // In degrees, so that whole ones stay whole.
        let degrees = |rad: f64| (rad.to_degrees() * 1e9).round() / 1e9;
        let whole = (first, end) == self.range();
        let range = if whole { self.range_deg } else { (degrees(first), degrees(end)) };
        setup.both_ways(run, grid(self.samples, range).into_iter().map(f64::to_radians).collect())
    }

    /// A run's sweep at every sample and at the end, rad: a whole turn visits its end, too.
    pub fn visited(&self, setup: &Setup, run: RunId) -> Vec<f64> {
        let (first, end) = setup.sweep_range(run, self.range());
        grid(self.samples, (first, end)).into_iter().chain([end]).collect()
    }

    /// Many machines drawn in the same way.
    pub fn draws(&self, trials: u64) -> Draws {
        let noise = self.noise_um * Unit::Um.factor();
        let &Self { seed, samples, limits, .. } = self;
        Draws { trials, samples, range: self.range(), limits, noise, seed }
    }

    /// Draws a machine and measures it.
    pub fn measure(&self, setup: &Setup) -> Simulated {
        let sweeps: TiVec<RunId, Vec<f64>> = setup.model.runs.keys().map(|run| self.sweeps(setup, run)).collect();
        let exact: TiVec<RunId, ExactReading> =
            sweeps.iter_enumerated().map(|(run, sweeps)| setup.exact(run, sweeps)).collect();
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let machine = Population::new(setup, &exact, self.limits).draw(&mut random);
        let mut noise = || random.random_range(-1.0..=1.0) * self.noise_um * Unit::Um.factor();
        let observe = |(run, exact)| setup.observe(run, exact, &sweeps[run], &machine, &mut noise);
        let observations = exact.iter_enumerated().map(observe).collect();
        Simulated { machine, observations }
    }
}
