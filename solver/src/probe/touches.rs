//! Any touches in a ring, at any spindle angles.

use super::{ProbeError, ball};
use crate::{Real, lstsq::Factor, lstsq::SolveError};
use nalgebra::{SMatrix, SVector};

/// Offset, centre and radius.
const UNKNOWN: usize = 5;

/// Standard deviations of a touch up to which an offset's own counts as told; the paper's touches tell it to 0.5.
const TOLD: f64 = 20.0;

/// Far more steps than touches near a circle need.
const MOST: u32 = 50;

/// A touch of the ring's inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch<T> {
    /// The spindle axis, mm.
    pub position: [T; 2],
    /// How far the probe is turned from its orientation at home: s − φ, rad.
    pub turned: T,
}

/// The offset that fits touches best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetFit<T> {
    /// (ox, oy), mm.
    pub offset: [T; 2],
    /// The ring's centre, mm.
    pub centre: [T; 2],
    /// R_master − r_stylus as it was met, mm.
    pub radius: T,
    /// Covariance of ox, oy, centre x, centre y and radius, mm².
    pub covariance: SMatrix<T, UNKNOWN, UNKNOWN>,
    /// Standard deviation of the residuals, mm; none where five touches leave no residual.
    pub residual_std: Option<T>,
}

/// Fits |pᵢ + Rot(turnedᵢ)·o − c| = ρ for the offset o, the centre c and the radius ρ: E(8) for all touches together,
/// without an approximation. `sigma` is the standard deviation of one touch, mm, for the covariance.
///
/// # Errors
/// [`ProbeError`]: at least five touches, in several directions and with the spindle turned between them, so that the
/// offset's standard deviation is at most 20 times a touch's.
pub fn offset<T: Real>(touches: &[Touch<T>], sigma: T) -> Result<OffsetFit<T>, ProbeError> {
    let n = T::of_count(u32::try_from(touches.len()).unwrap_or(u32::MAX));
    let sum = touches.iter().fold([T::zero(); 2], |s, t| [s[0] + t.position[0], s[1] + t.position[1]]);
    let mut offset = [T::zero(); 2];
    let mut centre = sum.map(|s| s / n);
    let mut radius = touches.iter().map(|t| apart(t.position, centre).0).fold(T::zero(), |sum, r| sum + r / n);
    let scale = radius;
    for _ in 0..MOST {
        let factor = linearised(touches, offset, centre, radius)?;
        let solved = factor.solve_with_sigma(T::one()).map_err(|e| match e {
            SolveError::TooFewSamples { needed, .. } => ProbeError::TooFewTouches { touches: touches.len(), needed },
            SolveError::RankDeficient(_) => ProbeError::NotSeparated,
            SolveError::NotFinite => ProbeError::NotFinite,
        })?;
        let [dox, doy, dx, dy, dr]: [T; UNKNOWN] = solved.coefficients.into();
        offset = [offset[0] + dox, offset[1] + doy];
        centre = [centre[0] + dx, centre[1] + dy];
        radius += dr;
        let size = solved.coefficients.dot(&solved.coefficients).sqrt();
        if size <= T::of(64.0) * T::epsilon() * (scale + centre[0].abs() + centre[1].abs()) {
            let unit = solved.covariance;
            let told = T::of(TOLD * TOLD);
            if unit.diagonal().iter().take(2).any(|variance| *variance > told) {
                return Err(ProbeError::NotSeparated);
            }
            let covariance = unit.map(|v| v * sigma * sigma);
            if !T::all_finite(covariance.as_slice()) {
                return Err(ProbeError::NotFinite);
            }
            let residual_std = factor.solve().ok().map(|fit| fit.residual_std);
            return Ok(OffsetFit { offset, centre, radius, covariance, residual_std });
        }
    }
    Err(ProbeError::NoConvergence)
}

/// Distance and direction of a point from another.
fn apart<T: Real>(p: [T; 2], from: [T; 2]) -> (T, [T; 2]) {
    let (x, y) = (p[0] - from[0], p[1] - from[1]);
    let r = x.hypot(y);
    (r, if r > T::zero() { [x / r, y / r] } else { [T::zero(); 2] })
}

fn linearised<T: Real>(
    touches: &[Touch<T>],
    offset: [T; 2],
    centre: [T; 2],
    radius: T,
) -> Result<Factor<T, UNKNOWN>, ProbeError> {
    let mut factor = Factor::new();
    for touch in touches {
        let (s, c) = touch.turned.sin_cos();
        let (r, [u, v]) = apart(ball(touch.position, touch.turned, offset), centre);
        let row = SVector::from([u * c + v * s, v * c - u * s, -u, -v, -T::one()]);
        factor.push(&row, radius - r).map_err(|_| ProbeError::NotFinite)?;
    }
    Ok(factor)
}
