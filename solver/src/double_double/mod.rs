//! Numbers of two `f64`, for who calibrates the method itself: feature `double-double`.
//!
//! ```
//! use nalgebra::vector;
//! use trunnion_solver::{DoubleDouble, lstsq::Factor};
//!
//! let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
//! let mut mean = Factor::<DoubleDouble, 1>::new();
//! mean.push(&vector![DoubleDouble::from(1.0)], third)?;
//! mean.push(&vector![DoubleDouble::from(1.0)], third)?;
//! let error = mean.solve()?.coefficients[0] - third;
//! assert!(error.high().abs() < 1e-31);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod elementary;
mod float;
mod text;

use crate::lstsq::Real;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign};
use num_traits::Float;

/// The sum of two `f64`, the second at most half the last bit of the first: 106 bits, about 31 digits.
///
/// A result of `+ − × ÷ √` is wrong by at most 2⁻¹⁰² of itself (Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44, 2017, and
/// Lefèvre et al., ACM Trans. Math. Softw. 49, 2023), as long as operands and result are between 2⁻⁹⁰⁰ and 2⁹⁰⁰ in magnitude; beyond,
/// down to what an `f64` alone would be wrong by. Other functions are wrong by a few 2⁻¹⁰⁰ of the larger of result and argument;
/// sine and cosine are not a number beyond 2⁵⁰ rad. No operation needs a fused multiply-add.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The `f64` nearest to this number.
    pub const fn high(self) -> f64 {
        self.high
    }

    /// What the nearest `f64` leaves out.
    pub const fn low(self) -> f64 {
        self.low
    }

    const fn of_words(high: f64, low: f64) -> Self {
        Self { high, low }
    }

    /// `a + b`, exactly.
    #[inline]
    fn sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let of_b = sum - a;
        Self::of_words(sum, (a - (sum - of_b)) + (b - of_b))
    }

    /// `a + b`, exactly, if `a` is not the smaller; without a low word where there is no number.
    #[inline]
    fn ordered(a: f64, b: f64) -> Self {
        let sum = a + b;
        Self::of_words(sum, if sum.is_finite() { b - (sum - a) } else { 0.0 })
    }

    /// `a · b`, exactly unless a word of it underflows or `a` or `b` is beyond 2⁹⁹⁶ (Dekker, Numer. Math. 18, 1971).
    #[inline]
    fn product(a: f64, b: f64) -> Self {
        let product = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        let low = a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2);
        Self::of_words(product, if low.is_finite() { low } else { 0.0 })
    }

    /// This number times a power of two.
    fn scaled(self, exponent: i32) -> Self {
        let power = |e: i32| f64::from_bits(((1023 + e.clamp(-1022, 1023)) as u64) << 52);
        let half = exponent / 2;
        let by = |word: f64| word * power(half) * power(exponent - half);
        Self::ordered(by(self.high), by(self.low))
    }
}

/// 26 leading bits and the rest.
#[inline]
fn halves(a: f64) -> (f64, f64) {
    let shifted = a * 134_217_729.0;
    let leading = shifted - (shifted - a);
    (leading, a - leading)
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(high: f64) -> Self {
        Self::of_words(high, 0.0)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::of_words(-self.high, -self.low)
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    /// Algorithm 6 of Joldes et al.
    #[inline]
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        if !high.high.is_finite() {
            return high.high.into();
        }
        let low = Self::sum(self.low, other.low);
        let sum = Self::ordered(high.high, high.low + low.high);
        Self::ordered(sum.high, low.low + sum.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    /// Algorithm 10 of Joldes et al.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        if !product.high.is_finite() {
            return product.high.into();
        }
        let across = self.high * other.low + self.low * other.high;
        Self::ordered(product.high, product.low + across)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Algorithm 17 of Joldes et al.
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.high / other.high;
        if !quotient.is_finite() || other.high.is_infinite() {
            return quotient.into();
        }
        let rest = self - other * Self::from(quotient);
        Self::ordered(quotient, rest.high / other.high)
    }
}

impl Rem for DoubleDouble {
    type Output = Self;

    #[inline]
    fn rem(self, other: Self) -> Self {
        self - (self / other).trunc() * other
    }
}

macro_rules! assign {
    ($($assign:ident $method:ident $operator:tt;)*) => {$(
        impl $assign for DoubleDouble {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}
assign! {
    AddAssign add_assign +;
    SubAssign sub_assign -;
    MulAssign mul_assign *;
    DivAssign div_assign /;
    RemAssign rem_assign %;
}

impl Real for DoubleDouble {
    // 2⁻⁷⁰⁰ and 2⁷⁰⁰: the low word of a product that counts is no underflow, and halving a word no overflow.
    const LEAST: Self = Self::of_words(f64::from_bits((1023 - 700) << 52), 0.0);
    const MOST: Self = Self::of_words(f64::from_bits((1023 + 700) << 52), 0.0);

    #[inline]
    fn of(x: f64) -> Self {
        x.into()
    }

    #[inline]
    fn of_count(n: u32) -> Self {
        f64::from(n).into()
    }

    #[inline]
    fn all_finite(values: &[Self]) -> bool {
        let largest = values.iter().fold(0, |largest, v| v.high.abs().to_bits().max(largest));
        largest < f64::INFINITY.to_bits()
    }

    #[inline]
    fn whole_turns(self) -> Self {
        const MOST: f64 = (1_u64 << 53) as f64;
        // A comparison with NaN is false.
        if self.high.abs() < MOST { self.floor() } else { Self::nan() }
    }

    #[inline]
    fn sine_cosine(self) -> (Self, Self) {
        self.sin_cos()
    }
}
