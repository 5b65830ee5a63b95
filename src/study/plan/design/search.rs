//! The fewest placings of the balls, then the fewest runs, that make functions as certain as is asked.
//!
//! More runs never know less, so a branch of which all runs together do not suffice is left out: what is found is the fewest
//! there are, not merely few, but where so many sets would suffice that only the first of them are looked at.

use super::pool::Pool;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::collections::BTreeMap;
use trunnion_codegen::ids::FunctionId;

/// What each function's standard uncertainty may be at most, mm or rad.
pub type Within = BTreeMap<FunctionId, f64>;

/// A set of runs that suffices.
#[derive(Clone, Debug, PartialEq)]
pub struct Enough {
    /// Positions in the pool, ascending.
    pub runs: Vec<usize>,
    /// How many placings of the balls they need.
    pub placings: usize,
    /// The largest of uncertainties over what they may be: at most 1.
    pub share: f64,
}

/// Goes through the sets that suffice: those with the fewest placings first, of these those with the fewest runs, of these the
/// most certain; as long as `each` asks for more. `done` is told how many placings are being tried.
pub fn fewest(pool: &Pool, within: &Within, done: &(dyn Fn(usize) + Sync), each: &mut dyn FnMut(Enough) -> Next) {
    for count in 1..=pool.placings().min(PLACINGS) {
        done(count);
        let inside = |chosen: &Vec<usize>| -> Vec<usize> {
            pool.runs().filter(|&i| chosen.contains(&pool.placing(i))).collect()
        };
        let pools: Vec<Vec<usize>> = combinations(pool.placings(), count)
            .par_iter()
            .map(inside)
            .filter(|runs| share(pool, within, &pool.known(runs.iter().copied())) <= 1.0)
            .collect();
        let most = pools.iter().map(Vec::len).max().unwrap_or(0);
        for size in count..=most {
            let sets = |runs: &Vec<usize>| Search::new(pool, within, runs).of_size(size);
            let mut sets: Vec<Enough> = pools.par_iter().flat_map_iter(sets).collect();
            // With fewer placings they were found before.
            sets.retain(|set| set.placings == count);
            sets.sort_by(|a, b| grade(a.share).cmp(&grade(b.share)).then_with(|| a.runs.cmp(&b.runs)));
            for set in sets.into_iter().take(TRIED) {
                if each(set) == Next::Enough {
                    return;
                }
            }
        }
    }
}

/// What sizes are compared by: what differs by no more than a hundred thousandth of itself differs by rounding, which is another on
/// every processor.
pub fn grade(size: f64) -> i64 {
    (size.max(f64::MIN_POSITIVE).ln() * 1e5).round() as i64
}

/// Sets of one size that are looked at more closely.
const TRIED: usize = 24;
/// Placings of the balls that anybody would go to.
const PLACINGS: usize = 8;
/// Sets and branches of one size that are weighed for the same placings.
const WEIGHED: usize = 20_000;

/// Whether another set is wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// It is.
    More,
    /// It is not.
    Enough,
}

/// The largest uncertainty over what it may be.
pub fn share(pool: &Pool, within: &Within, known: &DMatrix<f64>) -> f64 {
    let Some(stds) = pool.uncertainties(known, within.keys().copied()) else { return f64::INFINITY };
    stds.iter().map(|(f, std)| std / within.get(f).copied().unwrap_or(f64::INFINITY)).fold(0.0, f64::max)
}

struct Search<'a> {
    pool: &'a Pool,
    within: &'a Within,
    runs: &'a [usize],
    /// What the runs from each on know together, without the 1 of what was known before.
    after: Vec<DMatrix<f64>>,
}

impl<'a> Search<'a> {
    fn new(pool: &'a Pool, within: &'a Within, runs: &'a [usize]) -> Self {
        let size = pool.known([]).nrows();
        let mut after = vec![DMatrix::zeros(size, size)];
        for &run in runs.iter().rev() {
            let sum = pool.add(&after[after.len() - 1], run);
            after.push(sum);
        }
        after.reverse();
        Self { pool, within, runs, after }
    }

    fn of_size(&self, size: usize) -> Vec<Enough> {
        let (mut found, mut left) = (Vec::new(), WEIGHED);
        self.extend(&mut Vec::new(), &self.pool.known([]), 0, size, &mut found, &mut left);
        found
    }

    /// Adds `size` runs from the position on to the chosen ones; `left` is what may still be weighed.
    fn extend(
        &self,
        chosen: &mut Vec<usize>,
        known: &DMatrix<f64>,
        from: usize,
        size: usize,
        found: &mut Vec<Enough>,
        left: &mut usize,
    ) {
        if size == 0 {
            let share = share(self.pool, self.within, known);
            if share <= 1.0 {
                let mut placings: Vec<usize> = chosen.iter().map(|&i| self.pool.placing(i)).collect();
                placings.sort_unstable();
                placings.dedup();
                found.push(Enough { runs: chosen.clone(), placings: placings.len(), share });
            }
            return;
        }
        for at in from..=self.runs.len().saturating_sub(size) {
            *left = left.saturating_sub(1);
            if *left == 0 || at >= self.runs.len() || share(self.pool, self.within, &(known + &self.after[at])) > 1.0 {
                return;
            }
            chosen.push(self.runs[at]);
            self.extend(chosen, &self.pool.add(known, self.runs[at]), at + 1, size - 1, found, left);
            chosen.pop();
        }
    }
}

/// All sets of `count` of the numbers below `of`, ascending.
fn combinations(of: usize, count: usize) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..count {
        let longer = |set: &Vec<usize>| {
            let from = set.last().map_or(0, |last| last + 1);
            let set = set.clone();
            (from..of).map(move |next| set.iter().copied().chain([next]).collect::<Vec<usize>>())
        };
        sets = sets.iter().flat_map(longer).collect();
    }
    sets
}
