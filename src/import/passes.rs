//! Samples in the order of time, divided where the way along the circle begins again.

use std::f64::consts::{PI, TAU};
use std::ops::{Range, RangeInclusive};

use trunnion_codegen::kinematics::Headings;

/// Going back by less than this, rad, is no turn: an axis that stands still trembles.
const TREMBLE: f64 = PI / 180.0;

/// A step of so many usual ones leads to another place.
const JUMP: f64 = 20.0;

/// The ranges of samples that go one way, each without a gap, and whether the angle grows; nothing where the samples are in no
/// order in time.
pub(super) fn passes(angles: &[f64]) -> Option<Vec<(Range<usize>, bool)>> {
    let mut headings = Headings::default();
    angles.iter().for_each(|angle| headings.add(*angle));
    if !headings.start().is_known() {
        return None;
    }
    let step = |pair: &[f64]| {
        let by = pair[1] - pair[0];
        if by.abs() > PI { by - TAU * (by / TAU).round() } else { by }
    };
    let mut usual: Vec<f64> = angles.windows(2).map(|pair| step(pair).abs()).filter(|by| *by > 0.0).collect();
    let middle = usual.len() / 2;
    let usual = *usual.get_mut(..)?.select_nth_unstable_by(middle, f64::total_cmp).1;
    let jump = TREMBLE.max(JUMP * usual);

    let mut found = Vec::new();
    let mut pass = Pass::begin(0);
    for (at, pair) in (1..).zip(angles.windows(2)) {
        let by = step(pair);
        if by.abs() > jump {
            found.push(pass.end(at));
            pass = Pass::begin(at);
        } else if let Some(turn) = pass.go(at, by) {
            found.push(pass.end(turn));
            // The farthest place belongs to the way there, or half of the samples at it.
            let back = angles[turn - 1..=at].windows(2).map(step).sum();
            pass = Pass { begin: turn, along: back, farthest: (back, at..=at) };
        }
    }
    found.push(pass.end(angles.len()));
    Some(found)
}

/// A way that is being gone.
struct Pass {
    begin: usize,
    /// How far it is from where it began, rad.
    along: f64,
    /// The farthest so far, and the samples that were there.
    farthest: (f64, RangeInclusive<usize>),
}

impl Pass {
    fn begin(at: usize) -> Self {
        Self { begin: at, along: 0.0, farthest: (0.0, at..=at) }
    }

    /// Goes on by a step to a sample; where it began to go back, if it does.
    fn go(&mut self, at: usize, by: f64) -> Option<usize> {
        self.along += by;
        let (farthest, there) = self.farthest.clone();
        let on = self.along * farthest.signum();
        if on >= farthest.abs() {
            let from = if self.along == farthest { *there.start() } else { at };
            self.farthest = (self.along, from..=at);
            return None;
        }
        if farthest.abs() <= TREMBLE {
            // The direction is not decided yet.
            if self.along.abs() > farthest.abs() {
                self.farthest = (self.along, at..=at);
            }
            return None;
        }
        (farthest.abs() - on > TREMBLE).then_some(there.start() + (there.end() - there.start()) / 2 + 1)
    }

    fn end(&self, at: usize) -> (Range<usize>, bool) {
        (self.begin..at, self.farthest.0 >= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(angles: impl IntoIterator<Item = i32>) -> Vec<f64> {
        angles.into_iter().map(|angle| f64::from(angle).to_radians()).collect()
    }

    #[test]
    fn both_ways_repeats_and_turns_are_told_apart() {
        let there = || -20..=200;
        let back = || (-20..=200).rev();
        let divided = |angles: Vec<f64>| passes(&angles);
        assert_eq!(divided(degrees(there())), Some(vec![(0..221, true)]));
        assert_eq!(divided(degrees(back())), Some(vec![(0..221, false)]));
        assert_eq!(divided(degrees(there().chain(back()))), Some(vec![(0..221, true), (221..442, false)]));
        let again = divided(degrees(there().chain(there()).chain(back())));
        assert_eq!(again, Some(vec![(0..221, true), (221..442, true), (442..663, false)]));
        // A whole turn that begins again goes on.
        assert_eq!(divided(degrees((0..360).chain(0..360))), Some(vec![(0..720, true)]));
        // Trembling before it sets off, and where it waits.
        let waits = |i: i32| 0.001 * f64::from(i % 2);
        let along =
            (0..40).map(waits).chain((0..900).map(|i| 0.01 * f64::from(i) + if i == 500 { 0.012 } else { 0.0 }));
        assert_eq!(divided(along.collect()), Some(vec![(0..940, true)]));
        assert_eq!(divided(degrees((0..360).map(|i| 5 * (i * 7 % 20)))), None);
        assert_eq!(divided(Vec::new()), None);
        assert_eq!(divided(vec![1.0; 20]), None);
    }
}
