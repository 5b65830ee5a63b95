//! The paper's reversal: two touches with the spindle reversed, from where the ball was centred before.

use super::ProbeError;
use crate::Real;

/// What the paper's procedure (Fig. 4, 5) measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversal<T> {
    /// p1 = (x1, y1), mm: the spindle axis when the ball is in the ring's centre, found by touches both ways.
    pub centre: [T; 2],
    /// p2 = (x2, y2), mm: the touch towards +x with the spindle reversed; the paper's y2 is y1.
    pub x: [T; 2],
    /// p3 = (x3, y3), mm: the touch towards +y with the spindle reversed; the paper's x3 is x1.
    pub y: [T; 2],
    /// R_master − r_stylus, mm.
    pub radius: T,
}

impl<T: Real> Reversal<T> {
    /// The offset (ox, oy), mm: E(8) solved exactly.
    ///
    /// With ρ the radius, E(8) says that 2o is on a circle of radius ρ about p2 − p1 and on one about p3 − p1. Of the two
    /// places where these meet it is the one near zero.
    ///
    /// # Errors
    /// [`ProbeError::NotFinite`], also where a square of a length overflows; [`ProbeError::Radius`],
    /// [`ProbeError::BeyondRing`].
    pub fn exact(&self) -> Result<[T; 2], ProbeError> {
        let [[ax, ay], [bx, by]] = self.checked()?;
        let half = T::of(0.5);
        let (ex, ey) = (bx - ax, by - ay);
        let apart = ex.hypot(ey);
        let chord = half * apart;
        let height = self.radius * self.radius - chord * chord;
        if !(height >= T::zero() && apart > T::zero()) {
            return Err(ProbeError::BeyondRing);
        }
        let share = height.sqrt() / apart;
        let offset = [half * (half * (ax + bx) - share * ey), half * (half * (ay + by) + share * ex)];
        if T::all_finite(&offset) { Ok(offset) } else { Err(ProbeError::NotFinite) }
    }

    /// The offset (ox, oy), mm, as if cos θ2 = sin θ3 = 1, E(9): too small by o⊥²/ρ.
    pub fn small_angle(&self) -> [T; 2] {
        let [[dx, _], [_, dy]] = self.differences();
        [T::of(0.5) * (dx - self.radius), T::of(0.5) * (dy - self.radius)]
    }

    /// Covariance of the exact offset, mm², from the standard deviations (mm) of one touch and of the radius.
    ///
    /// x1 and y1 are each the middle of two touches, so each difference carries 3/2 of a touch's variance; the radius
    /// shifts both.
    ///
    /// # Errors
    /// As [`exact`](Self::exact); [`ProbeError::BeyondRing`] also where E(8) is singular.
    pub fn covariance(&self, touch: T, radius: T) -> Result<[[T; 2]; 2], ProbeError> {
        let [[ax, ay], [bx, by]] = self.differences();
        let two = T::of(2.0);
        let [x, y] = self.exact()?.map(|o| two * o);
        // With a = p2 − p1 and b = p3 − p1: (2o − a)·d(2o) = (X − a₁) da₁ + ρ dρ and (2o − b)·d(2o) = (Y − b₂) db₂ + ρ dρ.
        let ((p, q), (r, s)) = ((x - ax, y - ay), (x - bx, y - by));
        let determinant = p * s - q * r;
        let solve = |u: T, v: T| [(u * s - q * v) / determinant, (p * v - r * u) / determinant];
        let per_x = solve(p, T::zero());
        let per_y = solve(T::zero(), s);
        let per_radius = solve(self.radius, self.radius);
        let difference = T::of(1.5) * touch * touch;
        let part = |g: [T; 2], variance: T, i: usize, j: usize| variance * [g[0], g[1]][i] * [g[0], g[1]][j];
        let entry = |i, j| {
            let sum = part(per_x, difference, i, j) + part(per_y, difference, i, j);
            (sum + part(per_radius, radius * radius, i, j)) * T::of(0.25)
        };
        let covariance = [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
        let finite = covariance.iter().flatten().all(|v| v.is_finite());
        if finite { Ok(covariance) } else { Err(ProbeError::BeyondRing) }
    }

    fn differences(&self) -> [[T; 2]; 2] {
        [self.x, self.y].map(|[x, y]| [x - self.centre[0], y - self.centre[1]])
    }

    fn checked(&self) -> Result<[[T; 2]; 2], ProbeError> {
        let differences = self.differences();
        if !(differences.iter().flatten().all(|d| d.is_finite()) && self.radius.is_finite()) {
            return Err(ProbeError::NotFinite);
        }
        if self.radius <= T::zero() {
            return Err(ProbeError::Radius);
        }
        Ok(differences)
    }
}
