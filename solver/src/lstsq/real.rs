//! The scalar: `f32` or `f64`, with or without the standard library.

use crate::trig;
use core::fmt::{Debug, Display};
use num_traits::{Float, NumAssign};

/// A floating-point scalar of the solver: `f32` or `f64`.
pub trait Real: Float + NumAssign + nalgebra::Scalar + Copy + Debug + Display {
    /// The value nearest to `x` (dimensionless). Never panics, unlike `NumCast::from(x).unwrap()`.
    fn of(x: f64) -> Self;

    /// The value nearest to a count of samples.
    fn of_count(n: u32) -> Self;

    /// Whether all values are finite, without floating-point arithmetic.
    fn all_finite(values: &[Self]) -> bool;

    /// The largest whole number not above a number of turns; NaN where half the digits of what is left over are lost.
    fn whole_turns(self) -> Self;

    /// Sine and cosine of an angle in rad, calculated in this type alone.
    fn sine_cosine(self) -> (Self, Self);
}

macro_rules! real {
    ($($t:ty, $sine_cosine:path;)*) => {$(
        impl Real for $t {
            #[inline]
            fn of(x: f64) -> Self {
                x as $t
            }

            #[inline]
            fn of_count(n: u32) -> Self {
                n as $t
            }

            #[inline]
            fn all_finite(values: &[Self]) -> bool {
                let largest = values.iter().fold(0, |largest, v| v.abs().to_bits().max(largest));
                largest < <$t>::INFINITY.to_bits()
            }

            #[inline]
            fn whole_turns(self) -> Self {
                const MOST: $t = (1_u32 << (<$t>::MANTISSA_DIGITS / 2)) as $t;
                // A comparison with NaN is false.
                if self.abs() < MOST { Float::floor(self) } else { <$t>::NAN }
            }

            #[inline]
            fn sine_cosine(self) -> (Self, Self) {
                $sine_cosine(self)
            }
        }
    )*};
}
real! {
    f32, trig::sin_cos;
    f64, Float::sin_cos;
}
