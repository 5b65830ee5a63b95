//! A deviation as a function of the angle, wherever it was measured.

use std::f64::consts::TAU;

/// Angles between neighbours up to this many mean steps are bridged, and up to [`BRIDGED`] in any case.
const STEPS: f64 = 3.0;
/// Ten degrees, rad.
const BRIDGED: f64 = TAU / 36.0;

/// Deviations (mm) by angle (rad): a straight line from each to the next; the mean where there are several at one angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Rising over less than a turn, from the end of the widest gap on.
    points: Vec<(f64, f64)>,
    /// Steps wider than this are gaps.
    widest: f64,
    step: f64,
}

impl Profile {
    /// Of pairs of angle and deviation in any order, finite ones; angles a turn apart are one.
    pub fn new(samples: impl IntoIterator<Item = (f64, f64)>) -> Self {
        // A tiny negative angle rounds to the whole turn.
        let turned = |a: f64| Some(a.rem_euclid(TAU)).filter(|a| *a < TAU).unwrap_or(0.0);
        let mut sorted: Vec<_> = samples.into_iter().map(|(a, d)| (turned(a), d)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mean = |at: &[(f64, f64)]| {
            let first = at.first()?.0;
            Some((first, at.iter().map(|(_, d)| d / at.len() as f64).sum()))
        };
        let mut points: Vec<(f64, f64)> = sorted.chunk_by(|a, b| a.0 == b.0).filter_map(mean).collect();
        let gap = |at: usize| step_after(&points, at);
        let widest = (0..points.len()).max_by(|a, b| gap(*a).total_cmp(&gap(*b))).unwrap_or(0);
        let step = (TAU - gap(widest)) / points.len().saturating_sub(1).max(1) as f64;
        let count = points.len();
        points.rotate_left(if count > 0 { (widest + 1) % count } else { 0 });
        let first = points.first().map_or(0.0, |(a, _)| *a);
        points.iter_mut().filter(|(a, _)| *a < first).for_each(|(a, _)| *a += TAU);
        Self { points, widest: BRIDGED.max(STEPS * step), step }
    }

    /// Angle (rad, rising) and deviation (mm) of each different angle.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Different angles there are.
    pub fn angles(&self) -> usize {
        self.points.len()
    }

    /// The mean step from an angle to the next, rad.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Beginning and width (rad) of each part of the circle that was not measured.
    fn gaps(&self) -> impl Iterator<Item = (f64, f64)> {
        let each = self.points.iter().enumerate().map(|(at, (a, _))| (*a, step_after(&self.points, at)));
        each.filter(|(_, width)| *width > self.widest)
    }

    /// How much of the circle was measured, rad.
    pub fn arc(&self) -> f64 {
        TAU - self.gaps().map(|(_, width)| width).sum::<f64>()
    }

    /// Whether all of it was.
    pub fn is_whole(&self) -> bool {
        self.gaps().next().is_none()
    }

    /// Whether everything from an angle on was, over a width, rad.
    pub fn covers(&self, from: f64, width: f64) -> bool {
        // As seen from a gap's beginning: not within it, and not going on into it.
        self.gaps().all(|(start, gap)| {
            let ahead = (from - start).rem_euclid(TAU);
            ahead >= gap && ahead + width <= TAU
        })
    }

    /// The deviation at an angle (rad), mm; none in a gap.
    pub fn at(&self, angle: f64) -> Option<f64> {
        let first = *self.points.first()?;
        let angle = first.0 + (angle - first.0).rem_euclid(TAU);
        let after = self.points.partition_point(|(a, _)| *a <= angle);
        let left = *self.points.get(after.checked_sub(1)?)?;
        if left.0 == angle {
            return Some(left.1);
        }
        let right = self.points.get(after).copied().unwrap_or((first.0 + TAU, first.1));
        let width = right.0 - left.0;
        (width <= self.widest).then(|| left.1 + (right.1 - left.1) * (angle - left.0) / width)
    }
}

/// From a point to the next one around the circle, rad; a whole turn from one alone.
fn step_after(points: &[(f64, f64)], at: usize) -> f64 {
    let angle = |at: usize| points.get(at).map(|(a, _)| *a);
    match (angle(at), angle(at + 1), angle(0)) {
        (Some(a), Some(next), _) => next - a,
        (Some(a), None, Some(first)) => first + TAU - a,
        _ => TAU,
    }
}
