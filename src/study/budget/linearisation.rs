//! What linearisation leaves in the base parameters, on machines drawn within the limits.
//!
//! The readings of a machine less what they would be if the errors were small: its readings with every error a ten-thousandth,
//! ten thousand times. What remains is all orders from the second on.

use super::gum::COVERAGE;
use super::parts::Parts;
use crate::study::draw::Population;
use crate::study::fit::{Fit, Observation};
use crate::study::limits::ErrorLimits;
use crate::study::setup::Setup;
use crate::study::track::Track;
use chacha20::ChaCha8Rng;
use nalgebra::DVector;
use rand::SeedableRng;
use rayon::prelude::*;

/// Machines drawn: a root mean square over them is good to some 4 %.
const MACHINES: u64 = 400;
/// Samples of a run that are looked at, each for as many as there are: what is dropped is smooth.
const SAMPLES: usize = 180;
/// Errors so small that products of two do not count.
const SMALL: f64 = 1e-4;

/// What linearisation drops on the drawn machines.
pub(super) struct Dropped {
    /// What it adds to the base parameters: a column for each machine, scaled so that their squares sum to the mean.
    pub parts: Parts,
    /// Per run, the size that its readings' part stays below on 95 % of the machines, mm.
    pub usual: Vec<f64>,
}

impl Dropped {
    /// What it adds to a combination of base parameters on each machine.
    pub fn on_machines(&self, functional: &DVector<f64>) -> Vec<f64> {
        let scale = (MACHINES as f64).sqrt();
        self.parts.tr_mul(functional).iter().map(|share| share * scale).collect()
    }
}

pub(super) fn linearisation(setup: &Setup, observations: &[Observation], fit: &Fit, limits: ErrorLimits) -> Dropped {
    let thinned: Vec<Observation> = observations.iter().map(thin).collect();
    let sweeps = |o: &Observation| o.samples.iter().map(|s| s.sweep).collect::<Vec<_>>();
    let tracks: Vec<Track> = thinned.iter().map(|o| Track::new(setup, o.run, &sweeps(o))).collect();
    let machines = Population::new(setup, tracks.iter().map(Track::exact), limits);
    let share = 1.0 / (MACHINES as f64).sqrt();
    let dropped = |n: u64| -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(n);
        let machine = machines.draw(&mut random);
        let small = machine.scaled(SMALL);
        let run = |track: &Track| {
            let [exact, linear] = [&machine, &small].map(|machine| track.readings(machine));
            exact.iter().zip(linear).map(|(y, s)| (y - s / SMALL) * share).collect()
        };
        tracks.iter().map(run).collect()
    };
    let dropped: Vec<Vec<Vec<f64>>> = (0..MACHINES).into_par_iter().map(dropped).collect();
    let usual = |run: usize| {
        let mut sizes: Vec<f64> = dropped.iter().map(|m| m[run].iter().fold(0.0, |l: f64, y| l.max(y.abs()))).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get((COVERAGE * sizes.len() as f64) as usize).map_or(0.0, |size| size / share)
    };
    let usual = (0..thinned.len()).map(usual).collect();
    let mut at = vec![0; thinned.len()];
    let parts = fit.responses(setup, &thinned, dropped.len(), |d, by| {
        let sample = at[d.observation];
        at[d.observation] += 1;
        by.iter_mut().zip(&dropped).for_each(|(b, machine)| *b = machine[d.observation][sample]);
    });
    Dropped { parts, usual }
}

/// A run with few of its samples, each weighing as many as there are.
fn thin(observation: &Observation) -> Observation {
    let step = observation.samples.len().div_ceil(SAMPLES).max(1);
    let samples: Vec<_> = observation.samples.iter().step_by(step).cloned().collect();
    let each = observation.samples.len() as f64 / samples.len().max(1) as f64;
    Observation { run: observation.run, weight: observation.weight * each, samples }
}
