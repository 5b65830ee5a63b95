//! The variance that is left over.

use super::Real;

/// What the residuals say of the readings.
#[derive(Clone, Copy)]
pub(super) struct Residual<T> {
    /// Variance at weight one; zero if there are no degrees of freedom.
    pub variance: T,
    pub degrees_of_freedom: u32,
}

impl<T: Real> Residual<T> {
    /// Of `rss` over `samples` from which `n` coefficients were estimated.
    #[inline]
    pub fn new(rss: T, samples: u32, n: usize) -> Self {
        let degrees_of_freedom = samples.saturating_sub(u32::try_from(n).unwrap_or(u32::MAX));
        let variance = match degrees_of_freedom {
            0 => T::zero(),
            dof => rss / T::of_count(dof),
        };
        Self { variance, degrees_of_freedom }
    }
}
