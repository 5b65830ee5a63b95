//! What a probed result's uncertainty is made of, row by row (JCGM 100), and the same by trials (JCGM 101).

use crate::study::{COVERAGE, Combined, Contributing, combine, covering, student};
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use rayon::prelude::*;

/// Touches in all trials together, and how many trials there are at least and at most.
const TOUCHES: usize = 8_000_000;
const TRIALS: [usize; 2] = [2_000, 20_000];

/// What a quantity puts into a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbedPart {
    /// Where it comes from.
    pub source: &'static str,
    /// Its name.
    pub quantity: &'static str,
    /// Two standard uncertainties of it, as they are stated, mm; none where the touches themselves say them.
    pub stated: Option<f64>,
    /// Its standard uncertainty, mm.
    pub std: f64,
    /// By how much the result changes with it; of what changes from touch to touch the root of the sum of squares.
    pub sensitivity: f64,
    /// Degrees of freedom of its standard uncertainty; none where that is taken as exactly known.
    pub degrees_of_freedom: Option<u32>,
}

impl ProbedPart {
    /// Of a quantity of which two standard uncertainties, mm, are stated.
    pub(super) fn stated(source: &'static str, quantity: &'static str, two: f64, sensitivity: f64) -> Self {
        Self { source, quantity, stated: Some(two), std: two / 2.0, sensitivity, degrees_of_freedom: None }
    }

    /// What of the result's standard uncertainty it is, mm.
    pub fn contribution(&self) -> f64 {
        self.sensitivity.abs() * self.std
    }
}

/// The uncertainty of one result, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedBudget {
    /// The result's name.
    pub result: &'static str,
    /// What it is made of; the rows are uncorrelated.
    pub parts: Vec<ProbedPart>,
    /// All of them.
    pub combined: Combined,
}

impl ProbedBudget {
    pub(super) fn new(result: &'static str, parts: Vec<ProbedPart>) -> Self {
        let contribution =
            |part: &ProbedPart| Contributing { std: part.contribution(), degrees_of_freedom: part.degrees_of_freedom };
        let combined = combine(parts.iter().map(contribution), COVERAGE);
        Self { result, parts, combined }
    }

    /// A part's share of the variance.
    pub fn share(&self, part: &ProbedPart) -> f64 {
        if self.combined.std > 0.0 { (part.contribution() / self.combined.std).powi(2) } else { 0.0 }
    }
}

/// Intervals of results by a Monte Carlo method: the touches drawn as they may have been, and evaluated as the measured ones were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tried<const N: usize> {
    /// How many times.
    pub trials: usize,
    /// The half width about each result that holds 95 % of what the trials came to, mm.
    pub expanded: [f64; N],
}

impl<const N: usize> Tried<N> {
    /// Of so many touches; `trial` gives what each result is off by, mm, none where there is none. The same each time; none where
    /// too many trials have no result.
    pub(super) fn new(touches: usize, trial: impl Fn(&mut ChaCha8Rng) -> Option<[f64; N]> + Sync) -> Option<Self> {
        let [least, most] = TRIALS;
        let trials = (TOUCHES / touches.max(1)).clamp(least, most);
        let one = |n: u64| {
            let mut random = ChaCha8Rng::seed_from_u64(0);
            random.set_stream(n);
            trial(&mut random).unwrap_or([f64::INFINITY; N])
        };
        let off: Vec<[f64; N]> = (0..trials as u64).into_par_iter().map(one).collect();
        let half = |k: usize| covering(&mut off.iter().map(|off| off[k].abs()).collect::<Vec<_>>());
        let expanded: [f64; N] = std::array::from_fn(half);
        expanded.iter().all(|half| half.is_finite()).then_some(Self { trials, expanded })
    }
}

/// A number of the standard normal distribution.
pub(super) fn normal(random: &mut ChaCha8Rng) -> f64 {
    student(None, random)
}
