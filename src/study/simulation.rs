//! A drawn machine and its noisy readings.

use super::draw::{Population, SimulatedMachine};
use super::fit::{Observation, Sample};
use super::limits::ErrorLimits;
use super::monte_carlo::Draws;
use super::setup::Setup;
use super::simulate::{grid, step};
use super::visited::in_unit;
use chacha20::ChaCha8Rng;
use core::convert::Infallible;
use rand::{RngExt, SeedableRng};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::quantity::Unit;
use typed_index_collections::TiVec;

/// Samples that stand for all of a run where a smooth function of the sweep is looked at.
const FEW: usize = 20_000;
/// Samples that are worked out together.
const BLOCK: usize = 1 << 14;

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

/// A machine that is drawn and can be measured, a sample at a time.
pub struct DrawnMachine<'a> {
    setup: &'a Setup,
    /// As what it was drawn.
    pub simulation: Simulation,
    /// The machine.
    pub machine: SimulatedMachine,
    /// Where in the random numbers the first reading's noise is.
    noise: u128,
}

impl Simulation {
    /// First angle and end, rad.
    pub fn range(&self) -> (f64, f64) {
        (self.range_deg.0.to_radians(), self.range_deg.1.to_radians())
    }

    /// The same with so few samples that they are kept: enough for what is smooth.
    fn few(&self) -> Self {
        Self { samples: self.samples.min(FEW), ..*self }
    }

    /// How many samples a run has.
    fn length(&self, setup: &Setup, run: RunId) -> usize {
        self.samples * if setup.goes_back(run) { 2 } else { 1 }
    }

    /// A run's sweep at each sample, rad: over the range, as far as its axes go.
    fn sweeps(&self, setup: &Setup, run: RunId) -> impl Iterator<Item = f64> + Clone + use<> {
        let (first, end) = setup.sweep_range(run, self.range());
        // In degrees, so that whole ones stay whole.
        let degrees = |rad: f64| in_unit(Unit::Deg, rad);
        let whole = (first, end) == self.range();
        let range = if whole { self.range_deg } else { (degrees(first), degrees(end)) };
        let (samples, length) = (self.samples, self.length(setup, run));
        let there = move |at: usize| if at < samples { at } else { length - 1 - at };
        (0..length).map(move |at| step(there(at), samples, range).to_radians())
    }

    /// A run's sweep at as many samples as are kept and at the end, rad: a whole turn visits its end, too.
    pub fn visited(&self, setup: &Setup, run: RunId) -> Vec<f64> {
        let (first, end) = setup.sweep_range(run, self.range());
        grid(self.few().samples, (first, end)).into_iter().chain([end]).collect()
    }

    /// Values of a run's sweep at which its known functions are tabulated, rad: at each sample where they are kept.
    pub fn tabulated(&self, setup: &Setup, run: RunId) -> Vec<f64> {
        let last = self.sweeps(setup, run).take(self.samples).last();
        self.few().sweeps(setup, run).chain(last).collect()
    }

    /// Many machines drawn in the same way.
    pub fn draws(&self, trials: u64) -> Draws {
        let noise = self.noise_um * Unit::Um.factor();
        let &Self { seed, samples, limits, .. } = self;
        Draws { trials, samples, range: self.range(), limits, noise, seed }
    }

    /// Draws a machine.
    pub fn draw<'a>(&self, setup: &'a Setup) -> DrawnMachine<'a> {
        let few = self.few();
        let along = |run| setup.exact(run, &few.sweeps(setup, run).collect::<Vec<f64>>());
        let exact: Vec<ExactReading> = setup.model.runs.keys().map(along).collect();
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let machine = Population::new(setup, &exact, self.limits).draw(&mut random);
        DrawnMachine { setup, simulation: *self, machine, noise: random.get_word_pos() }
    }

    /// Draws a machine and measures it.
    pub fn measure(&self, setup: &Setup) -> Simulated {
        let drawn = self.draw(setup);
        let observations = drawn.observations();
        Simulated { machine: drawn.machine, observations }
    }
}

impl DrawnMachine<'_> {
    /// What is read along a run, a block at a time: the same whenever it is asked for.
    ///
    /// # Errors
    /// Those of `each`.
    pub fn each<E>(&self, run: RunId, mut each: impl FnMut(Sample) -> Result<(), E>) -> Result<(), E> {
        let mut random = ChaCha8Rng::seed_from_u64(self.simulation.seed);
        random.set_word_pos(self.noise);
        let amplitude = self.simulation.noise_um * Unit::Um.factor();
        let mut noise = || random.random_range(-1.0..=1.0) * amplitude;
        // The runs before it have the numbers before its own.
        let before = self.setup.model.runs.keys().take_while(|other| *other != run);
        for _ in 0..before.map(|run| self.simulation.length(self.setup, run)).sum() {
            noise();
        }
        let mut sweeps = self.simulation.sweeps(self.setup, run);
        loop {
            let block: Vec<f64> = sweeps.by_ref().take(BLOCK).collect();
            if block.is_empty() {
                return Ok(());
            }
            let exact = self.setup.exact(run, &block);
            let observed = self.setup.observe(run, &exact, &block, &self.machine, &mut noise);
            observed.samples.into_iter().try_for_each(&mut each)?;
        }
    }

    /// All runs, their samples kept.
    pub fn observations(&self) -> TiVec<RunId, Observation> {
        let observe = |run| {
            let mut samples = Vec::with_capacity(self.simulation.length(self.setup, run));
            let Ok(()) = self.each(run, |sample| {
                samples.push(sample);
                Ok::<(), Infallible>(())
            });
            Observation { run, weight: 1.0, samples }
        };
        self.setup.model.runs.keys().map(observe).collect()
    }
}
