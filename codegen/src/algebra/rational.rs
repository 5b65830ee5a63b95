//! Rationals of 128 bits whose every operation is checked.

use super::AlgebraError;
use num_integer::Integer;
use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedMul};

/// An exact rational number.
pub type Rational = Ratio<i128>;

/// Numerators and denominators stay below this, so that negation and `Ratio`'s own reductions cannot overflow.
const LIMIT: i128 = 1 << 126;

/// The integer `n` as a rational.
pub const fn integer(n: i128) -> Rational {
    Ratio::new_raw(n, 1)
}

fn checked(r: Option<Rational>) -> Result<Rational, AlgebraError> {
    match r {
        Some(r) if r.numer().unsigned_abs() < LIMIT as u128 && *r.denom() < LIMIT => Ok(r),
        _ => Err(AlgebraError::CoefficientOverflow),
    }
}

/// `a + b`; integers, nearly every coefficient of a chain, skip the greatest common divisors.
pub(super) fn add(a: &Rational, b: &Rational) -> Result<Rational, AlgebraError> {
    if *a.denom() == 1 && *b.denom() == 1 {
        checked(a.numer().checked_add(b.numer()).map(integer))
    } else {
        checked(a.checked_add(b))
    }
}

/// `a · b`.
pub(super) fn mul(a: &Rational, b: &Rational) -> Result<Rational, AlgebraError> {
    if *a.denom() == 1 && *b.denom() == 1 {
        checked(a.numer().checked_mul(b.numer()).map(integer))
    } else {
        checked(a.checked_mul(b))
    }
}

/// `1 / a`.
pub(super) fn recip(a: &Rational) -> Result<Rational, AlgebraError> {
    if *a.numer() == 0 { Err(AlgebraError::DivisionByZero) } else { Ok(a.recip()) }
}

/// 2^exponent, for exponents of one signed byte halved.
pub(super) fn power_of_two(exponent: i8) -> Rational {
    let magnitude = 1i128 << exponent.unsigned_abs().min(125);
    if exponent < 0 { Ratio::new_raw(1, magnitude) } else { integer(magnitude) }
}

/// gcd of the numerators over lcm of the denominators, so that dividing by it leaves coprime integers; 1 for none.
/// It only keeps numbers small, any factor would do: where the lcm overflows a smaller one is used.
pub(super) fn content<'a>(numbers: impl Iterator<Item = &'a Rational>) -> Rational {
    let step = |(n, d): (i128, i128), r: &Rational| {
        (n.gcd(r.numer()), (d / d.gcd(r.denom())).checked_mul(*r.denom()).unwrap_or(d))
    };
    match numbers.fold((0, 1), step) {
        (0, _) => integer(1),
        (n, d) => Ratio::new(n, d),
    }
}

/// Nearest `f64`.
pub fn to_f64(a: &Rational) -> f64 {
    *a.numer() as f64 / *a.denom() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overflow_is_an_error() {
        let big = integer(LIMIT - 1);
        assert_eq!(add(&big, &big), Err(AlgebraError::CoefficientOverflow));
        assert_eq!(mul(&big, &integer(2)), Err(AlgebraError::CoefficientOverflow));
        assert_eq!(mul(&Ratio::new(1, LIMIT - 1), &Ratio::new(1, 3)), Err(AlgebraError::CoefficientOverflow));
        assert_eq!(recip(&integer(0)), Err(AlgebraError::DivisionByZero));
    }
}
