//! The estimate and its uncertainty.

use super::Real;
use super::residual::Residual;
use nalgebra::{SMatrix, SVector};

/// Coefficients with their covariance. Every number in it is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<T, const P: usize> {
    /// Estimated coefficients, each in the unit of `y` over that of its regressor.
    pub coefficients: SVector<T, P>,
    /// Covariance of the coefficients.
    pub covariance: SMatrix<T, P, P>,
    /// Standard deviation of the residuals at weight one, `sqrt(rss / degrees_of_freedom)`, in the unit of `y`; zero if
    /// there are no degrees of freedom, which only a solve with known sigma allows.
    pub residual_std: T,
    /// Samples less coefficients estimated.
    pub degrees_of_freedom: u32,
}

impl<T: Real, const P: usize> Solution<T, P> {
    /// The solution, if every number of it is finite. The covariance is symmetric.
    #[inline(always)]
    pub(super) fn finite(coefficients: [T; P], covariance: [[T; P]; P], residual: Residual<T>) -> Option<Self> {
        let mut finite = T::all_finite(&coefficients) & residual.variance.is_finite();
        for (i, column) in covariance.iter().enumerate() {
            finite &= T::all_finite(column.get(i..).unwrap_or(column));
        }
        finite.then(|| Self {
            coefficients: SVector::from(coefficients),
            covariance: SMatrix::from(covariance),
            residual_std: residual.variance.sqrt(),
            degrees_of_freedom: residual.degrees_of_freedom,
        })
    }

    /// Standard deviation of each coefficient.
    pub fn std(&self) -> SVector<T, P> {
        let mut std = [T::zero(); P];
        for (i, (std, column)) in std.iter_mut().zip(&self.covariance.data.0).enumerate() {
            // Rounding can take a vanishing variance below zero.
            *std = column.get(i).map_or(T::zero(), |v| v.max(T::zero()).sqrt());
        }
        SVector::from(std)
    }

    /// Value of the linear functional `g · coefficients`; `None` if it is not finite.
    pub fn value_of(&self, g: &SVector<T, P>) -> Option<T> {
        let ([g], [x]) = (&g.data.0, &self.coefficients.data.0);
        Some(dot(g, x)).filter(|v| v.is_finite())
    }

    /// Variance of the linear functional `g · coefficients`, `g' C g`; `None` if it is not finite.
    pub fn variance_of(&self, g: &SVector<T, P>) -> Option<T> {
        let [g] = &g.data.0;
        let columns = self.covariance.data.0.iter().zip(g);
        let variance = columns.fold(T::zero(), |sum, (column, &gi)| sum + gi * dot(column, g));
        // Rounding can take a vanishing variance below zero.
        variance.is_finite().then(|| variance.max(T::zero()))
    }
}

/// Scalar product.
#[inline]
pub(super) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (&a, &b)| sum + a * b)
}
