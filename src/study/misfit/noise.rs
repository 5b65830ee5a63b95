//! Whether residuals are noise: without memory from one to the next, and without single ones far out.

/// Standard deviations of a correlation of white noise above which residuals have a memory.
const SIGNIFICANT: f64 = 5.0;
/// Deviations, in units of the middle half, beyond which a residual is a spike.
const FAR: f64 = 8.0;
/// Above this correlation the effective number of samples is not worked out any more.
const MOST: f64 = 0.95;

/// What residuals look like, in the order of their sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Root mean square, mm.
    pub rms: f64,
    /// Correlation of neighbours.
    pub correlation: f64,
    /// How many standard deviations fewer changes of sign there are than white noise has (Wald and Wolfowitz' run test).
    pub runs: f64,
    /// Positions of those far out.
    pub spikes: Vec<usize>,
    samples: usize,
}

impl Look {
    /// At residuals in the order of their sweep.
    pub fn at(residuals: &[f64]) -> Self {
        let n = residuals.len();
        let squares: f64 = residuals.iter().map(|e| e * e).sum();
        let neighbours: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        let correlation = if squares > 0.0 { neighbours / squares } else { 0.0 };
        let above = residuals.iter().filter(|e| **e > 0.0).count() as f64;
        let below = n as f64 - above;
        let changes = residuals.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count() as f64 + 1.0;
        let expected = 1.0 + 2.0 * above * below / n.max(1) as f64;
        let variance = (expected - 1.0) * (expected - 2.0) / (n as f64 - 1.0).max(1.0);
        let runs = if variance > 0.0 { (expected - changes) / variance.sqrt() } else { 0.0 };
        // That of a normal distribution is 0.6745 of its deviation.
        let scale = median_size(residuals.iter().copied()) / 0.6745;
        let far = |(i, e): (usize, &f64)| (e.abs() > FAR * scale && scale > 0.0).then_some(i);
        let spikes = residuals.iter().enumerate().filter_map(far).collect();
        Self { rms: (squares / n.max(1) as f64).sqrt(), correlation, runs, spikes, samples: n }
    }

    /// Whether neighbours are alike, by both tests.
    pub fn has_memory(&self) -> bool {
        self.correlation * (self.samples as f64).sqrt() > SIGNIFICANT && self.runs > SIGNIFICANT
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

/// The median of the sizes of numbers, the upper one of two; 0 of none.
pub(super) fn median_size(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = numbers.map(f64::abs).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

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
}
