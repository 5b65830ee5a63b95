//! The minimum-zone circle: two concentric circles that enclose all points, as near to each other as can be.

use super::{CircleError, CircleFit, Point, Zone, exchange, least_squares};
use crate::Real;

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
