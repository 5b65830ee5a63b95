//! Circles through probed points: least squares and minimum zone (ISO 12181), and the roundness from either.
//!
//! ```
//! use trunnion_solver::circle::{least_squares, minimum_zone};
//!
//! let points = [[1.0_f64, 7.0], [2.0, 6.0], [5.0, 8.0], [7.0, 7.0], [9.0, 5.0], [3.0, 7.0]];
//! let fit = least_squares(&points)?;
//! assert!((fit.circle.radius - 4.714_226_037_792).abs() < 1e-11);
//! let zone = minimum_zone(&points)?;
//! assert!(zone.width() < fit.roundness());
//! # Ok::<(), trunnion_solver::circle::CircleError>(())
//! ```

mod error;
mod least_squares;
mod minimum_zone;
mod search;
mod zone;

use crate::Real;

pub use error::CircleError;
pub use least_squares::{CircleFit, Scatter, least_squares};
pub use minimum_zone::minimum_zone;
pub use zone::Zone;

/// A point in the plane, mm.
pub type Point<T> = [T; 2];

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle<T> {
    /// Its centre, mm.
    pub centre: Point<T>,
    /// Its radius, mm.
    pub radius: T,
}

impl<T: Real> Circle<T> {
    /// Radial deviation of a point: its distance from the centre less the radius, mm.
    pub fn deviation(&self, point: &Point<T>) -> T {
        distance(&self.centre, point) - self.radius
    }
}

pub(crate) fn distance<T: Real>([a, b]: &Point<T>, [x, y]: &Point<T>) -> T {
    (*x - *a).hypot(*y - *b)
}

/// Smallest and largest distance from a centre.
fn extremes<T: Real>(points: &[Point<T>], centre: &Point<T>) -> (T, T) {
    points
        .iter()
        .map(|p| distance(centre, p))
        .fold((T::infinity(), T::zero()), |(low, high), r| (low.min(r), high.max(r)))
}

/// What rounding leaves of radii.
fn slack<T: Real>([x, y]: &Point<T>, radius: T) -> T {
    T::of(64.0) * T::epsilon() * (radius + x.abs() + y.abs())
}

/// Whether all points are on the line through two that are far apart.
fn in_line<T: Real>(points: &[Point<T>], slack: T) -> bool {
    let farthest = |from: &Point<T>| {
        let farther = |a: Point<T>, b: &Point<T>| if distance(from, b) > distance(from, &a) { *b } else { a };
        points.iter().fold(*from, farther)
    };
    let Some(first) = points.first() else { return true };
    let one = farthest(first);
    let other = farthest(&one);
    let length = distance(&one, &other);
    let (x, y) = ((other[0] - one[0]) / length, (other[1] - one[1]) / length);
    points.iter().all(|p| ((p[0] - one[0]) * y - (p[1] - one[1]) * x).abs() <= slack)
}
