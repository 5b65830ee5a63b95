//! Positions exchanged one by one for better ones, until none is better.
//!
//! V. V. Fedorov, Theory of Optimal Experiments (1972), with what is asked here in place of a determinant: the largest of the
//! functions' standard deviations over what each is held against, and where that is the same, the mean of their squares.

use super::candidates::{Candidates, Known};
use crate::study::plan::design::grade;
use rayon::prelude::*;

/// How good a set is, the least is the best.
pub type Graded = [i64; 2];

/// Times that all of a set's positions are gone through, at most: some five are enough.
const PASSES: usize = 100;

/// What sets are held to.
pub struct Held<'a> {
    /// The positions.
    pub candidates: &'a Candidates<'a>,
    /// What each function's standard deviation is held against.
    pub against: &'a [f64],
    /// Positions that each run has at least.
    pub least: &'a [usize],
    /// What a set is first compared by.
    pub first: First,
}

/// What sets are first compared by.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum First {
    /// Their largest share.
    Largest,
    /// The mean square of all shares: smooth, so that exchanging single positions gets further.
    Mean,
}

impl Held<'_> {
    /// How good a set is by its standard deviations; the worst where it does not determine all.
    pub fn graded(&self, stds: Option<Vec<f64>>) -> Graded {
        let Some(stds) = stds else { return [i64::MAX; 2] };
        let shares = || stds.iter().zip(self.against).map(|(std, against)| std / against);
        let mean = shares().map(|share| share * share).sum::<f64>() / stds.len().max(1) as f64;
        let (largest, mean) = (grade(shares().fold(0.0, f64::max)), grade(mean));
        match self.first {
            First::Largest => [largest, mean],
            First::Mean => [mean, largest],
        }
    }

    /// Exchanges positions of a set as long as that makes it better.
    pub fn exchanged(&self, mut chosen: Vec<usize>) -> Vec<usize> {
        for _ in 0..PASSES {
            let mut known = self.candidates.known(chosen.iter().copied());
            let before = self.graded(known.stds());
            let mut best = before;
            for at in 0..chosen.len() {
                let others = known.but(chosen[at]);
                if let Some((better, own)) = self.best(&chosen, at, &others).filter(|(better, _)| *better < best) {
                    (best, chosen[at], known) = (better, own, others.and(own));
                }
            }
            if best == before {
                break;
            }
        }
        chosen.sort_unstable();
        chosen
    }

    /// Drops positions, always the one that is missed least, until so many are left.
    pub fn dropped(&self, count: usize) -> Vec<usize> {
        let mut chosen: Vec<usize> = (0..self.candidates.len()).collect();
        let mut known = self.candidates.known(chosen.iter().copied());
        while chosen.len() > count {
            let left = self.counts(&chosen);
            let may = |own: &usize| {
                let run = self.candidates.place(*own).0;
                left[run] > self.least[run]
            };
            let without = |own: usize| (self.graded(known.without(own)), own);
            let Some((_, missed)) = chosen.par_iter().copied().filter(may).map(without).min() else { break };
            chosen.retain(|own| *own != missed);
            known = known.but(missed);
        }
        chosen
    }

    /// The best beside the others in the place of one of a set's positions, the first of those that are as good.
    fn best(&self, chosen: &[usize], place: usize, others: &Known) -> Option<(Graded, usize)> {
        let run = self.candidates.place(chosen[place]).0;
        let stays = self.counts(chosen)[run] <= self.least[run];
        let may = |own: &usize| !chosen.contains(own) && (!stays || self.candidates.place(*own).0 == run);
        let one = |own: usize| (self.graded(others.with(own)), own);
        (0..self.candidates.len()).into_par_iter().filter(may).map(one).min()
    }

    /// How many positions of each run are in a set.
    fn counts(&self, set: &[usize]) -> Vec<usize> {
        let mut counts = vec![0; self.least.len()];
        set.iter().for_each(|i| counts[self.candidates.place(*i).0] += 1);
        counts
    }
}
