//! The minimum-zone circle: two concentric circles that enclose all points, as near to each other as can be.

use super::least_squares::placed;
use super::search::Cloud;
use super::{CircleError, CircleFit, Point, Zone, least_squares};
use crate::Real;

/// The minimum-zone circle: of all pairs of concentric circles around the points, the two that are nearest to each other.
///
/// A zone that no move of the centre narrows is held by two points from outside and two from inside, in turn. Scattered points
/// have several such zones; all are looked at, not only the one next to the least-squares circle. Time grows with the
/// square of the number of points where they are near a circle, with its cube at worst.
///
/// # Errors
/// [`CircleError`]; [`CircleError::BetweenLines`] where the narrowest zone would have its centre at infinity, or beyond
/// what `T` holds.
pub fn minimum_zone<T: Real>(points: &[Point<T>]) -> Result<Zone<T>, CircleError> {
    let (origin, scale) = placed(points)?;
    let cloud = Cloud { points, origin, scale };
    let zone = match least_squares(points) {
        Ok(fit) if fit.roundness() <= slack(&fit) => round(&fit),
        Err(CircleError::InLine) => return Err(CircleError::InLine),
        _ => cloud.narrowest()?,
    };
    let Zone { centre: [x, y], inner, outer, .. } = zone;
    if T::all_finite(&[x, y, inner, outer]) { Ok(zone) } else { Err(CircleError::BetweenLines) }
}

/// What rounding leaves of radii.
fn slack<T: Real>(fit: &CircleFit<T>) -> T {
    T::of(64.0) * T::epsilon() * (fit.radii.1 + fit.circle.centre[0].abs() + fit.circle.centre[1].abs())
}

/// Points on one circle.
fn round<T: Real>(fit: &CircleFit<T>) -> Zone<T> {
    Zone { centre: fit.circle.centre, inner: fit.radii.0, outer: fit.radii.1, contacts: None }
}
