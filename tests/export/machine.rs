//! A simulated machine with a control that compensates: measured again, fitted again.

use crate::readers::Trim;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::cell::Cell;
use trunnion::study::{
    ErrorLimits, Estimator, Fit, Instrument, Observation, Population, Setup, SimulatedMachine, Source, fit, report,
};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Origin;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::model::AxisKind;

/// Half width of the noise, mm.
const NOISE: f64 = 1e-4;

/// A machine in one direction of its axis.
pub struct Driven<'a> {
    pub machine: &'a SimulatedMachine,
    /// The axis' motion errors.
    pub errors: [ErrorId; 6],
    /// The one that is its own position, and whether it is counted against the axis' motion.
    pub own: ErrorId,
    pub sense: f64,
    /// Errors that the model assumes there are none of.
    pub absent: &'a [ErrorId],
    /// What the axis is off in this direction, mm or rad.
    pub offset: f64,
    /// From a commanded coordinate to what is added to it, mm or rad.
    pub trim: &'a dyn Fn(f64) -> f64,
}

impl ErrorValues for Driven<'_> {
    /// The axis is sent to x + trim, and is off by the error that it has there.
    fn value(&self, error: ErrorId, x: f64) -> f64 {
        if self.absent.contains(&error) {
            return 0.0;
        }
        if !self.errors.contains(&error) {
            return self.machine.value(error, x);
        }
        let trim = (self.trim)(x);
        let there = self.machine.value(error, x + trim);
        if error == self.own { there + self.offset + self.sense * trim } else { there }
    }
}

/// A set-up with runs that are measured there and back.
pub struct Bench {
    pub setup: Setup,
    pub function: FunctionId,
    /// −1 where the axis' positive motion is against the error's direction.
    pub sense: f64,
    machine: SimulatedMachine,
    /// Forward less reverse, mm or rad.
    pub hysteresis: f64,
    absent: Vec<ErrorId>,
    sweeps: Vec<(RunId, Vec<f64>)>,
    seed: u64,
    /// How often it was measured.
    times: Cell<u64>,
}

/// What was found.
pub struct Found {
    pub observations: Vec<Observation>,
    pub fit: Fit,
    /// The largest expanded uncertainty, mm or rad.
    pub u95: f64,
}

impl Bench {
    /// A model over a range in degrees; the first of its estimated functions.
    pub fn new(setup: Setup, sense: f64, range_deg: (f64, f64), seed: u64) -> Self {
        let range = (range_deg.0.to_radians(), range_deg.1.to_radians());
        let sweeps: Vec<(RunId, Vec<f64>)> =
            setup.model.runs.keys().map(|run| (run, setup.swept(run, 181, range))).collect();
        let exact: Vec<ExactReading> = sweeps.iter().map(|(run, sweeps)| setup.exact(*run, sweeps)).collect();
        let machine = Population::new(&setup, &exact, ErrorLimits::PAPER).draw(&mut ChaCha8Rng::seed_from_u64(seed));
        let function = setup.estimated().next().unwrap();
        let error = |(origin, _): &(Origin, _)| match origin {
            Origin::Constant(error) => *error,
            Origin::Coefficient(own) => setup.model.functions[own.function].error,
        };
        let absent = setup.model.assumptions.iter().flat_map(|assumed| &assumed.terms).map(error).collect();
        Self { setup, function, sense, machine, hysteresis: 0.0, absent, sweeps, seed, times: Cell::new(0) }
    }

    pub fn error(&self) -> ErrorId {
        self.setup.model.functions[self.function].error
    }

    /// One of its coordinates in degrees or mm, in rad or mm.
    pub fn inner(&self, at: f64) -> f64 {
        if self.setup.axis(self.function).unwrap().kind == AxisKind::Rotary { at.to_radians() } else { at }
    }

    /// The other way round.
    pub fn outer(&self, x: f64) -> f64 {
        if self.setup.axis(self.function).unwrap().kind == AxisKind::Rotary { x.to_degrees() } else { x }
    }

    /// Measures every run there and back, with what a control adds times a factor, and fits.
    pub fn measured(&self, trim: Option<&Trim>, factor: f64) -> Found {
        let (axis, _) = self.setup.model.axis_of(self.error()).unwrap();
        let described = self.setup.model.axis(axis).unwrap();
        self.times.set(self.times.get() + 1);
        let mut random = ChaCha8Rng::seed_from_u64(self.seed + 1000 * self.times.get());
        let mut observations = Vec::new();
        for (run, there) in &self.sweeps {
            for back in [false, true] {
                let sweeps: Vec<f64> = if back { there.iter().rev().copied().collect() } else { there.clone() };
                let exact = self.setup.exact(*run, &sweeps);
                let mut noise = || random.random_range(-NOISE..=NOISE);
                // The known functions, and each sample's direction.
                let mut observation = self.setup.observe(*run, &exact, &sweeps, &self.machine, || 0.0);
                let moves: Vec<f64> = exact.run().coordinates(axis).flatten().collect();
                // Every reading as if the axis had gone either way; then that of the way it went.
                let read = |forward: bool| {
                    let added = |x: f64| trim.map_or(0.0, |t| self.inner(factor * t(self.outer(x), forward)));
                    let driven = Driven {
                        machine: &self.machine,
                        errors: described.motion,
                        own: self.error(),
                        sense: self.sense,
                        absent: &self.absent,
                        offset: self.sense * self.hysteresis / if forward { 2.0 } else { -2.0 },
                        trim: &added,
                    };
                    exact.values(&driven).collect::<Vec<f64>>()
                };
                let [forward, reverse] = [read(true), read(false)];
                let rests = moves.is_empty();
                for (i, sample) in observation.samples.iter_mut().enumerate() {
                    let (before, behind) = (i.saturating_sub(1), (i + 1).min(sweeps.len() - 1));
                    let goes_forward = rests || moves[behind] > moves[before];
                    sample.reading = if goes_forward { forward[i] } else { reverse[i] } + noise();
                }
                observations.push(observation);
            }
        }
        let fit = fit(&self.setup, &observations, Estimator::Joint).unwrap();
        let report =
            report(&self.setup, &observations, &fit, ErrorLimits::PAPER, &Instrument::default(), false).unwrap();
        let curve = report.functions.iter().find(|c| c.function == self.function).unwrap();
        // This machine is as the model assumes.
        let (_, budget) = curve.largest.as_ref().unwrap();
        let u95 = curve.unit.to_inner(budget.without(Source::Assumptions).combined.expanded);
        Found { observations, fit, u95 }
    }
}
