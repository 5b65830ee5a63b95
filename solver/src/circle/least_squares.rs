//! The orthogonal least-squares circle.

use super::{Circle, CircleError, Point, distance, extremes, in_line, slack};
use crate::{Real, lstsq::Factor};
use nalgebra::{SMatrix, SVector};

/// Far more steps than points near a circle need.
const MOST: u32 = 200;

/// A circle fitted to points, the squares of whose radial deviations have the least sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleFit<T> {
    /// The circle.
    pub circle: Circle<T>,
    /// What the deviations say of it; nothing with three points, which any circle through them fits.
    pub scatter: Option<Scatter<T>>,
    /// Smallest and largest distance of a point from the centre, mm.
    pub radii: (T, T),
}

/// How far points scatter about their circle, and how well they so determine it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter<T> {
    /// Covariance of centre x, centre y and radius, mm².
    pub covariance: SMatrix<T, 3, 3>,
    /// Standard deviation of the radial deviations, `sqrt(Σd²/(n − 3))`, mm.
    pub residual_std: T,
}

impl<T: Real> CircleFit<T> {
    /// Roundness deviation from this circle (RONt, least squares), mm.
    pub fn roundness(&self) -> T {
        self.radii.1 - self.radii.0
    }
}

/// Fits a circle by Gauss–Newton on the radial deviations, from the circle whose equation fits best (Kåsa).
///
/// # Errors
/// [`CircleError`].
pub fn least_squares<T: Real>(points: &[Point<T>]) -> Result<CircleFit<T>, CircleError> {
    let (origin, scale) = placed(points)?;
    // Coordinates of order one about the points' middle: neither large offsets nor units cost digits.
    let local = |p: &Point<T>| [(p[0] - origin[0]) / scale, (p[1] - origin[1]) / scale];
    let straight = || if in_line(points, slack(&origin, scale)) { CircleError::InLine } else { CircleError::AlongLine };
    let mut circle = algebraic(points.iter().map(local))?.ok_or_else(straight)?;
    let mut last = T::infinity();
    for _ in 0..MOST {
        let linear = linearised(points.iter().map(local), &circle)?;
        let step = linear.solve_with_sigma(T::one()).map_err(|_| straight())?.coefficients;
        let size = step.dot(&step).sqrt();
        let reach = T::of(0.5) * circle.radius;
        let held = if size > reach { reach / size } else { T::one() };
        circle.centre = [circle.centre[0] + held * step.x, circle.centre[1] + held * step.y];
        circle.radius += held * step.z;
        if !(size.is_finite() && circle.radius > T::zero()) {
            return Err(CircleError::NoConvergence);
        }
        // Steps shrink until only rounding is left in them.
        let bound = T::epsilon() * (T::one() + circle.radius);
        if size <= bound || size <= T::of(64.0) * bound && size >= last {
            return finish(points, &circle, origin, scale)?.ok_or_else(straight);
        }
        last = size;
    }
    // Between both sides of a line steps may go on for ever, or to either.
    let squares = points.iter().map(|p| circle.deviation(&local(p))).fold(T::zero(), |sum, d| sum + d * d);
    Err(if off_line(points.iter().map(local)) < squares { straight() } else { CircleError::NoConvergence })
}

/// The sum of the squared distances of points, about the middle of whose extent coordinates are, from the line that is nearest to them.
fn off_line<T: Real>(points: impl Iterator<Item = Point<T>>) -> T {
    let (mut n, mut sums) = (T::zero(), [T::zero(); 5]);
    for [x, y] in points {
        n += T::one();
        sums.iter_mut().zip([x, y, x * x, y * y, x * y]).for_each(|(sum, value)| *sum += value);
    }
    let [x, y, xx, yy, xy] = sums;
    let half = T::of(0.5);
    let (xx, yy, xy) = (xx - x * x / n, yy - y * y / n, xy - x * y / n);
    half * (xx + yy) - (half * (xx - yy)).hypot(xy)
}

/// Middle and half extent of the points.
pub(super) fn placed<T: Real>(points: &[Point<T>]) -> Result<(Point<T>, T), CircleError> {
    if let Some(point) = points.iter().position(|[x, y]| !(x.is_finite() && y.is_finite())) {
        return Err(CircleError::NotFinite { point });
    }
    let [first, _, _, ..] = points else {
        return Err(CircleError::TooFewPoints { points: points.len() });
    };
    let half = T::of(0.5);
    let (mut low, mut high) = (*first, *first);
    for [x, y] in points {
        low = [low[0].min(*x), low[1].min(*y)];
        high = [high[0].max(*x), high[1].max(*y)];
    }
    let extent = [half * (high[0] - low[0]), half * (high[1] - low[1])];
    let scale = extent[0].max(extent[1]);
    let origin = [low[0] + extent[0], low[1] + extent[1]];
    if scale > T::zero() && scale.is_finite() { Ok((origin, scale)) } else { Err(CircleError::AllEqual) }
}

/// 2ax + 2by + c = x² + y²; none where all directions but one are lost in rounding.
fn algebraic<T: Real>(points: impl Iterator<Item = Point<T>>) -> Result<Option<Circle<T>>, CircleError> {
    let mut factor = Factor::<T, 3>::new();
    for [x, y] in points {
        let row = SVector::from([x + x, y + y, T::one()]);
        factor.push(&row, x * x + y * y).map_err(|_| CircleError::NoConvergence)?;
    }
    let Ok(estimate) = factor.solve_with_sigma(T::one()) else { return Ok(None) };
    let [a, b, c]: [T; 3] = estimate.coefficients.into();
    let square = c + a * a + b * b;
    Ok((square > T::zero()).then(|| Circle { centre: [a, b], radius: square.sqrt() }))
}

/// The radial deviations as changes of centre and radius would make them.
fn linearised<T: Real>(
    points: impl Iterator<Item = Point<T>>,
    circle: &Circle<T>,
) -> Result<Factor<T, 3>, CircleError> {
    let mut factor = Factor::<T, 3>::new();
    let [a, b] = circle.centre;
    for point in points {
        let r = distance(&circle.centre, &point);
        // A point on the centre pulls nowhere.
        let (u, v) = if r > T::zero() { ((point[0] - a) / r, (point[1] - b) / r) } else { (T::zero(), T::zero()) };
        let row = SVector::from([u, v, T::one()]);
        factor.push(&row, r - circle.radius).map_err(|_| CircleError::NoConvergence)?;
    }
    Ok(factor)
}

/// A circle that has settled, with its scatter; none where the points tell no direction from it.
fn finish<T: Real>(
    points: &[Point<T>],
    local: &Circle<T>,
    origin: Point<T>,
    scale: T,
) -> Result<Option<CircleFit<T>>, CircleError> {
    let centre = [origin[0] + scale * local.centre[0], origin[1] + scale * local.centre[1]];
    let circle = Circle { centre, radius: scale * local.radius };
    let factor = linearised(points.iter().copied(), &circle)?;
    let scatter = match factor.samples() {
        3 => None,
        _ => {
            let Ok(estimate) = factor.solve() else { return Ok(None) };
            Some(Scatter { covariance: estimate.covariance, residual_std: estimate.residual_std })
        }
    };
    let radii = extremes(points, &centre);
    Ok(Some(CircleFit { circle, scatter, radii }))
}
