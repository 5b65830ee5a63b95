//! The leading triangle of a factor: rank, back substitution, covariance.

use super::solution::dot;
use super::{Confounded, Factor, Real, SolveError, Subset};

/// The first `n` of a factor's columns, and what follows from them alone. Matrices and vectors have the factor's width and
/// zeros beyond `n`.
#[derive(Clone, Copy)]
pub(super) struct Triangle<'a, T, const P: usize> {
    factor: &'a Factor<T, P>,
    n: usize,
}

impl<'a, T: Real, const P: usize> Triangle<'a, T, P> {
    #[inline]
    pub fn leading(factor: &'a Factor<T, P>, n: usize) -> Self {
        Self { factor, n: n.min(P) }
    }

    /// R⁻¹, unit upper triangular.
    #[inline]
    pub fn inverse(&self) -> [[T; P]; P] {
        let n = self.n.min(P);
        let mut u = [[T::zero(); P]; P];
        for i in (0..n).rev() {
            u[i][i] = T::one();
            for k in i + 1..n {
                let r = self.factor.dr[i][k];
                for j in k..n {
                    u[i][j] -= r * u[k][j];
                }
            }
        }
        u
    }

    /// Whether the samples determine the coefficients: there are enough, also for a residual if no `variance` is known, and
    /// the columns are independent: the sine of the angle between each and the span of those before it exceeds what rounding alone would leave.
    /// `inverse` is R⁻¹.
    pub fn determined(&self, inverse: &[[T; P]; P], variance: Option<T>) -> Result<(), SolveError<P>> {
        let (samples, needed) = (self.factor.samples, self.n.saturating_add(usize::from(variance.is_none())));
        if usize::try_from(samples).is_ok_and(|samples| samples < needed) {
            return Err(SolveError::TooFewSamples { samples, needed });
        }
        self.independent(inverse).map_err(SolveError::RankDeficient)
    }

    pub fn independent(&self, inverse: &[[T; P]; P]) -> Result<(), Confounded<P>> {
        let (n, norm2) = (self.n.min(P), squared_norms(self.factor));
        let least_sine = T::of(8.0) * T::of_count(u32::try_from(n).unwrap_or(u32::MAX)) * T::epsilon();
        let is_independent = |k: usize| self.factor.dr[k][k] > least_sine * least_sine * norm2[k];
        let Some(pivot) = (0..n).find(|&k| !is_independent(k)) else {
            return Ok(());
        };
        // Column `pivot` is −Σ inverse[j][pivot]·column j: those whose part in it is over a thousandth take part.
        let share = T::of(1e-6) * norm2[pivot];
        let mut involved = [false; P];
        for j in 0..pivot {
            let part = inverse[j][pivot];
            involved[j] = part * part * norm2[j] > share;
        }
        involved[pivot] = true;
        let rank = (0..n).filter(|&k| is_independent(k)).count();
        Err(Confounded { pivot, involved: Subset::from_mask(involved), rank, columns: n })
    }

    /// R⁻¹ v.
    #[inline]
    pub fn back_substitute(&self, mut v: [T; P]) -> [T; P] {
        let n = self.n.min(P);
        for j in (0..n).rev() {
            for k in j + 1..n {
                v[j] -= self.factor.dr[j][k] * v[k];
            }
        }
        v[n..].fill(T::zero());
        v
    }

    /// `variance · (X'WX)⁻¹ = variance · R⁻¹ D⁻¹ R⁻ᵀ`, given R⁻¹.
    #[inline]
    pub fn covariance(&self, inverse: &[[T; P]; P], variance: T) -> [[T; P]; P] {
        let n = self.n.min(P);
        let mut over_d = *inverse;
        for row in over_d.iter_mut().take(n) {
            for (k, v) in row.iter_mut().enumerate().take(n) {
                *v = *v / self.factor.dr[k][k] * variance;
            }
        }
        let mut covariance = [[T::zero(); P]; P];
        for i in 0..n {
            for j in i..n {
                let v = dot(&over_d[i], &inverse[j]);
                covariance[i][j] = v;
                covariance[j][i] = v;
            }
        }
        covariance
    }
}

/// Squared norm of each column of the (weighted) design.
#[inline]
pub(super) fn squared_norms<T: Real, const P: usize>(factor: &Factor<T, P>) -> [T; P] {
    let mut norm2 = [T::zero(); P];
    for j in 0..P {
        let d = factor.dr[j][j];
        norm2[j] += d;
        for k in j + 1..P {
            let v = factor.dr[j][k];
            norm2[k] += d * v * v;
        }
    }
    norm2
}
