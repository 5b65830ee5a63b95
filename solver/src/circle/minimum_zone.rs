//! The minimum-zone circle: two concentric circles that enclose all points, as near to each other as can be.

use super::{CircleError, CircleFit, Point, distance, exchange, extremes, least_squares};
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
        let Some(held) = exchange::take(points, contacts) else {
            return false;
        };
        let radii = held.map(|p| distance(&self.centre, &p));
        let on = |r: T, circle: T| (r - circle).abs() <= slack;
        let alternate = |a: T, b: T| on(radii[0], a) && on(radii[2], a) && on(radii[1], b) && on(radii[3], b);
        let turns = alternate(self.outer, self.inner) || alternate(self.inner, self.outer);
        enclosed && turns && exchange::in_turn(&self.centre, &held)
    }
}

/// The minimum-zone circle by exchange of contacts, from the least-squares circle.
///
/// A radius seen from a centre that moves a little changes by a sine and a cosine of the point's angle: the zone is a
/// Chebyshev approximation by 1, cos and sin, held by four points that alternate. Each step puts the point that violates
/// most in the place of the neighbour on its side; the centre is where the bisectors of the outer and of the inner
/// pair meet. The result is [checked](Zone::is_minimal) before it is given.
///
/// # Errors
/// [`CircleError`].
pub fn minimum_zone<T: Real>(points: &[Point<T>]) -> Result<Zone<T>, CircleError> {
    let fit = least_squares(points)?;
    let slack = T::of(64.0) * T::epsilon() * (fit.radii.1 + fit.circle.centre[0].abs() + fit.circle.centre[1].abs());
    if fit.roundness() <= slack {
        return Ok(round(&fit));
    }
    let zone = exchange::run(points, &fit.circle.centre, slack).ok_or(CircleError::NoConvergence)?;
    if zone.is_minimal(points, slack) { Ok(zone) } else { Err(CircleError::NoConvergence) }
}

/// Points on one circle.
fn round<T: Real>(fit: &CircleFit<T>) -> Zone<T> {
    Zone { centre: fit.circle.centre, inner: fit.radii.0, outer: fit.radii.1, contacts: None }
}
