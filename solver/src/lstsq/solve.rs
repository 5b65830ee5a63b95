//! From the factor to the estimate: all unknowns, or some with the others given.

use super::solution::dot;
use super::triangle::Triangle;
use super::{Factor, Real, Solution, SolveError};
use nalgebra::{SMatrix, SVector};

impl<T: Real, const P: usize> Factor<T, P> {
    /// The least-squares solution, its covariance from the residuals: `s² (X'WX)⁻¹`, `s² = rss / (n − P)`.
    ///
    /// # Errors
    /// [`SolveError::TooFewSamples`] unless there are more than `P`; [`SolveError::RankDeficient`], naming the
    /// coefficients, if the columns are dependent when scaled to unit norm (so the decision is free of units);
    /// [`SolveError::NotFinite`] if a result overflows.
    pub fn solve(&self) -> Result<Solution<T, P>, SolveError<P>> {
        self.need::<P>(1)?;
        self.estimate(self.q, self.rss, None, |_, _| {})
    }

    /// As [`solve`](Self::solve), with the standard deviation `sigma` of a sample of weight one known beforehand:
    /// covariance `sigma² (X'WX)⁻¹`. Needs only `P` samples.
    ///
    /// # Errors
    /// As [`solve`](Self::solve); [`SolveError::NotFinite`] also for a `sigma` that is not finite.
    pub fn solve_with_sigma(&self, sigma: T) -> Result<Solution<T, P>, SolveError<P>> {
        self.need::<P>(0)?;
        self.estimate(self.q, self.rss, Some(sigma * sigma), |_, _| {})
    }

    /// Estimates the first `E` coefficients with the last `K` given by another fit: `k` with covariance `cov_k`.
    /// This is the second step of the two-step estimator, on a factor that was filled with full rows `[e, k]`.
    ///
    /// With R, D and q split into the blocks of e and k, the least-squares solution for fixed k and its residuals are
    ///
    /// ```text
    /// e   = R_EE⁻¹ (q_E − R_EK k)
    /// rss = rss + (q_K − R_KK k)' D_K (q_K − R_KK k)
    /// ```
    ///
    /// and, e being linear in k with G = ∂e/∂k = −R_EE⁻¹ R_EK, the covariance of k carries over:
    /// `cov e = s² (E'WE)⁻¹ + G cov_k G'` with `E'WE = R_EE' D_E R_EE` and `s² = rss / (n − E)`. The two fits must not
    /// share samples. The columns of k need not be independent here.
    ///
    /// # Errors
    /// As [`solve`](Self::solve) for the first `E` columns; [`SolveError::NotFinite`] also for given values that are
    /// not finite.
    pub fn solve_given<const E: usize, const K: usize>(
        &self,
        k: &SVector<T, K>,
        cov_k: &SMatrix<T, K, K>,
    ) -> Result<Solution<T, E>, SolveError<E>> {
        const { assert!(E + K == P, "E unknown and K given coefficients must make up the factor's P") };
        self.need::<E>(1)?;
        let [k] = &k.data.0;
        let zero = T::zero();
        let (mut q, mut given, mut rss) = ([zero; E], [[zero; E]; K], self.rss);
        for (i, (row, &qi)) in self.dr.iter().zip(&self.q).enumerate() {
            let known = row.iter().enumerate().skip(E).zip(k);
            // R_KK is unit upper triangular; its diagonal place holds D.
            let rest = known.fold(qi, |rest, ((j, &r), &k)| match j {
                j if j < i => rest,
                j if j == i => rest - k,
                _ => rest - r * k,
            });
            match q.get_mut(i) {
                Some(q) => *q = rest,
                None => rss += row.get(i).map_or(zero, |&d| d * rest * rest),
            }
            for (given, &r) in given.iter_mut().zip(row.iter().skip(E)) {
                if let Some(given) = given.get_mut(i) {
                    *given = -r;
                }
            }
        }
        self.estimate(q, rss, None, |triangle, covariance| {
            let gain = given.map(|column| triangle.back_substitute(column));
            for (gain_l, column) in gain.iter().zip(&cov_k.data.0) {
                // Column l of G cov_k.
                let mut moved = [zero; E];
                for (gain_m, &c) in gain.iter().zip(column) {
                    for (sum, &g) in moved.iter_mut().zip(gain_m) {
                        *sum += g * c;
                    }
                }
                for (row, &a) in covariance.iter_mut().zip(&moved) {
                    for (v, &g) in row.iter_mut().zip(gain_l) {
                        *v += a * g;
                    }
                }
            }
        })
    }

    /// Whether there are at least `E + spare` samples.
    fn need<const E: usize>(&self, spare: usize) -> Result<(), SolveError<E>> {
        let (samples, needed) = (self.samples, E.saturating_add(spare));
        let enough = usize::try_from(samples).map_or(true, |samples| samples >= needed);
        if enough { Ok(()) } else { Err(SolveError::TooFewSamples { samples, needed }) }
    }

    /// Solution for the first `E` columns with right-hand side `q`; `widen` adds to the covariance.
    #[inline]
    fn estimate<const E: usize>(
        &self,
        q: [T; E],
        rss: T,
        variance: Option<T>,
        widen: impl FnOnce(&Triangle<T, E>, &mut [[T; E]; E]),
    ) -> Result<Solution<T, E>, SolveError<E>> {
        let triangle = Triangle::<T, E>::leading(self);
        let inverse = triangle.inverse();
        triangle.independent(&inverse).map_err(SolveError::RankDeficient)?;

        let degrees_of_freedom = self.samples.saturating_sub(u32::try_from(E).unwrap_or(u32::MAX));
        let residual_variance = match degrees_of_freedom {
            0 => T::zero(),
            dof => rss / T::of_count(dof),
        };
        let coefficients = triangle.back_substitute(q);
        let mut covariance = triangle.covariance(&inverse, variance.unwrap_or(residual_variance));
        widen(&triangle, &mut covariance);

        let zero = [T::zero(); E];
        let check = covariance.iter().fold(dot(&coefficients, &zero), |sum, row| sum + dot(row, &zero));
        if !(check + residual_variance).is_finite() {
            return Err(SolveError::NotFinite);
        }
        Ok(Solution {
            coefficients: SVector::from(coefficients),
            covariance: SMatrix::from(covariance),
            residual_std: residual_variance.sqrt(),
            degrees_of_freedom,
        })
    }
}
