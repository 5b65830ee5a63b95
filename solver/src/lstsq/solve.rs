//! From the factor to the estimate of all unknowns.

use super::residual::Residual;
use super::triangle::Triangle;
use super::{Factor, Real, Solution, SolveError};
use nalgebra::SVector;

impl<T: Real, const P: usize> Factor<T, P> {
    /// The least-squares solution, its covariance from the residuals: `s² (X'WX)⁻¹`, `s² = rss / (n − P)`.
    ///
    /// # Errors
    /// [`SolveError::TooFewSamples`] unless there are more than `P`; [`SolveError::RankDeficient`], naming the
    /// coefficients, if the columns are dependent when scaled to unit norm (so the decision is free of units);
    /// [`SolveError::NotFinite`] if a result overflows.
    pub fn solve(&self) -> Result<Solution<T, P>, SolveError<P>> {
        self.estimate(P, None)
    }

    /// As [`solve`](Self::solve), with the standard deviation `sigma` of a sample of weight one known beforehand:
    /// covariance `sigma² (X'WX)⁻¹`. Needs only `P` samples.
    ///
    /// # Errors
    /// As [`solve`](Self::solve); [`SolveError::NotFinite`] also for a `sigma` that is not finite.
    pub fn solve_with_sigma(&self, sigma: T) -> Result<Solution<T, P>, SolveError<P>> {
        self.estimate(P, Some(sigma * sigma))
    }

    /// The coefficients of [`solve_with_sigma`](Self::solve_with_sigma) alone, in a fraction of its time.
    ///
    /// # Errors
    /// As [`solve_with_sigma`](Self::solve_with_sigma).
    pub fn coefficients(&self) -> Result<SVector<T, P>, SolveError<P>> {
        self.coefficients_of_first(P).map(SVector::from)
    }

    /// The same for the first `n` unknowns, as if there were no others; zero beyond them.
    pub(crate) fn coefficients_of_first(&self, n: usize) -> Result<[T; P], SolveError<P>> {
        let triangle = Triangle::leading(self, n);
        triangle.determined(Some(T::one()))?;
        let coefficients = triangle.back_substitute(self.q);
        if T::all_finite(&coefficients) { Ok(coefficients) } else { Err(SolveError::NotFinite) }
    }

    /// The estimate of the first `n` unknowns of a factor whose other columns are zero; the result is zero beyond them.
    #[inline]
    pub(crate) fn estimate(&self, n: usize, variance: Option<T>) -> Result<Solution<T, P>, SolveError<P>> {
        let triangle = Triangle::leading(self, n);
        triangle.determined(variance)?;
        let mut covariance = triangle.inverse();
        let residual = Residual::new(self.rss, self.samples, n);
        triangle.covariance(&mut covariance, variance.unwrap_or(residual.variance));
        Solution::finite(triangle.back_substitute(self.q), covariance, residual).ok_or(SolveError::NotFinite)
    }
}
