//! Double-double against exact rational arithmetic, and functions against what they invert.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Float, NumCast, One, Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use trunnion_solver::{DoubleDouble, Real};

fn exact(x: DoubleDouble) -> BigRational {
    BigRational::from_float(x.high()).unwrap() + BigRational::from_float(x.low()).unwrap()
}

/// 2⁻ⁿ.
fn bit(n: usize) -> BigRational {
    BigRational::new(BigInt::one(), BigInt::one() << n)
}

/// Both words in use, of any size whose square is in the range.
fn number() -> impl Strategy<Value = DoubleDouble> {
    let word = -1.0..1.0f64;
    (word.clone(), word, -400..400i32).prop_map(|(high, low, size)| {
        DoubleDouble::of(high * 2f64.powi(size)) + DoubleDouble::of(low * 2f64.powi(size - 53))
    })
}

/// Of ordinary size.
fn ordinary() -> impl Strategy<Value = DoubleDouble> {
    (-30.0..30.0f64, -1e-16..1e-16f64).prop_map(|(high, low)| DoubleDouble::of(high) + low.into())
}

/// Whether a number is within 2⁻¹⁰² of itself.
fn right(x: DoubleDouble, truth: &BigRational) -> Result<(), TestCaseError> {
    prop_assert!(x.high() + x.low() == x.high(), "not normalised: {x}");
    prop_assert!((exact(x) - truth).abs() <= truth.abs() * bit(102), "{x} is not {truth}");
    Ok(())
}

/// Whether two numbers agree to 2⁻⁹⁵ of `scale`.
fn near(a: DoubleDouble, b: DoubleDouble, scale: f64) -> Result<(), TestCaseError> {
    prop_assert!(((a - b).high() / scale).abs() < 2f64.powi(-95), "{a} is not {b}");
    Ok(())
}

proptest! {
    #[test]
    fn arithmetic_is_right_to_102_bits(a in number(), b in number()) {
        let (x, y) = (exact(a), exact(b));
        right(a + b, &(&x + &y))?;
        right(a - b, &(&x - &y))?;
        right(a * b, &(&x * &y))?;
        if !y.is_zero() {
            right(a / b, &(&x / &y))?;
        }
        prop_assert_eq!(a < b, x < y);
        prop_assert_eq!(a.max(b) == a, x >= y);
    }

    #[test]
    fn nearly_equal_numbers_are_subtracted_exactly(a in number(), ulps in -9..9i32) {
        let b = a * (DoubleDouble::one() + DoubleDouble::of(ulps.into()) * DoubleDouble::epsilon());
        prop_assert_eq!(exact(a - b), exact(a) - exact(b));
    }

    #[test]
    fn roots_are_right_to_100_bits(a in number()) {
        let a = a.abs();
        let root = exact(a.sqrt());
        prop_assert!((&root * &root - exact(a)).abs() <= exact(a) * bit(100));
    }

    #[test]
    fn whole_parts_are_those_of_the_fraction(a in number()) {
        let x = exact(a);
        prop_assert_eq!(exact(a.floor()), x.floor());
        prop_assert_eq!(exact(a.ceil()), x.ceil());
        prop_assert_eq!(exact(a.trunc()), x.trunc());
        prop_assert_eq!(exact(a.fract()), x.fract());
        prop_assert_eq!(exact(a.round()), x.round());
    }

    #[test]
    fn whole_numbers_of_all_digits_are_their_own(high in 1i64 << 52..1 << 53, low in -(1i64 << 53)..1 << 53, minus: bool) {
        let [high, low] = [high, low].map(|part| part as f64);
        let a = DoubleDouble::of(high * 4.0 * f64::EPSILON.recip()) + DoubleDouble::of(low);
        let a = if minus { -a } else { a };
        prop_assert_eq!([a.floor(), a.ceil(), a.trunc(), a.round()], [a; 4]);
    }

    #[test]
    fn what_is_printed_exactly_is_read_exactly(digits in any::<i64>(), places in 0..12i32) {
        let read: DoubleDouble = format!("{digits}e-{places}").parse().unwrap();
        let truth = BigRational::new(digits.into(), BigInt::from(10).pow(places as u32));
        right(read, &truth)?;
        let whole: DoubleDouble = NumCast::from(digits).unwrap();
        prop_assert_eq!(whole.to_i64(), Some(digits));
    }

    #[test]
    fn functions_invert_each_other(x in ordinary()) {
        let one = DoubleDouble::one();
        near(x.exp().ln(), x, 30.0)?;
        near(x.exp() * (-x).exp(), one, 30.0)?;
        near(x.exp2().log2(), x, 30.0)?;
        near(x.asinh().sinh(), x, x.high() * 10.0)?;
        near(x.abs().exp_m1().ln_1p(), x.abs(), x.high())?;
        near(x.cosh().acosh(), x.abs(), 30.0 / x.high().abs().min(1.0))?;
        near(x.cbrt().powi(3), x, x.high())?;
        let (sine, cosine) = x.sine_cosine();
        near(sine * sine + cosine * cosine, one, 1.0)?;
        near((x + x).sin(), (sine + sine) * cosine, 1.0)?;
        let turn = DoubleDouble::of(4.0) * one.asin();
        near((sine.atan2(cosine) - x) / turn - ((sine.atan2(cosine) - x) / turn).round(), DoubleDouble::zero(), 10.0)?;
        near(sine.asin().sin(), sine, 1.0)?;
        near(cosine.acos().cos(), cosine, 1.0)?;
        near(x.atan().tan(), x, x.high().hypot(1.0).powi(2))?;
        let small = x / 31.0.into();
        near(small.atanh().tanh(), small, 1.0)?;
    }

    /// No result is half a number: what overflows is infinite, what has no value is NaN, and both words are then of no use.
    #[test]
    fn beyond_the_range_it_is_as_f64(a in any::<f64>(), b in any::<f64>()) {
        let (x, y) = (DoubleDouble::of(a), DoubleDouble::of(b));
        for (ours, theirs) in [(x + y, a + b), (x - y, a - b), (x * y, a * b), (x / y, a / b), (x.sqrt(), a.sqrt())] {
            prop_assert_eq!(ours.high().is_nan(), theirs.is_nan());
            prop_assert_eq!(ours.high().is_infinite(), theirs.is_infinite());
            prop_assert!(ours.low().is_finite());
        }
        for f in [Float::exp, Float::ln, Float::atan, Float::tanh, Float::exp2, Float::log2, Float::cbrt] as [fn(DoubleDouble) -> DoubleDouble; 7] {
            let _ = f(x);
        }
    }
}

/// To 31 digits, from tables.
#[test]
fn constants_are_those_of_the_tables() {
    let one = DoubleDouble::one();
    for (value, digits) in [
        (one.exp(), "2.7182818284590452353602874713526625"),
        (one.atan() * 4.0.into(), "3.1415926535897932384626433832795029"),
        (DoubleDouble::of(2.0).ln(), "0.6931471805599453094172321214581766"),
        (DoubleDouble::of(10.0).ln(), "2.3025850929940456840179914546843642"),
        (DoubleDouble::of(2.0).sqrt(), "1.4142135623730950488016887242096981"),
        (one.sin(), "0.8414709848078965066525023216302990"),
        (one.cos(), "0.5403023058681397174009366074429766"),
        (DoubleDouble::of(-50.0).exp(), "1.9287498479639177830173428165270126e-22"),
    ] {
        let expected: DoubleDouble = digits.parse().unwrap();
        assert!(((value - expected) / expected).high().abs() < 4e-31, "{value} is not {digits}");
    }
}
