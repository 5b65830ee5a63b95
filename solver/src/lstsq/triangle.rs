//! The leading triangle of a factor: rank, back substitution, covariance.

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
    pub fn inverse(self) -> [[T; P]; P] {
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
    pub fn determined(self, variance: Option<T>) -> Result<(), SolveError<P>> {
        let (samples, needed) = (self.factor.samples, self.n.saturating_add(usize::from(variance.is_none())));
        if usize::try_from(samples).is_ok_and(|samples| samples < needed) {
            return Err(SolveError::TooFewSamples { samples, needed });
        }
        self.independent().map_err(SolveError::RankDeficient)
    }

    pub fn independent(self) -> Result<(), Confounded<P>> {
        let (n, norm2) = (self.n.min(P), self.squared_norms());
        let least_sine = T::of(8.0) * T::of_count(u32::try_from(n).unwrap_or(u32::MAX)) * T::epsilon();
        let least = norm2.map(|norm2| least_sine * least_sine * norm2);
        for k in 0..n {
            if self.factor.d(k) <= least[k] {
                return Err(self.confounded(k, &norm2, &least));
            }
        }
        Ok(())
    }

    /// Column `pivot` is −Σ R⁻¹[j][pivot]·column j: those whose part in it is over a thousandth take part.
    #[cold]
    fn confounded(self, pivot: usize, norm2: &[T; P], least: &[T; P]) -> Confounded<P> {
        let inverse = self.inverse();
        let of_pivot = |row: &[T; P]| row.get(pivot).copied().unwrap_or(T::zero());
        let share = T::of(1e-6) * of_pivot(norm2);
        let mut involved = [false; P];
        for (j, ((involved, row), &norm2)) in involved.iter_mut().zip(&inverse).zip(norm2).enumerate() {
            let part = of_pivot(row);
            *involved = j == pivot || (j < pivot && part * part * norm2 > share);
        }
        let rank = least.iter().enumerate().take(self.n).filter(|(k, least)| self.factor.d(*k) > **least).count();
        Confounded { pivot, involved: Subset::from_mask(involved), rank, columns: self.n }
    }

    /// R⁻¹ v.
    #[inline]
    pub fn back_substitute(self, mut v: [T; P]) -> [T; P] {
        let n = self.n.min(P);
        for j in (0..n).rev() {
            for k in j + 1..n {
                v[j] -= self.factor.dr[j][k] * v[k];
            }
        }
        v[n..].fill(T::zero());
        v
    }

    /// Makes `variance · (X'WX)⁻¹ = variance · R⁻¹ D⁻¹ R⁻ᵀ` of R⁻¹.
    #[inline]
    pub fn covariance(self, inverse: &mut [[T; P]; P], variance: T) {
        let n = self.n.min(P);
        // A row of the result needs that row of R⁻¹ and those below it, which are still there.
        for i in 0..n {
            let mut over_d = inverse[i];
            for k in i..n {
                over_d[k] = over_d[k] * self.factor.dr[k][k] * variance;
            }
            for j in i..n {
                inverse[i][j] = over_d.iter().zip(&inverse[j]).take(n).fold(T::zero(), |sum, (&a, &b)| sum + a * b);
            }
        }
        for i in 0..n {
            for j in 0..i {
                inverse[i][j] = inverse[j][i];
            }
        }
    }

    /// Squared norm of each column of the (weighted) design.
    #[inline]
    pub fn squared_norms(self) -> [T; P] {
        let n = self.n.min(P);
        let mut norm2 = [T::zero(); P];
        for j in 0..n {
            let d = self.factor.d(j);
            norm2[j] += d;
            for k in j + 1..n {
                let v = self.factor.dr[j][k];
                norm2[k] += d * v * v;
            }
        }
        norm2
    }
}
