//! Exponential, logarithm, sine and cosine, angle of a point: from these come all other functions.

use super::DoubleDouble;
use num_traits::{Float, One, Zero};

pub(super) const LN_2: DoubleDouble = DoubleDouble::of_words(core::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
pub(super) const LN_10: DoubleDouble = DoubleDouble::of_words(core::f64::consts::LN_10, -2.170_756_223_382_249_4e-16);
/// π/2 in three words.
const QUARTER_TURN: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// `eˣ`.
pub(super) fn exp(x: DoubleDouble) -> DoubleDouble {
    part(x).map_or(Float::exp(x.high).into(), |(p, doublings)| (p + DoubleDouble::one()).scaled(doublings))
}

/// `eˣ − 1`, to the last digits of a small result too.
pub(super) fn exp_m1(x: DoubleDouble) -> DoubleDouble {
    match part(x) {
        None => Float::exp_m1(x.high).into(),
        Some((p, 0)) => p,
        Some((p, doublings)) => (p + DoubleDouble::one()).scaled(doublings) - DoubleDouble::one(),
    }
}

/// `p` and `k` of `eˣ = (1 + p) · 2ᵏ`, `p` between −0.3 and 0.42; none where `eˣ` is no number, nothing or infinite.
fn part(x: DoubleDouble) -> Option<(DoubleDouble, i32)> {
    let doublings = (x.high * core::f64::consts::LOG2_E).round();
    let within = doublings.abs() < 1100.0;
    if !within {
        return None;
    }
    // eᵗ − 1 of the 2⁹th part by its series, t < 7·10⁻⁴, then (1 + p)² − 1 = p·(2 + p) nine times.
    let t = (x - LN_2 * doublings.into()).scaled(-9);
    let series = (2..=9).rev().fold(DoubleDouble::one(), |sum, n| DoubleDouble::one() + sum * t / f64::from(n).into());
    let two = DoubleDouble::from(2.0);
    Some(((0..9).fold(t * series, |p, _| p * (two + p)), doublings as i32))
}

/// `ln(1 + x)`, to the last digits of a small result too.
pub(super) fn ln_1p(x: DoubleDouble) -> DoubleDouble {
    if x.high > -0.3 && x.high < 0.5 { near_one(x) } else { ln(DoubleDouble::one() + x) }
}

/// The natural logarithm.
pub(super) fn ln(x: DoubleDouble) -> DoubleDouble {
    split(x).map_or(Float::ln(x.high).into(), |(m, e)| near_one(m - DoubleDouble::one()) + LN_2 * f64::from(e).into())
}

/// The logarithm to the base of two, exact for its powers.
pub(super) fn log2(x: DoubleDouble) -> DoubleDouble {
    split(x).map_or(Float::log2(x.high).into(), |(m, e)| near_one(m - DoubleDouble::one()) / LN_2 + f64::from(e).into())
}

/// `ln(1 + x)` of a small `x`: Newton's step from what the `f64` has.
fn near_one(x: DoubleDouble) -> DoubleDouble {
    let start = DoubleDouble::from(Float::ln_1p(x.high));
    start + (x + (DoubleDouble::one() + x) * exp_m1(-start))
}

/// A number between 0.7 and 1.4 and the power of two that it is multiplied by, of what is finite and has all its bits.
fn split(x: DoubleDouble) -> Option<(DoubleDouble, i32)> {
    let whole = x.high >= f64::MIN_POSITIVE && x.high.is_finite();
    if !whole {
        return None;
    }
    let exponent = (x.high.to_bits() >> 52) as i32 - 1023;
    let mantissa = x.scaled(-exponent);
    Some(if mantissa.high < 1.4 { (mantissa, exponent) } else { (mantissa.scaled(-1), exponent + 1) })
}

/// Sine and cosine of an angle in rad.
pub(super) fn sin_cos(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let turns = (x.high / QUARTER_TURN[0]).round();
    let within = turns.abs() < (1_u64 << 50) as f64;
    if !within {
        return (DoubleDouble::nan(), DoubleDouble::nan());
    }
    let rest = QUARTER_TURN.iter().fold(x, |rest, &word| rest - DoubleDouble::product(turns, word));
    let square = rest * rest;
    // The series, innermost first: each bracket is 1 − x²/(n(n+1))·[…].
    let series = |first: i32| {
        (0..14)
            .rev()
            .map(|i| f64::from(first + 2 * i))
            .fold(DoubleDouble::one(), |sum, n| DoubleDouble::one() - sum * square / DoubleDouble::from(n * (n + 1.0)))
    };
    let (sine, cosine) = (rest * series(2), series(1));
    match (turns as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// The angle of a point, in rad.
pub(super) fn atan2(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    let start = DoubleDouble::from(Float::atan2(y.high, x.high));
    let (sine, cosine) = sin_cos(start);
    // How far the point is from the ray of what the `f64` has.
    let beside = (y * cosine - x * sine) / hypot(x, y);
    if beside.is_finite() { start + beside } else { start }
}

/// The length of a vector.
pub(super) fn hypot(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
    let (small, large) = if x.abs() < y.abs() { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    if large.is_zero() || !large.is_finite() || !small.is_finite() {
        return Float::hypot(x.high, y.high).into();
    }
    let ratio = small / large;
    large * (DoubleDouble::one() + ratio * ratio).sqrt()
}
