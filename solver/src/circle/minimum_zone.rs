//! The minimum-zone circle: two concentric circles that enclose all points, as near to each other as can be.

use super::least_squares::placed;
use super::search::Cloud;
use super::{CircleError, CircleFit, Point, Zone, in_line, least_squares, slack};
use crate::Real;

/// The minimum-zone circle: of all pairs of concentric circles around the points, the two that are nearest to each other.
///
/// A zone that no move of the centre narrows is held by two points from outside and two from inside, in turn. Scattered points
/// have several such zones; all are looked at, not only the one next to the least-squares circle. Time grows with the
/// square of the number of points where they are near a circle, with its cube at worst.
///
/// # Errors
/// [`CircleError`]; [`CircleError::BetweenLines`] where the narrowest zone would have its centre at infinity, or beyond
/// what `T` holds; [`CircleError::NoConvergence`] where rounding hides it.
pub fn minimum_zone<T: Real>(points: &[Point<T>]) -> Result<Zone<T>, CircleError> {
    let (origin, scale) = placed(points)?;
    if in_line(points, slack(&origin, scale)) {
        return Err(CircleError::InLine);
    }
    let cloud = Cloud { points, origin, scale };
    let fit = least_squares(points);
    let zone = match &fit {
        Ok(fit) if fit.roundness() <= slack(&fit.circle.centre, fit.radii.1) => round(fit),
        _ => cloud.narrowest()?,
    };
    let Zone { centre: [x, y], inner, outer, .. } = zone;
    if !T::all_finite(&[x, y, inner, outer]) {
        return Err(CircleError::BetweenLines);
    }
    // Of points so far apart that the near ones lose their digits, the search may miss the narrowest.
    let bound = |fit: CircleFit<T>| fit.roundness() + T::of(4.0) * slack(&zone.centre, outer + scale);
    if fit.is_ok_and(|fit| zone.width() > bound(fit)) { Err(CircleError::NoConvergence) } else { Ok(zone) }
}

/// Points on one circle.
fn round<T: Real>(fit: &CircleFit<T>) -> Zone<T> {
    Zone { centre: fit.circle.centre, inner: fit.radii.0, outer: fit.radii.1, contacts: None }
}
