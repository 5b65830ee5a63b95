//! The noise of drawn readings.
//!
//! A trial has its own stream, so that it does not matter which thread draws it or what else is drawn: ChaCha gives the state
//! that xoshiro256++ goes on from, which is three times as fast.

use chacha20::ChaCha8Rng;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};

/// Uniform noise.
pub(super) struct Noise {
    seed: u64,
    width: f64,
}

impl Noise {
    /// Of half width `width`.
    pub fn new(seed: u64, width: f64) -> Self {
        Self { seed, width }
    }

    /// Fills `values` with those of a trial.
    pub fn fill(&self, trial: u64, values: &mut [f64]) {
        let mut states = ChaCha8Rng::seed_from_u64(self.seed);
        // Machines are drawn from the streams at the other end.
        states.set_stream(!trial);
        let mut state = [0; 32];
        states.fill_bytes(&mut state);
        let mut random = Xoshiro256PlusPlus::from_seed(state);
        // 52 bits as the fraction of a number from 1 to 2.
        let unit = |bits: u64| 2.0 * f64::from_bits(1f64.to_bits() | bits >> 12) - 3.0;
        values.iter_mut().for_each(|value| *value = self.width * unit(random.next_u64()));
    }
}
