//! `num_traits::Float`, which the solver is written in.

use super::{DoubleDouble, elementary};
use crate::lstsq::Real;
use core::num::FpCategory;
use num_traits::{Float, NumCast, One, ToPrimitive, Zero};

impl ToPrimitive for DoubleDouble {
    fn to_i64(&self) -> Option<i64> {
        self.to_i128()?.try_into().ok()
    }

    fn to_u64(&self) -> Option<u64> {
        self.to_i128()?.try_into().ok()
    }

    fn to_i128(&self) -> Option<i128> {
        let whole = self.trunc();
        whole.high.to_i128()?.checked_add(whole.low.to_i128()?)
    }

    fn to_f64(&self) -> Option<f64> {
        Some(self.high)
    }
}

impl NumCast for DoubleDouble {
    /// Exact for whole numbers of up to 106 bits; else what the nearest `f64` is.
    fn from<T: ToPrimitive>(n: T) -> Option<Self> {
        let high = n.to_f64()?;
        let low = n.to_i128().and_then(|n| n.checked_sub(high.to_i128()?)).unwrap_or(0);
        Some(if high.fract() == 0.0 { Self::ordered(high, low as f64) } else { high.into() })
    }
}

impl Float for DoubleDouble {
    fn nan() -> Self {
        f64::NAN.into()
    }

    fn infinity() -> Self {
        f64::INFINITY.into()
    }

    fn neg_infinity() -> Self {
        f64::NEG_INFINITY.into()
    }

    fn neg_zero() -> Self {
        Self::of_words(-0.0, -0.0)
    }

    fn min_value() -> Self {
        -Self::max_value()
    }

    /// The smallest number with all its bits.
    fn min_positive_value() -> Self {
        Self::one().scaled(-1022 + 53)
    }

    fn max_value() -> Self {
        Self::of_words(f64::MAX, f64::MAX * f64::EPSILON / 4.0)
    }

    /// 2⁻¹⁰⁵: what one differs by from the next number of 106 bits.
    fn epsilon() -> Self {
        Self::one().scaled(-105)
    }

    fn is_nan(self) -> bool {
        self.high.is_nan()
    }

    fn is_infinite(self) -> bool {
        self.high.is_infinite()
    }

    fn is_finite(self) -> bool {
        self.high.is_finite()
    }

    fn is_normal(self) -> bool {
        self.high.is_normal()
    }

    fn classify(self) -> FpCategory {
        self.high.classify()
    }

    fn floor(self) -> Self {
        let high = Float::floor(self.high);
        if high == self.high { Self::ordered(high, Float::floor(self.low)) } else { high.into() }
    }

    fn ceil(self) -> Self {
        -(-self).floor()
    }

    fn round(self) -> Self {
        // A half more would be rounded itself where the lower part has no digit for it.
        let size = self.abs();
        let whole = size.floor();
        let up = if size - whole < 0.5.into() { 0.0 } else { 1.0 };
        (whole + up.into()) * self.signum()
    }

    fn trunc(self) -> Self {
        if self.high < 0.0 { self.ceil() } else { self.floor() }
    }

    fn fract(self) -> Self {
        self - self.trunc()
    }

    fn abs(self) -> Self {
        if self.high.is_sign_negative() { -self } else { self }
    }

    fn signum(self) -> Self {
        Float::signum(self.high).into()
    }

    fn is_sign_positive(self) -> bool {
        self.high.is_sign_positive()
    }

    fn is_sign_negative(self) -> bool {
        self.high.is_sign_negative()
    }

    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }

    fn recip(self) -> Self {
        Self::one() / self
    }

    fn powi(self, n: i32) -> Self {
        let power = num_traits::pow(self, n.unsigned_abs() as usize);
        if n < 0 { power.recip() } else { power }
    }

    fn powf(self, n: Self) -> Self {
        match n.to_i32().filter(|&whole| n == Self::of(whole.into())) {
            Some(whole) => self.powi(whole),
            None if self.is_zero() || !self.is_finite() || !n.is_finite() => Float::powf(self.high, n.high).into(),
            None => (n * self.ln()).exp(),
        }
    }

    /// Newton's step from the root of the high word.
    #[inline]
    fn sqrt(self) -> Self {
        let root = Float::sqrt(self.high);
        if root == 0.0 || !root.is_finite() {
            return root.into();
        }
        let rest = self - Self::product(root, root);
        Self::ordered(root, rest.high / (2.0 * root))
    }

    fn cbrt(self) -> Self {
        let root = Self::of(Float::cbrt(self.high));
        let square = root * root;
        let step = (self - root * square) / (square * 3.0.into());
        if step.is_finite() { root + step } else { root }
    }

    fn hypot(self, other: Self) -> Self {
        elementary::hypot(self, other)
    }

    fn exp(self) -> Self {
        elementary::exp(self)
    }

    fn exp_m1(self) -> Self {
        elementary::exp_m1(self)
    }

    fn exp2(self) -> Self {
        let whole = self.floor();
        if self.high.abs() < 1100.0 {
            ((self - whole) * elementary::LN_2).exp().scaled(whole.high as i32)
        } else {
            Float::exp2(self.high).into()
        }
    }

    fn ln(self) -> Self {
        elementary::ln(self)
    }

    fn ln_1p(self) -> Self {
        elementary::ln_1p(self)
    }

    fn log(self, base: Self) -> Self {
        self.ln() / base.ln()
    }

    fn log2(self) -> Self {
        elementary::log2(self)
    }

    fn log10(self) -> Self {
        self.ln() / elementary::LN_10
    }

    fn max(self, other: Self) -> Self {
        if self >= other || other.is_nan() { self } else { other }
    }

    fn min(self, other: Self) -> Self {
        if self <= other || other.is_nan() { self } else { other }
    }

    fn abs_sub(self, other: Self) -> Self {
        (self - other).max(Self::zero())
    }

    fn sin(self) -> Self {
        self.sin_cos().0
    }

    fn cos(self) -> Self {
        self.sin_cos().1
    }

    fn tan(self) -> Self {
        let (sine, cosine) = self.sin_cos();
        sine / cosine
    }

    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }

    fn asin(self) -> Self {
        self.atan2(((Self::one() - self) * (Self::one() + self)).sqrt())
    }

    fn acos(self) -> Self {
        ((Self::one() - self) * (Self::one() + self)).sqrt().atan2(self)
    }

    fn atan(self) -> Self {
        self.atan2(Self::one())
    }

    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }

    fn sinh(self) -> Self {
        let p = self.abs().exp_m1();
        (p + p / (p + Self::one())) * 0.5.into() * self.signum()
    }

    fn cosh(self) -> Self {
        let power = self.abs().exp();
        (power + power.recip()) * 0.5.into()
    }

    fn tanh(self) -> Self {
        // Beyond 40 it is one to more than 106 bits.
        let p = (self.abs().min(40.0.into()) * 2.0.into()).exp_m1();
        p / (p + 2.0.into()) * self.signum()
    }

    fn asinh(self) -> Self {
        let x = self.abs();
        let square = x * x;
        (x + square / (Self::one() + (square + Self::one()).sqrt())).ln_1p() * self.signum()
    }

    fn acosh(self) -> Self {
        (self + ((self - Self::one()) * (self + Self::one())).sqrt()).ln()
    }

    fn atanh(self) -> Self {
        (self * 2.0.into() / (Self::one() - self)).ln_1p() * 0.5.into()
    }

    fn integer_decode(self) -> (u64, i16, i8) {
        Float::integer_decode(self.high)
    }
}
