//! The scalar: `f32` or `f64`, with or without the standard library, or `DoubleDouble`.

use crate::trig;
use core::fmt::{Debug, Display};
use num_traits::{Float, NumAssign};

/// A floating-point scalar of the solver: `f32`, `f64`, or `DoubleDouble` of the feature `double-double`.
pub trait Real: Float + NumAssign + nalgebra::Scalar + Copy + Debug + Display {
    /// Weights and squares of columns below this count as zero: what is divided by them stays within the range of the type.
    /// A power of two; so is its inverse, the largest weight.
    const LEAST: Self;
    /// The most that `weight · (|row|² + y²)` of one sample may be: 2³² of them are still within the range, also divided by
    /// [`LEAST`](Self::LEAST).
    const MOST: Self;

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

    /// [`sine_cosine`](Self::sine_cosine) up to a last place, where a type has one that a loop over many angles becomes vector
    /// instructions of; that may have no numbers for an angle that is far from zero.
    #[inline(always)]
    fn near_sine_cosine(self) -> (Self, Self) {
        self.sine_cosine()
    }
}

macro_rules! real {
    ($($t:ty, $least:expr, $most:expr, $sine_cosine:path, $near:path;)*) => {$(
        impl Real for $t {
            const LEAST: Self = $least;
            const MOST: Self = $most;

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

            #[inline(always)]
            fn near_sine_cosine(self) -> (Self, Self) {
                $near(self)
            }
        }
    )*};
}
// 2⁻¹⁰⁰ and 2⁹⁰, 2⁻⁸⁰⁰ and 2⁸⁰⁰: an exponent and a mantissa of one.
real! {
    f32, f32::from_bits((127 - 100) << 23), f32::from_bits((127 + 90) << 23), trig::sin_cos, trig::sin_cos;
    f64, f64::from_bits((1023 - 800) << 52), f64::from_bits((1023 + 800) << 52), Float::sin_cos, trig::double::near_sine_cosine;
}
