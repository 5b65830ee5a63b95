//! The leading triangle of a factor: rank, back substitution, covariance.

use super::solution::dot;
use super::{Confounded, Factor, Real, Subset};

/// The first `E` columns of a factor, and what follows from them alone.
pub(super) struct Triangle<T, const E: usize> {
    pub d: [T; E],
    /// R, unit upper triangular; diagonal and below not read.
    pub r: [[T; E]; E],
    /// Squared norm of each column of the (weighted) design.
    pub norm2: [T; E],
}

impl<T: Real, const E: usize> Triangle<T, E> {
    pub fn leading<const P: usize>(factor: &Factor<T, P>) -> Self {
        const { assert!(E <= P) };
        let zero = T::zero();
        let (mut d, mut r, mut norm2) = ([zero; E], [[zero; E]; E], [zero; E]);
        for j in 0..E {
            d[j] = factor.dr[j][j];
            norm2[j] += d[j];
            for k in j + 1..E {
                let v = factor.dr[j][k];
                r[j][k] = v;
                norm2[k] += d[j] * v * v;
            }
        }
        Self { d, r, norm2 }
    }

    /// Whether the columns are independent, decided as if each had unit norm: the sine of the angle between a column and
    /// the span of those before it must exceed what rounding alone would leave. `inverse` is R⁻¹.
    pub fn independent(&self, inverse: &[[T; E]; E]) -> Result<(), Confounded<E>> {
        let least_sine = T::of(8.0) * T::of(E as f64) * T::epsilon();
        let is_independent = |k: usize| self.d[k] > least_sine * least_sine * self.norm2[k];
        let Some(pivot) = (0..E).find(|&k| !is_independent(k)) else {
            return Ok(());
        };
        // Column `pivot` is −Σ inverse[j][pivot]·column j: those whose part in it is over a thousandth take part.
        let share = T::of(1e-6) * self.norm2[pivot];
        let mut involved = [false; E];
        for j in 0..pivot {
            let part = inverse[j][pivot];
            involved[j] = part * part * self.norm2[j] > share;
        }
        involved[pivot] = true;
        let rank = (0..E).filter(|&k| is_independent(k)).count();
        Err(Confounded { pivot, involved: Subset::from_mask(involved), rank })
    }

    /// R⁻¹ v.
    pub fn back_substitute(&self, mut v: [T; E]) -> [T; E] {
        for j in (0..E).rev() {
            for k in j + 1..E {
                v[j] -= self.r[j][k] * v[k];
            }
        }
        v
    }

    /// R⁻¹, unit upper triangular.
    pub fn inverse(&self) -> [[T; E]; E] {
        let mut u = [[T::zero(); E]; E];
        for i in (0..E).rev() {
            u[i][i] = T::one();
            for k in i + 1..E {
                let r = self.r[i][k];
                for j in k..E {
                    u[i][j] -= r * u[k][j];
                }
            }
        }
        u
    }

    /// `variance · (X'WX)⁻¹ = variance · R⁻¹ D⁻¹ R⁻ᵀ`, given R⁻¹.
    pub fn covariance(&self, inverse: &[[T; E]; E], variance: T) -> [[T; E]; E] {
        let mut over_d = *inverse;
        for row in &mut over_d {
            for (v, &d) in row.iter_mut().zip(&self.d) {
                *v = *v / d * variance;
            }
        }
        let mut covariance = [[T::zero(); E]; E];
        for i in 0..E {
            for j in i..E {
                let v = dot(&over_d[i], &inverse[j]);
                covariance[i][j] = v;
                covariance[j][i] = v;
            }
        }
        covariance
    }
}
