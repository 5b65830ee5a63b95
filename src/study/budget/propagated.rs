//! The distributions of a budget propagated by a Monte Carlo method: JCGM 101:2008 (GUM, Supplement 1).
//!
//! The budget combines standard uncertainties and takes the sum as normal or Student's; this draws each quantity from its own
//! distribution and looks where the sum is.

use super::gum::COVERAGE;
use super::input::{Detail, Distribution, Input};
use chacha20::ChaCha8Rng;
use rand::{Rng, RngExt, SeedableRng};
use rayon::prelude::*;

/// Trials that are drawn from one stream of random numbers, whatever thread does it.
const CHUNK: usize = 4000;

impl Detail {
    /// The half width within which 95 % of the results are when the distributions themselves are propagated, in the unit of the
    /// result; the same each time.
    pub fn monte_carlo(&self, trials: usize) -> f64 {
        half_width(&self.inputs, &self.drawn, trials)
    }
}

/// The half width within which 95 % of the sums are; `drawn` are values of what is distributed as on drawn machines.
fn half_width(inputs: &[Input], drawn: &[f64], trials: usize) -> f64 {
    let mut sizes = vec![0.0; trials.max(1)];
    sizes.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, sizes)| {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(chunk as u64);
        for size in sizes {
            let off: f64 = inputs.iter().map(|input| one(input, drawn, &mut random)).sum();
            *size = off.abs();
        }
    });
    covering(&mut sizes)
}

/// The half width of the interval about nothing that holds the share of all trials, of what each is off by: JCGM 101, 7.7.2.
pub(crate) fn covering(sizes: &mut [f64]) -> f64 {
    let at = ((COVERAGE * sizes.len() as f64).ceil() as usize).clamp(1, sizes.len().max(1)) - 1;
    if sizes.is_empty() { 0.0 } else { *sizes.select_nth_unstable_by(at, f64::total_cmp).1 }
}

/// What one quantity puts into the result.
fn one(input: &Input, drawn: &[f64], random: &mut impl Rng) -> f64 {
    let contribution = input.contribution;
    match input.distribution {
        Distribution::Rectangular => contribution.std * 3f64.sqrt() * random.random_range(-1.0..=1.0),
        Distribution::Normal | Distribution::Waves => contribution.std * student(None, random),
        Distribution::Student => contribution.std * student(contribution.degrees_of_freedom, random),
        Distribution::Drawn => drawn.get(random.random_range(0..drawn.len().max(1))).copied().unwrap_or(0.0),
    }
}

/// Student's t by Bailey's polar method, and Marsaglia's where the degrees of freedom are infinite (JCGM 101, C.4 and 6.4.9).
pub(crate) fn student(degrees_of_freedom: Option<u32>, random: &mut impl Rng) -> f64 {
    let [u, v]: [f64; 2] = std::array::from_fn(|_| random.random_range(-1.0..=1.0));
    let w = u * u + v * v;
    if w >= 1.0 || w == 0.0 {
        return student(degrees_of_freedom, random);
    }
    match degrees_of_freedom.map(f64::from) {
        None => u * (-2.0 * w.ln() / w).sqrt(),
        Some(n) => u * (n * (w.powf(-2.0 / n) - 1.0) / w).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::gum::Contribution;
    use super::super::source::Source;
    use super::*;

    fn input(distribution: Distribution, std: f64, degrees_of_freedom: Option<u32>) -> Input {
        Input {
            source: Source::Noise,
            quantity: String::new(),
            distribution,
            bound: None,
            std,
            unit: "um",
            sensitivity: 1.0,
            contribution: Contribution { std, degrees_of_freedom },
        }
    }

    /// Closed forms: tables of Student's t and the normal distribution; 95 % of a rectangle; a triangle of two equal ones.
    #[test]
    fn one_distribution_alone_has_its_own_interval() {
        let near = |inputs: &[Input], expected: f64| {
            let found = half_width(inputs, &[], 200_000);
            assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected}");
        };
        near(&[input(Distribution::Normal, 2.0, None)], 2.0 * 1.959_964);
        near(&[input(Distribution::Student, 1.0, Some(4))], 2.776_445);
        near(&[input(Distribution::Student, 1.0, Some(30))], 2.042_272);
        let rectangle = input(Distribution::Rectangular, 1.0, None);
        near(std::slice::from_ref(&rectangle), 0.95 * 3f64.sqrt());
        near(&[rectangle.clone(), rectangle], 2.0 * 3f64.sqrt() * (1.0 - 0.05f64.sqrt()));
    }

    #[test]
    fn drawn_values_are_drawn_again() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        let width = half_width(&[input(Distribution::Drawn, 1.0, None)], &values, 100_000);
        assert!((95.0..=96.0).contains(&width), "{width}");
    }
}
