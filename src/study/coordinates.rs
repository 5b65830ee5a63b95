//! Coordinates of an axis with what errors are made of there, worked out once for all machines.

use std::collections::BTreeSet;
use trunnion_codegen::algebra::wrapped_value;
use trunnion_codegen::graph::{LANES, Lanes, in_blocks};

/// Numbers in so many sums that do not wait for each other.
pub(super) const PART: usize = 8;
/// Sines and cosines that are kept, at most: those of higher multiples are worked out each time.
const KEPT: usize = 1 << 20;

/// Coordinates in blocks; the last one is repeated to the end of its block.
#[derive(Clone, Debug)]
pub(super) struct Coordinates {
    x: Vec<Lanes>,
    /// The same less whole turns, by where the turn begins.
    turned: Vec<(i32, Vec<Lanes>)>,
    /// Cosines and sines of the multiples 1, 2, …
    waves: Vec<[Vec<Lanes>; 2]>,
}

impl Coordinates {
    /// `x` with sines and cosines of `harmonics` multiples, and with turns that begin at `starts`, in steps of 15°.
    pub fn new(mut x: Vec<f64>, harmonics: usize, starts: BTreeSet<i32>) -> Self {
        if let Some(&last) = x.last() {
            x.resize(x.len().next_multiple_of(LANES), last);
        }
        let kept = harmonics.min(KEPT / (2 * x.len().max(1)));
        let of = |f: &dyn Fn(f64) -> f64| in_blocks(x.iter().map(|&x| f(x)));
        Self {
            turned: starts.into_iter().map(|start| (start, of(&|x| wrapped_value(x, start)))).collect(),
            waves: (1..=kept).map(|k| [of(&|x| (k as f64 * x).cos()), of(&|x| (k as f64 * x).sin())]).collect(),
            x: of(&|x| x),
        }
    }

    /// How many blocks there are.
    pub fn blocks(&self) -> usize {
        self.x.len()
    }

    /// A block of the coordinates, less whole turns from a start on.
    #[inline(always)]
    pub fn of_turn(&self, start: Option<i32>, block: usize) -> &Lanes {
        let turned = start.and_then(|start| self.turned.iter().find(|(from, _)| *from == start));
        &turned.map_or(&self.x, |(_, turned)| turned)[block]
    }

    /// Hands on cosines and sines of a multiple.
    #[inline(always)]
    pub fn wave(&self, multiple: usize, block: usize, mut then: impl FnMut(&Lanes, &Lanes)) {
        match self.waves.get(multiple - 1) {
            Some([cos, sin]) => then(&cos[block], &sin[block]),
            None => {
                let angle = self.x[block].map(|x| multiple as f64 * x);
                then(&angle.map(f64::cos), &angle.map(f64::sin));
            }
        }
    }
}
