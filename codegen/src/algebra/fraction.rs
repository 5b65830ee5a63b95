//! The field of the base-parameter factorisation: quotients of polynomials in the constants.

use super::gcd::{exact, gcd};
use super::rational;
use super::{AlgebraError, Alphabet, Monomial, Order, Poly, Rational};

/// A reduced quotient of polynomials in π, √2 and the set-up's constants.
///
/// A single-term denominator, the usual case, moves into the numerator as negative exponents; the rest is √2-free,
/// shares no factor with the numerator and has leading coefficient 1. So equal fractions are equal values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fraction {
    numerator: Poly,
    /// Several terms, or none for 1.
    denominator: Option<Poly>,
}

impl Fraction {
    /// 0
    pub fn zero() -> Self {
        Self::whole(Poly::ZERO)
    }

    /// 1
    pub fn one() -> Self {
        Self::whole(Poly::one())
    }

    /// A polynomial in constants.
    pub fn whole(numerator: Poly) -> Self {
        Self { numerator, denominator: None }
    }

    /// The numerator.
    pub fn numerator(&self) -> &Poly {
        &self.numerator
    }

    /// The denominator: a polynomial of several terms, or `None` for 1.
    pub fn denominator(&self) -> Option<&Poly> {
        self.denominator.as_ref()
    }

    /// The polynomial, where the denominator is 1.
    pub fn as_poly(&self) -> Option<&Poly> {
        self.denominator.is_none().then_some(&self.numerator)
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    /// `numerator / denominator` in reduced form.
    pub fn new(numerator: Poly, denominator: Poly, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let (mut numerator, mut denominator) = (numerator.normal(alphabet)?, denominator.normal(alphabet)?);
        if denominator.terms().iter().any(|(m, _)| m.exponent(Alphabet::ROOT2) != 0) {
            let conjugate = conjugate(&denominator)?;
            numerator = numerator.times(&conjugate, Order::NOMINAL)?.normal(alphabet)?;
            denominator = denominator.times(&conjugate, Order::NOMINAL)?.normal(alphabet)?;
        }
        if denominator.terms().len() > 1 {
            let shift = Poly::term(lowest(&denominator).recip()?, rational::integer(1));
            denominator = denominator.times(&shift, Order::NOMINAL)?;
            (numerator, denominator) = cancelled(&numerator.times(&shift, Order::NOMINAL)?, &denominator)?;
        }
        match denominator.terms() {
            [] => Err(AlgebraError::DivisionByZero),
            [(m, c)] => {
                let inverse = Poly::term(m.recip()?, c.recip()?);
                Ok(Self::whole(numerator.times(&inverse, Order::NOMINAL)?.normal(alphabet)?))
            }
            _ => Self::over(numerator, denominator),
        }
    }

    /// Of coprime polynomials, the denominator as it stands in a fraction up to a number.
    fn over(numerator: Poly, denominator: Poly) -> Result<Self, AlgebraError> {
        let inverse = denominator.terms().last().map_or(Ok(Rational::ONE), |(_, lead)| lead.recip())?;
        let denominator = Some(denominator.scaled(&inverse)?).filter(|d| d.as_number().is_none());
        Ok(Self { numerator: numerator.scaled(&inverse)?, denominator })
    }

    fn below(&self) -> Poly {
        self.denominator.clone().unwrap_or_else(Poly::one)
    }

    /// −x
    pub fn negated(&self) -> Self {
        Self { numerator: self.numerator.negated(), denominator: self.denominator.clone() }
    }

    /// `self · other`
    pub fn times(&self, other: &Self, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        if self.is_zero() || other.is_zero() {
            return Ok(Self::zero());
        }
        if self.numerator.has_root2() && other.numerator.has_root2() {
            // Factors that are coprime to a denominator may have a product that is not: (x + √2 y)(x − √2 y) = x² − 2 y².
            let numerator = self.numerator.times(&other.numerator, Order::NOMINAL)?;
            return Self::new(numerator, self.below().times(&other.below(), Order::NOMINAL)?, alphabet);
        }
        let (left, below_right) = cancelled(&self.numerator, &other.below())?;
        let (right, below_left) = cancelled(&other.numerator, &self.below())?;
        Self::over(left.times(&right, Order::NOMINAL)?, below_left.times(&below_right, Order::NOMINAL)?)
    }

    /// `self − a · b`, the step of elimination.
    pub fn minus_product(&self, a: &Self, b: &Self, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let product = a.times(b, alphabet)?;
        if let (Some(p), Some(q)) = (self.as_poly(), product.as_poly()) {
            return Ok(Self::whole(p.minus(q)?));
        }
        // Over the least common denominator; only what both had in common can have become a factor of the numerator.
        let (left, right) = (self.below(), product.below());
        let common = gcd(&left, &right)?;
        let (left, right) = (exact(&left, &common)?, exact(&right, &common)?);
        let scaled = self.numerator.times(&right, Order::NOMINAL)?;
        let numerator = scaled.minus(&product.numerator.times(&left, Order::NOMINAL)?)?;
        let (numerator, common) = cancelled(&numerator, &common)?;
        let denominator = left.times(&right, Order::NOMINAL)?.times(&common, Order::NOMINAL)?;
        Self::over(numerator, denominator)
    }

    /// `1 / self`
    pub fn recip(&self, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        Self::new(self.below(), self.numerator.clone(), alphabet)
    }
}

/// Both without their greatest common divisor; the denominator has no √2 and no monomial as a factor.
fn cancelled(numerator: &Poly, denominator: &Poly) -> Result<(Poly, Poly), AlgebraError> {
    if denominator.as_number().is_some() {
        return Ok((numerator.clone(), denominator.clone()));
    }
    let lift = lowest(numerator);
    let lifted = numerator.times(&Poly::term(lift.recip()?, rational::integer(1)), Order::NOMINAL)?;
    let parts = by_root2(&lifted);
    let mut common = denominator.clone();
    for (_, part) in &parts {
        common = gcd(&common, part)?;
    }
    if common.as_number().is_some() {
        return Ok((numerator.clone(), denominator.clone()));
    }
    let mut reduced = Poly::ZERO;
    for (root, part) in parts {
        let factor = Poly::term(root.times(&lift, 0)?.unwrap_or(lift), rational::integer(1));
        reduced = reduced.plus(&exact(&part, &common)?.times(&factor, Order::NOMINAL)?)?;
    }
    Ok((reduced, exact(denominator, &common)?))
}

/// The greatest monomial without √2 that divides every term (with negative exponents where a term has them).
pub(super) fn lowest(p: &Poly) -> Monomial {
    let lowest = p.terms().iter().map(|(m, _)| *m).reduce(|a, b| a.lower(&b));
    lowest.unwrap_or(Monomial::ONE).with_exponent(Alphabet::ROOT2, 0)
}

/// `p = p₀ + √2 p₁`
pub(super) fn by_root2(p: &Poly) -> Vec<(Monomial, Poly)> {
    let root2 = Alphabet::ROOT2;
    p.group(|m| Monomial::nominal(root2, m.exponent(root2)), |m| m.with_exponent(root2, 0))
}

/// `p₀ − √2 p₁`
pub(super) fn conjugate(p: &Poly) -> Result<Poly, AlgebraError> {
    let sign = |m: &Monomial| if m.exponent(Alphabet::ROOT2) == 0 { 1 } else { -1 };
    Poly::from_terms(p.terms().iter().map(|(m, c)| (*m, c * &rational::integer(sign(m)))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_fractions_are_equal_values() {
        let mut alphabet = Alphabet::default();
        let [r, h] = ["R", "H"].map(|n| Poly::nominal(alphabet.constant(n).unwrap()));
        let root = Poly::nominal(Alphabet::ROOT2);
        let times = |a: &Poly, b: &Poly| a.times(b, Order::NOMINAL).unwrap();
        let (sum, scaled) = (r.plus(&h).unwrap(), r.plus(&times(&root, &h)).unwrap());
        let fraction = |n: &Poly, d: &Poly| Fraction::new(n.clone(), d.clone(), &alphabet).unwrap();
        assert_eq!(fraction(&times(&sum, &r), &times(&sum, &h)), fraction(&r, &h));
        assert_eq!(fraction(&times(&scaled, &sum), &times(&scaled, &h)), fraction(&sum, &h));
        let x = fraction(&sum, &scaled);
        assert_eq!(x.times(&x.recip(&alphabet).unwrap(), &alphabet).unwrap(), Fraction::one());
        assert!(x.minus_product(&x, &Fraction::one(), &alphabet).unwrap().is_zero());
        assert_eq!(Fraction::zero().recip(&alphabet), Err(AlgebraError::DivisionByZero));
    }
}
