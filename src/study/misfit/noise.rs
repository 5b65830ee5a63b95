//! Whether residuals are noise: without memory from one to the next, and without single ones far out.

use std::collections::BTreeSet;

/// Standard deviations of a correlation of white noise above which residuals have a memory.
const SIGNIFICANT: f64 = 5.0;
/// Deviations, in units of the middle half, beyond which a residual is a spike.
const FAR: f64 = 8.0;
/// Above this correlation the effective number of samples is not worked out any more.
const MOST: f64 = 0.95;

/// Residuals far out that are kept, the furthest.
const KEPT: usize = 64;

/// What residuals look like, in the order of their sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Root mean square, mm.
    pub rms: f64,
    /// Robust standard deviation: from the median size, mm; none where only sums of the residuals are known.
    pub deviation: Option<f64>,
    /// Correlation of neighbours.
    pub correlation: f64,
    /// How many standard deviations fewer changes of sign there are than white noise about zero has; none where only sums are
    /// known.
    pub runs: Option<f64>,
    /// Positions of those far out; of more than 64 the furthest.
    pub spikes: Vec<usize>,
    /// Residuals there are.
    pub samples: usize,
}

/// A look at residuals, one after the other.
#[derive(Clone, Debug, Default)]
pub struct Looking {
    samples: usize,
    squares: f64,
    neighbours: f64,
    changes: usize,
    last: f64,
    sizes: Sizes,
    /// The largest sizes with their positions, the smallest of them first.
    largest: BTreeSet<(u64, usize)>,
}

impl Looking {
    /// At the next residual, mm.
    pub fn add(&mut self, residual: f64) {
        if self.samples > 0 {
            self.neighbours += self.last * residual;
            self.changes += usize::from((self.last > 0.0) != (residual > 0.0));
        }
        self.squares += residual * residual;
        self.last = residual;
        self.sizes.add(residual.abs());
        // Sizes of numbers are in the order of their bits.
        let size = residual.abs().to_bits();
        if self.largest.len() < KEPT || self.largest.first().is_some_and(|(least, _)| *least < size) {
            self.largest.insert((size, self.samples));
            if self.largest.len() > KEPT {
                self.largest.pop_first();
            }
        }
        self.samples += 1;
    }

    /// What was seen.
    pub fn look(&self) -> Look {
        let n = self.samples;
        let correlation = if self.squares > 0.0 { self.neighbours / self.squares } else { 0.0 };
        // Each of the n − 1 is a change with the probability 1/2.
        let pairs = n.max(2) as f64 - 1.0;
        let runs = (pairs / 2.0 - self.changes as f64) / (pairs / 4.0).sqrt();
        // The median of a normal distribution's sizes is 0.6745 of its deviation.
        let deviation = self.sizes.median() / 0.6745;
        let far = FAR * deviation;
        let is_far = |(size, at): &(u64, usize)| (f64::from_bits(*size) > far && far > 0.0).then_some(*at);
        let mut spikes: Vec<usize> = self.largest.iter().filter_map(is_far).collect();
        spikes.sort_unstable();
        let rms = (self.squares / n.max(1) as f64).sqrt();
        Look { rms, deviation: Some(deviation), correlation, runs: Some(runs), spikes, samples: n }
    }
}

impl Look {
    /// At residuals in the order of their sweep.
    pub fn at(residuals: &[f64]) -> Self {
        let mut looking = Looking::default();
        residuals.iter().for_each(|&residual| looking.add(residual));
        looking.look()
    }

    /// From the sum of their squares and that of the products of neighbours, mm²: single ones far out are not seen.
    pub fn of_sums(samples: usize, squares: f64, neighbours: f64) -> Self {
        let correlation = if squares > 0.0 { neighbours / squares } else { 0.0 };
        let rms = (squares / samples.max(1) as f64).sqrt();
        Self { rms, deviation: None, correlation, runs: None, spikes: Vec::new(), samples }
    }

    /// Whether neighbours are alike, by both tests where both are there.
    pub fn has_memory(&self) -> bool {
        self.correlation * (self.samples as f64).sqrt() > SIGNIFICANT && self.runs.is_none_or(|runs| runs > SIGNIFICANT)
    }

    /// Whether they may be noise and what linearisation drops, of which `dropped` (mm) is usual.
    pub fn is_noise(&self, dropped: f64) -> bool {
        let memory = self.has_memory() && self.rms * self.correlation.max(0.0).sqrt() > dropped;
        !memory && self.spikes.is_empty()
    }

    /// How many samples stand for an independent one.
    pub fn alike(&self) -> f64 {
        if !self.has_memory() {
            return 1.0;
        }
        let r = self.correlation.min(MOST);
        (1.0 + r) / (1.0 - r)
    }
}

/// How many sizes there are in each step of one part in 32: their median to 2 %, in constant memory.
#[derive(Clone, Debug)]
pub struct Sizes(Vec<u32>);

/// Bits of a number that tell its step: its exponent, and five of its digits.
const STEP_BITS: u32 = 52 - 5;
/// The step of 2⁻¹⁰⁰: smaller sizes count as zero.
const FIRST_STEP: u64 = (1023 - 100) << 5;
/// Steps up to 2²⁸; larger sizes are in the last one.
const STEPS: usize = 128 << 5;

impl Default for Sizes {
    fn default() -> Self {
        Self(vec![0; STEPS])
    }
}

impl Sizes {
    /// Another size.
    pub fn add(&mut self, size: f64) {
        let step = ((size.to_bits() >> STEP_BITS).saturating_sub(FIRST_STEP) as usize).min(STEPS - 1);
        if let Some(count) = self.0.get_mut(step) {
            *count = count.saturating_add(1);
        }
    }

    /// The middle of the step in which the median is; 0 of none.
    pub fn median(&self) -> f64 {
        let half = self.0.iter().map(|&n| u64::from(n)).sum::<u64>() / 2;
        let mut below = 0;
        let step = self.0.iter().position(|&n| {
            below += u64::from(n);
            below > half
        });
        match step {
            None | Some(0) => 0.0,
            Some(step) => f64::from_bits((((step as u64 + FIRST_STEP) << 1) + 1) << (STEP_BITS - 1)),
        }
    }
}

/// The median of the sizes of numbers, the upper one of two; 0 of none.
pub(super) fn median_size(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = numbers.map(f64::abs).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chacha20::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn noise_is_noise_and_a_wave_or_a_spike_in_it_is_seen() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let (mut said, mut waves) = (0, 0);
        for _ in 0..2000 {
            let noise: Vec<f64> = (0..360).map(|_| random.random_range(-1.0..=1.0)).collect();
            said += usize::from(!Look::at(&noise).is_noise(0.0));
            let wave: Vec<f64> = noise.iter().zip(0..).map(|(e, i)| e + (f64::from(i) * 0.05).sin()).collect();
            waves += usize::from(!Look::at(&wave).is_noise(0.0));
            let mut spike = noise.clone();
            spike[77] = 15.0;
            assert_eq!(Look::at(&spike).spikes, [77]);
        }
        assert_eq!((said, waves), (0, 2000));
    }

    #[test]
    fn readings_that_are_all_off_alike_stand_for_few() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let off: Vec<f64> = (0..360).map(|_| 10.0 + random.random_range(-1.0..=1.0)).collect();
        let both: Vec<f64> = off.iter().copied().chain(off.iter().rev().map(|x| -x)).collect();
        let [one, other] = [Look::at(&off), Look::at(&both)].map(|look| look.alike());
        assert!(one > 10.0 && one == other, "{one} {other}");
    }

    #[test]
    fn the_median_size_is_known_to_a_step() {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        for scale in [1e-9, 1e-4, 3.0] {
            let numbers: Vec<f64> = (0..1001).map(|_| scale * random.random_range(-1.0..=1.0)).collect();
            let mut sizes = Sizes::default();
            numbers.iter().for_each(|x| sizes.add(x.abs()));
            let exact = median_size(numbers.into_iter());
            assert!((sizes.median() / exact - 1.0).abs() < 0.02);
        }
        assert_eq!(Sizes::default().median(), 0.0);
    }
}
