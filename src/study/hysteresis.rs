//! Both directions of a run: the circular hysteresis (ISO 230-4, H).

use super::fit::{Observation, Sample};
use super::setup::Setup;
use std::f64::consts::TAU;
use trunnion_codegen::ids::RunId;

/// Steps of a turn over which readings of one direction are averaged.
pub(super) const STEPS: usize = 180;

/// What a run reads with the sweep increasing and decreasing.
#[derive(Clone, Debug, PartialEq)]
pub struct Hysteresis {
    /// The run.
    pub run: String,
    /// Samples of either direction.
    pub samples: [usize; 2],
    /// The largest difference of the mean readings at one angle, increasing less decreasing, mm.
    pub largest: f64,
    /// Where it is, rad.
    pub at: f64,
    /// The mean difference, mm.
    pub mean: f64,
}

/// Readings of either direction, averaged over steps of a turn.
#[derive(Clone, Debug)]
pub(super) struct Averages([Vec<(f64, usize)>; 2]);

impl Default for Averages {
    fn default() -> Self {
        Self([vec![(0.0, 0); STEPS], vec![(0.0, 0); STEPS]])
    }
}

impl Averages {
    pub fn add(&mut self, sample: &Sample) {
        if sample.direction != 0.0 {
            let step = (sample.sweep.rem_euclid(TAU) / TAU * STEPS as f64) as usize % STEPS;
            self.put(sample.direction < 0.0, step, sample.reading, 1);
        }
    }

    /// Adds the sum of so many readings in one step; `direction` is 0 where it is not known.
    pub fn add_all(&mut self, direction: i8, step: i32, sum: f64, count: usize) {
        if direction != 0 {
            self.put(direction < 0, step.rem_euclid(STEPS as i32) as usize, sum, count);
        }
    }

    fn put(&mut self, back: bool, step: usize, more: f64, samples: usize) {
        let (sum, count) = &mut self.0[usize::from(back)][step];
        *sum += more;
        *count += samples;
    }

    fn merge(&mut self, other: &Self) {
        for ((sum, count), (other_sum, other_count)) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            *sum += other_sum;
            *count += other_count;
        }
    }
}

/// Every run that was measured in both directions; `averages` are those of the observations.
pub(super) fn hysteresis(setup: &Setup, observations: &[Observation], averages: &[Averages]) -> Vec<Hysteresis> {
    let of = |run: RunId| {
        let mut all = Averages::default();
        let own = observations.iter().zip(averages).filter(|(o, _)| o.run == run);
        own.for_each(|(_, averages)| all.merge(averages));
        let Averages(sums) = all;
        let samples = [0, 1].map(|direction| sums[direction].iter().map(|(_, n)| n).sum());
        let differences: Vec<(usize, f64)> = (0..STEPS)
            .filter_map(|step| {
                let mean = |(sum, n): (f64, usize)| (n > 0).then(|| sum / n as f64);
                Some((step, mean(sums[0][step])? - mean(sums[1][step])?))
            })
            .collect();
        let &(step, largest) = differences.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        // A stray step back is no second direction.
        (differences.len() * 4 >= sums[0].iter().filter(|(_, n)| *n > 0).count()).then(|| Hysteresis {
            run: setup.model.runs[run].name.clone(),
            samples,
            largest,
            at: (step as f64 + 0.5) * TAU / STEPS as f64,
            mean: differences.iter().map(|(_, d)| d).sum::<f64>() / differences.len() as f64,
        })
    };
    setup.model.runs.keys().filter_map(of).collect()
}
