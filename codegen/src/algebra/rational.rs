//! Exact rational numbers of any size. Nearly all fit two machine integers, and those cost no allocation.

use core::num::NonZeroI128;
use core::ops::{Add, Mul, Neg};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::{CheckedAdd, CheckedMul, One, Signed, ToPrimitive, Zero};

use super::AlgebraError;
use super::modular::Field;

/// An exact rational number in lowest terms; equal numbers are equal values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// Whatever fits is small. The denominator is positive; that it is never 0 leaves room to mark the large ones, so that
/// a number has the size of its two integers.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small(i128, NonZeroI128),
    Big(Box<BigRational>),
}

/// Small numerators and denominators stay below this, so that negation and `Ratio`'s own reductions cannot overflow.
const LIMIT: i128 = 1 << 126;

const UNIT: NonZeroI128 = NonZeroI128::new(1).unwrap();

/// The integer `n` as a rational.
pub fn integer(n: i128) -> Rational {
    Rational::small(n, 1).unwrap_or_else(|| Rational::from_big(BigRational::from_integer(n.into())))
}

impl Rational {
    /// 0
    pub const ZERO: Self = Self(Repr::Small(0, UNIT));
    /// 1
    pub const ONE: Self = Self(Repr::Small(1, UNIT));

    /// `numer / denom` in lowest terms.
    ///
    /// # Panics
    /// `denom` is 0.
    pub fn new(numer: i128, denom: i128) -> Self {
        if denom == 1 {
            return integer(numer);
        }
        Self::from_big(BigRational::new(numer.into(), denom.into()))
    }

    /// `None` for what does not fit; lowest terms are given.
    fn small(numer: i128, denom: i128) -> Option<Self> {
        let fits = numer.unsigned_abs() < LIMIT.unsigned_abs() && denom < LIMIT;
        let denom = NonZeroI128::new(denom).filter(|_| fits)?;
        Some(Self(Repr::Small(numer, denom)))
    }

    /// Of any size.
    pub(super) fn from_big(big: BigRational) -> Self {
        let small = big.numer().to_i128().zip(big.denom().to_i128()).and_then(|(n, d)| Self::small(n, d));
        small.unwrap_or_else(|| Self(Repr::Big(Box::new(big))))
    }

    /// The number as one of any size.
    pub(super) fn to_big(&self) -> BigRational {
        match &self.0 {
            Repr::Small(n, d) => BigRational::new_raw((*n).into(), d.get().into()),
            Repr::Big(big) => (**big).clone(),
        }
    }

    /// Above the line; it has the sign.
    pub fn numer(&self) -> BigInt {
        match &self.0 {
            Repr::Small(n, _) => (*n).into(),
            Repr::Big(big) => big.numer().clone(),
        }
    }

    /// Below the line, positive.
    pub fn denom(&self) -> BigInt {
        match &self.0 {
            Repr::Small(_, d) => d.get().into(),
            Repr::Big(big) => big.denom().clone(),
        }
    }

    /// The number, if it is whole.
    fn whole(&self) -> Option<BigInt> {
        match &self.0 {
            Repr::Small(n, d) => (*d == UNIT).then(|| (*n).into()),
            Repr::Big(big) => big.is_integer().then(|| big.numer().clone()),
        }
    }

    /// The number, if it is whole and has at most 127 bits.
    pub fn to_integer(&self) -> Option<i128> {
        match &self.0 {
            Repr::Small(n, d) => (*d == UNIT).then_some(*n),
            Repr::Big(big) => big.is_integer().then(|| big.numer().to_i128()).flatten(),
        }
    }

    /// Binary digits of the longer of its two integers.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Repr::Small(n, d) => (i128::BITS - n.unsigned_abs().max(d.get().unsigned_abs()).leading_zeros()).into(),
            Repr::Big(big) => big.numer().bits().max(big.denom().bits()),
        }
    }

    /// Whether it is neither whole nor of two machine integers.
    pub(super) fn is_long_fraction(&self) -> bool {
        matches!(&self.0, Repr::Big(big) if !big.is_integer())
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }

    /// True for 1.
    pub fn is_one(&self) -> bool {
        *self == Self::ONE
    }

    /// True below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Big(big) => big.is_negative(),
        }
    }

    /// Modulo a prime; `None` where that stands below the line.
    pub(super) fn residue(&self, field: Field) -> Option<u64> {
        let Field(p) = field;
        let (numer, denom) = match &self.0 {
            Repr::Small(n, d) => (n.rem_euclid(p.into()) as u64, d.get().rem_euclid(p.into()) as u64),
            Repr::Big(big) => {
                let residue = |n: &BigInt| n.mod_floor(&p.into()).to_u64().unwrap_or(0);
                (residue(big.numer()), residue(big.denom()))
            }
        };
        match denom {
            0 => None,
            1 => Some(numer),
            denom => Some(numer * field.inverse(denom) % p),
        }
    }

    /// Without its sign.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// `1 / self`
    ///
    /// # Errors
    /// It is 0.
    pub fn recip(&self) -> Result<Self, AlgebraError> {
        match &self.0 {
            Repr::Small(n, d) => {
                let denom = NonZeroI128::new(n.abs()).ok_or(AlgebraError::DivisionByZero)?;
                Ok(Self(Repr::Small(n.signum() * d.get(), denom)))
            }
            Repr::Big(big) => Ok(Self(Repr::Big(Box::new(big.recip())))),
        }
    }

    /// `self / other`; whole where both are and nothing remains, without a search for common divisors.
    ///
    /// # Errors
    /// `other` is 0.
    pub(super) fn over(&self, other: &Self) -> Result<Self, AlgebraError> {
        if let (Some(a), Some(b)) = (self.whole(), other.whole())
            && !b.is_zero()
        {
            let (quotient, rest) = a.div_rem(&b);
            if rest.is_zero() {
                return Ok(Self::from_big(quotient.into()));
            }
        }
        Ok(self * &other.recip()?)
    }

    /// `self^exponent`; `None` for a negative power of 0 and for one with more digits than the range of `f64` has.
    pub(crate) fn power(&self, exponent: i32) -> Option<Self> {
        const MOST: u64 = f64::MAX_EXP.unsigned_abs() as u64;
        let fits = self.bits().saturating_sub(1).saturating_mul(exponent.unsigned_abs().into()) <= MOST;
        let defined = exponent >= 0 || !self.is_zero();
        (fits && defined).then(|| Self::from_big(self.to_big().pow(exponent)))
    }

    /// The square root, where it is rational.
    pub fn sqrt(&self) -> Option<Self> {
        let root = |n: BigInt| {
            let root = (!n.is_negative()).then(|| n.sqrt())?;
            (&root * &root == n).then_some(root)
        };
        Some(Self::from_big(BigRational::new_raw(root(self.numer())?, root(self.denom())?)))
    }
}

impl From<i128> for Rational {
    fn from(n: i128) -> Self {
        integer(n)
    }
}

/// Integers, nearly every coefficient of a chain, skip the greatest common divisors.
impl Add for &Rational {
    type Output = Rational;

    fn add(self, other: Self) -> Rational {
        let small = match (&self.0, &other.0) {
            (Repr::Small(a, UNIT), Repr::Small(b, UNIT)) => a.checked_add(b).and_then(|n| Rational::small(n, 1)),
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                let sum = Ratio::new_raw(*a, b.get()).checked_add(&Ratio::new_raw(*c, d.get()));
                sum.and_then(|sum| Rational::small(*sum.numer(), *sum.denom()))
            }
            _ => None,
        };
        small.unwrap_or_else(|| match self.whole().zip(other.whole()) {
            Some((a, b)) => Rational::from_big((a + b).into()),
            None => Rational::from_big(self.to_big() + other.to_big()),
        })
    }
}

impl Mul for &Rational {
    type Output = Rational;

    fn mul(self, other: Self) -> Rational {
        let small = match (&self.0, &other.0) {
            (Repr::Small(a, UNIT), Repr::Small(b, UNIT)) => a.checked_mul(b).and_then(|n| Rational::small(n, 1)),
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                let product = Ratio::new_raw(*a, b.get()).checked_mul(&Ratio::new_raw(*c, d.get()));
                product.and_then(|product| Rational::small(*product.numer(), *product.denom()))
            }
            _ => None,
        };
        small.unwrap_or_else(|| match self.whole().zip(other.whole()) {
            Some((a, b)) => Rational::from_big((a * b).into()),
            None => Rational::from_big(self.to_big() * other.to_big()),
        })
    }
}

impl Neg for &Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) => Rational(Repr::Small(-n, *d)),
            Repr::Big(big) => Rational(Repr::Big(Box::new(-(**big).clone()))),
        }
    }
}

impl Neg for Rational {
    type Output = Self;

    fn neg(self) -> Self {
        -&self
    }
}

/// 2^exponent.
pub(super) fn power_of_two(exponent: i8) -> Rational {
    let power = BigInt::one() << exponent.unsigned_abs();
    Rational::from_big(if exponent < 0 {
        BigRational::new_raw(BigInt::one(), power)
    } else {
        BigRational::from_integer(power)
    })
}

/// gcd of the numerators over lcm of the denominators, so that dividing by it leaves coprime integers; 1 for none.
pub(super) fn content<'a>(numbers: impl Iterator<Item = &'a Rational>) -> Rational {
    // Nearly always there is nothing to be found, and a remainder says so at once.
    let step = |(n, d): (BigInt, BigInt), r: &Rational| {
        let (numer, denom) = (r.numer(), r.denom());
        (
            if numer.is_multiple_of(&n) { n } else { n.gcd(&numer) },
            if d.is_multiple_of(&denom) { d } else { d.lcm(&denom) },
        )
    };
    let (n, d) = numbers.fold((BigInt::zero(), BigInt::one()), step);
    if n.is_zero() { Rational::ONE } else { Rational::from_big(BigRational::new(n, d)) }
}

/// Nearest `f64`; infinite where the number is beyond them.
pub fn to_f64(a: &Rational) -> f64 {
    const EXACT: u128 = 1 << f64::MANTISSA_DIGITS;
    match &a.0 {
        Repr::Small(n, d) if n.unsigned_abs() <= EXACT && d.get().unsigned_abs() <= EXACT => *n as f64 / d.get() as f64,
        _ => a.to_big().to_f64().unwrap_or(f64::NAN),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_grow_and_shrink_without_a_trace() {
        let big = integer(LIMIT - 1);
        let sum = &big + &big;
        assert!(matches!(sum.0, Repr::Big(_)));
        assert_eq!(&sum + &-&big, big);
        assert_eq!(&(&sum * &sum) * &sum.recip().unwrap(), sum);
        assert_eq!(&sum.recip().unwrap() * &integer(2), big.recip().unwrap());
        assert_eq!(integer(i128::MIN).numer(), BigInt::from(i128::MIN));
        assert_eq!(integer(i128::MIN).to_integer(), Some(i128::MIN));
        assert_eq!((&sum * &sum).sqrt(), Some(sum.clone()));
        assert_eq!(sum.sqrt(), None);
        assert_eq!(Rational::ZERO.recip(), Err(AlgebraError::DivisionByZero));
        assert_eq!(content([integer(6), Rational::new(4, 9)].iter()), Rational::new(2, 9));
        assert_eq!(size_of::<Rational>(), 32);
    }

    /// The text of a number is read correctly rounded, so a decimal in a fraction tells the nearest `f64`.
    #[test]
    fn the_nearest_number_is_the_one_that_is_read() {
        for digits in
            ["9007199254740993", "123456789012345678901234567890123456", "33333333333333333333333333333333333333"]
        {
            for places in [0, 17, 37] {
                let exact = Rational::new(digits.parse().unwrap(), 10_i128.pow(places));
                let read: f64 = format!("{digits}e-{places}").parse().unwrap();
                assert_eq!(to_f64(&exact), read, "{digits}e-{places}");
                assert_eq!(to_f64(&-exact), -read);
            }
        }
        let third = Rational::new(1, 3);
        let huge = (0..700).fold(Rational::ONE, |power, _| &power * &integer(3));
        assert_eq!(to_f64(&huge), f64::INFINITY);
        assert_eq!(to_f64(&(&huge * &huge.recip().unwrap())), 1.0);
        let small = (0..660).fold(Rational::ONE, |power, _| &power * &third);
        assert_eq!(to_f64(&small), 1.258843915e-315);
    }
}
