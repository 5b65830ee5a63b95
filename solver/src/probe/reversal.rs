//! The paper's reversal: two touches with the spindle reversed, from where the ball was centred before.

use super::ProbeError;
use crate::Real;

/// What the paper's procedure (Fig. 4, 5) measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversal<T> {
    /// p1 = (x1, y1), mm: the spindle axis when the ball is in the ring's centre, found by touches both ways.
    pub centre: [T; 2],
    /// x2, mm: the touch towards +x with the spindle reversed, at y1.
    pub x: T,
    /// y3, mm: the touch towards +y with the spindle reversed, at x1.
    pub y: T,
    /// R_master − r_stylus, mm.
    pub radius: T,
}

impl<T: Real> Reversal<T> {
    /// The offset (ox, oy), mm: (8) solved exactly.
    ///
    /// With D = (x2 − x1, y3 − y1), ρ the radius and (X, Y) = 2o, (8) says that (X, Y) is on a circle of radius ρ about
    /// (D₁, 0) and on one about (0, D₂). Of the two places where these meet it is the one near zero.
    ///
    /// # Errors
    /// [`ProbeError::NotFinite`], [`ProbeError::Radius`], [`ProbeError::BeyondRing`].
    pub fn exact(&self) -> Result<[T; 2], ProbeError> {
        let [dx, dy] = self.checked()?;
        let half = T::of(0.5);
        let apart = dx.hypot(dy);
        let chord = half * apart;
        let height = self.radius * self.radius - chord * chord;
        if !(height >= T::zero() && apart > T::zero()) {
            return Err(ProbeError::BeyondRing);
        }
        let share = height.sqrt() / apart;
        Ok([half * (half * dx - share * dy), half * (half * dy - share * dx)])
    }

    /// The offset (ox, oy), mm, as if cos θ2 = sin θ3 = 1 (9): too small by o⊥²/ρ.
    pub fn small_angle(&self) -> [T; 2] {
        let [dx, dy] = self.differences();
        [T::of(0.5) * (dx - self.radius), T::of(0.5) * (dy - self.radius)]
    }

    /// Covariance of the exact offset, mm², from the standard deviations (mm) of one touch and of the radius.
    ///
    /// x1 and y1 are each the middle of two touches, so each difference carries 3/2 of a touch's variance; the radius
    /// shifts both.
    ///
    /// # Errors
    /// As [`exact`](Self::exact); [`ProbeError::BeyondRing`] also where (8) is singular.
    pub fn covariance(&self, touch: T, radius: T) -> Result<[[T; 2]; 2], ProbeError> {
        let [dx, dy] = self.differences();
        let two = T::of(2.0);
        let [x, y] = self.exact()?.map(|o| two * o);
        // (X − D₁) dX + Y dY = (X − D₁) dD₁ + ρ dρ and X dX + (Y − D₂) dY = (Y − D₂) dD₂ + ρ dρ.
        let (a, b) = (x - dx, y - dy);
        let determinant = a * b - x * y;
        let solve = |u: T, v: T| [(u * b - y * v) / determinant, (a * v - x * u) / determinant];
        let per_x = solve(a, T::zero());
        let per_y = solve(T::zero(), b);
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

    fn differences(&self) -> [T; 2] {
        [self.x - self.centre[0], self.y - self.centre[1]]
    }

    fn checked(&self) -> Result<[T; 2], ProbeError> {
        let [dx, dy] = self.differences();
        if !(dx.is_finite() && dy.is_finite() && self.radius.is_finite()) {
            return Err(ProbeError::NotFinite);
        }
        if self.radius <= T::zero() {
            return Err(ProbeError::Radius);
        }
        Ok([dx, dy])
    }
}
