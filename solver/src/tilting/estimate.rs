//! ε_xa from its fitted coefficients.

use super::regressors;
use crate::Real;
use crate::lstsq::{Solution, student_t_95};
use nalgebra::SVector;
use num_traits::{AsPrimitive, FloatConst};

/// Number of coefficients of ε_xa, eq. (10); they come first in every solution here.
pub const FUNCTION: usize = 2;

/// The estimate of all base parameters, in the order of [`regressors::NAMES`].
pub type JointEstimate<T> = Estimate<T, { regressors::NAMES.len() }>;

/// A solution whose first [`FUNCTION`] coefficients are those of ε_xa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<T, const P: usize> {
    /// Coefficients, covariance, residual standard deviation (mm).
    pub solution: Solution<T, P>,
    pub(super) radius: T,
}

impl<T: Real + FloatConst, const P: usize> Estimate<T, P>
where
    f64: AsPrimitive<T>,
{
    /// The bar's nominal length, mm.
    pub fn radius(&self) -> T {
        self.radius
    }

    /// ε_xa at the angle `a` and its standard deviation, rad; `None` if they are not finite, as at an angle that is not.
    pub fn eps_xa(&self, a: T) -> Option<(T, T)> {
        let basis = regressors::e_xa(self.radius, a);
        let mut g = SVector::<T, P>::zeros();
        for (g, b) in g.iter_mut().zip(basis) {
            *g = b;
        }
        Some((self.solution.value_of(&g)?, self.solution.variance_of(&g)?.sqrt()))
    }

    /// Half width of the 95 % band of ε_xa at the angle `a`, rad; `None` if it is not finite.
    pub fn band(&self, a: T) -> Option<T> {
        let band = student_t_95::<T>(self.solution.degrees_of_freedom) * self.eps_xa(a)?.1;
        Some(band).filter(|band| band.is_finite())
    }
}
