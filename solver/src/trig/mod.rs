//! Sine and cosine for generated regressors.
//!
//! `libm` works out a sine of `f32` in `f64`, which a processor with single-precision hardware emulates: some 2,000
//! instructions on a Cortex-M4F, more than all the rest of a sample. The one here stays in `f32` and takes about fifty.

mod single;

use crate::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// What a generated regressor asks of a number; in the place of `num_traits::Float` there.
pub trait Float:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Sine and cosine of an angle in rad; NaN where there is none.
    fn sin_cos(self) -> (Self, Self);
}

impl<T: Real> Float for T {
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        self.sine_cosine()
    }
}

pub use num_traits::{AsPrimitive, FloatConst};

pub(crate) use single::sin_cos;
