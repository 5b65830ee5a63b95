//! What linearisation leaves in the base parameters, on machines drawn within the limits.
//!
//! The readings of a machine less what they would be if the errors were small: its readings with every error a ten-thousandth,
//! ten thousand times. What remains is all orders from the second on.

use super::gum::COVERAGE;
use super::parts::Parts;
use crate::study::dependence::Dependence;
use crate::study::draw::Population;
use crate::study::factors::Factors;
use crate::study::fit::{Fit, Observation};
use crate::study::limits::ErrorLimits;
use crate::study::setup::Setup;
use crate::study::track::Track;
use chacha20::ChaCha8Rng;
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rayon::prelude::*;
use std::ops::Range;
use trunnion_codegen::graph::LANES;

/// Machines drawn: a root mean square over them is good to some 4 %.
const MACHINES: usize = 400;
/// Samples of a run that are looked at, each for as many as there are: what is dropped is smooth. Whole blocks.
const SAMPLES: usize = 2 * LANES;
/// Errors so small that products of two do not count.
const SMALL: f64 = 1e-4;

/// What linearisation drops on the drawn machines.
pub(super) struct Dropped {
    /// What it adds to the base parameters: a column for each machine, scaled so that their squares sum to the mean.
    pub parts: Parts,
    /// The machines.
    pub machines: Factors,
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
    let mut ranges = Vec::new();
    for track in &tracks {
        let start = ranges.last().map_or(0, |range: &Range<usize>| range.end);
        ranges.push(start..start + track.samples());
    }
    let samples = ranges.last().map_or(0, |range| range.end);
    let share = 1.0 / (MACHINES as f64).sqrt();
    // What it drops from every reading, a column for each machine.
    let (mut dropped, mut factors) = (DMatrix::zeros(samples, MACHINES), Factors::room(setup, MACHINES));
    let drop = |small: &mut Vec<f64>, (n, (dropped, factors)): (usize, (&mut [f64], &mut [f64]))| {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(n as u64);
        let machine = machines.draw(&mut random);
        machine.write_factors(setup, factors);
        for (track, range) in tracks.iter().zip(&ranges) {
            track.read(&machine, 1.0, &mut dropped[range.clone()]);
            track.read(&machine, SMALL, &mut small[range.clone()]);
        }
        dropped.iter_mut().zip(small).for_each(|(y, s)| *y = (*y - *s / SMALL) * share);
    };
    let columns = dropped.as_mut_slice().par_chunks_mut(samples.max(1));
    columns.zip(factors.machines_mut()).enumerate().for_each_init(|| vec![0.0; samples], drop);
    let of_run = |range: &Range<usize>| dropped.rows_range(range.clone());
    let usual = |range: &Range<usize>| {
        let mut sizes: Vec<f64> = of_run(range).column_iter().map(|machine| machine.amax()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get((COVERAGE * sizes.len() as f64) as usize).map_or(0.0, |size| size / share)
    };
    let usual = ranges.iter().map(usual).collect();
    let dependence = Dependence::new(setup, &thinned, fit);
    let none = DMatrix::zeros(fit.base.len(), MACHINES);
    let parts =
        ranges.iter().enumerate().fold(none, |sum, (run, range)| sum + dependence.responses(run, of_run(range)));
    Dropped { parts, machines: factors, usual }
}

/// A run with few of its samples, each weighing as many as there are.
fn thin(observation: &Observation) -> Observation {
    let step = observation.samples.len().div_ceil(SAMPLES).max(1);
    let samples: Vec<_> = observation.samples.iter().step_by(step).cloned().collect();
    let each = observation.samples.len() as f64 / samples.len().max(1) as f64;
    Observation { run: observation.run, weight: observation.weight * each, samples }
}
