//! Two concentric circles around points, and the contacts that hold them.

use super::{Point, distance, extremes};
use crate::Real;

/// Concentric circles around the points, and the four points that hold them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone<T> {
    /// The common centre, mm.
    pub centre: Point<T>,
    /// The inner radius, mm.
    pub inner: T,
    /// The outer radius, mm.
    pub outer: T,
    /// Indices of four points by angle, in turn on the one and the other circle; none where all points are on one
    /// circle.
    pub contacts: Option<[usize; 4]>,
}

impl<T: Real> Zone<T> {
    /// Roundness deviation (RONt, minimum zone), mm.
    pub fn width(&self) -> T {
        self.outer - self.inner
    }

    /// Whether this zone meets the condition of a minimum: all points are within it, and its contacts alternate by
    /// angle between the outer and the inner circle (so that no move of the centre narrows it). `slack`, mm, is what
    /// counts as touching.
    pub fn is_minimal(&self, points: &[Point<T>], slack: T) -> bool {
        let (low, high) = extremes(points, &self.centre);
        let enclosed = low >= self.inner - slack && high <= self.outer + slack;
        let Some(contacts) = self.contacts else {
            return enclosed && self.width() <= slack;
        };
        let Some(held) = take(points, contacts) else {
            return false;
        };
        let radii = held.map(|p| distance(&self.centre, &p));
        let on = |r: T, circle: T| (r - circle).abs() <= slack;
        let alternate = |a: T, b: T| on(radii[0], a) && on(radii[2], a) && on(radii[1], b) && on(radii[3], b);
        let turns = alternate(self.outer, self.inner) || alternate(self.inner, self.outer);
        enclosed && turns && in_turn(&self.centre, &held)
    }
}

/// The points of four indices.
pub(super) fn take<T: Real>(points: &[Point<T>], at: [usize; 4]) -> Option<[Point<T>; 4]> {
    let [a, b, c, d] = at.map(|i| points.get(i).copied());
    Some([a?, b?, c?, d?])
}

/// Whether four points are met in turn when going round the centre once. One of the outer and one of the inner circle in the
/// same direction are in turn either way: no move of the centre brings them nearer to each other.
pub(super) fn in_turn<T: Real>(centre: &Point<T>, held: &[Point<T>; 4]) -> bool {
    let (turn, same) = (T::of(core::f64::consts::TAU), T::of(1e3) * T::epsilon());
    let first = angle(centre, &held[0]);
    let [_, b, c, d] = held.map(|p| ahead(first, angle(centre, &p)));
    let b = if b > turn - same { b - turn } else { b };
    let d = if d < same { d + turn } else { d };
    b >= -same && b <= c + same && c <= d + same
}

/// The direction of a point seen from a centre.
fn angle<T: Real>(centre: &Point<T>, point: &Point<T>) -> T {
    (point[1] - centre[1]).atan2(point[0] - centre[0])
}

/// How far an angle is ahead of another, in [0, 2π).
fn ahead<T: Real>(from: T, to: T) -> T {
    let turn = T::of(core::f64::consts::TAU);
    let ahead = (to - from) % turn;
    if ahead < T::zero() { ahead + turn } else { ahead }
}
