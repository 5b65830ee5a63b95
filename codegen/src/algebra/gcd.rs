//! Exact division and greatest common divisors of polynomials in constants, over the rationals.
//!
//! Inputs have no errors, no √2 and no negative exponents. Euclid's algorithm on primitive parts, one symbol
//! after another: the polynomials met in a base-parameter factorisation have a handful of terms.

use super::rational;
use super::{AlgebraError, Monomial, NominalId, Order, Poly};

/// `a / b` if it leaves no remainder.
pub(super) fn divide(a: &Poly, b: &Poly) -> Result<Option<Poly>, AlgebraError> {
    let Some((lead, coefficient)) = b.terms().last() else { return Err(AlgebraError::DivisionByZero) };
    let inverse = Poly::term(lead.recip()?, coefficient.recip()?);
    let (mut rest, mut quotient) = (a.clone(), Vec::new());
    while let Some((m, c)) = rest.terms().last() {
        let step = Poly::term(*m, c.clone()).times(&inverse, Order::NOMINAL)?;
        if step.terms().iter().any(|(m, _)| m.powers().iter().any(|p| *p < 0)) {
            return Ok(None);
        }
        rest = rest.minus(&step.times(b, Order::NOMINAL)?)?;
        quotient.extend_from_slice(step.terms());
    }
    Poly::from_terms(quotient).map(Some)
}

/// The greatest common divisor, up to a rational factor.
pub(super) fn gcd(a: &Poly, b: &Poly) -> Result<Poly, AlgebraError> {
    if a.is_zero() || a == b {
        return Ok(b.clone());
    }
    if b.is_zero() {
        return Ok(a.clone());
    }
    let Some(symbol) = symbols(a).chain(symbols(b)).min() else { return Ok(Poly::one()) };
    let (content_a, content_b) = (content(a, symbol)?, content(b, symbol)?);
    let common = gcd(&content_a, &content_b)?;
    let (mut p, mut q) = (exact(a, &content_a)?, exact(b, &content_b)?);
    if degree(&p, symbol) < degree(&q, symbol) {
        core::mem::swap(&mut p, &mut q);
    }
    while degree(&q, symbol) > 0 {
        let remainder = pseudo_remainder(&p, &q, symbol)?;
        p = q;
        if remainder.is_zero() {
            return common.times(&p, Order::NOMINAL);
        }
        q = exact(&remainder, &content(&remainder, symbol)?)?;
    }
    Ok(common)
}

fn symbols(p: &Poly) -> impl Iterator<Item = NominalId> {
    let present = |i: usize| p.terms().iter().any(|(m, _)| m.powers()[i] != 0);
    (0..super::MAX_NOMINALS).filter(move |&i| present(i)).map(|i| NominalId(i as u8))
}

fn degree(p: &Poly, symbol: NominalId) -> i8 {
    p.terms().iter().map(|(m, _)| m.exponent(symbol)).max().unwrap_or(0)
}

/// Coefficients of the powers of `symbol`.
fn coefficients(p: &Poly, symbol: NominalId) -> Vec<(Monomial, Poly)> {
    p.group(|m| Monomial::nominal(symbol, m.exponent(symbol)), |m| m.with_exponent(symbol, 0))
}

/// The greatest common divisor of the coefficients, with a factor that makes the primitive part's numbers small integers.
fn content(p: &Poly, symbol: NominalId) -> Result<Poly, AlgebraError> {
    let mut divisor = Poly::ZERO;
    for (_, c) in coefficients(p, symbol) {
        divisor = gcd(&divisor, &c)?;
    }
    if let Some((_, lead)) = divisor.terms().last() {
        divisor = divisor.scaled(&lead.recip()?)?;
    }
    divisor.scaled(&rational::content(p.terms().iter().map(|(_, c)| c)))
}

fn exact(a: &Poly, b: &Poly) -> Result<Poly, AlgebraError> {
    Ok(divide(a, b)?.unwrap_or_else(|| a.clone()))
}

fn pseudo_remainder(a: &Poly, b: &Poly, symbol: NominalId) -> Result<Poly, AlgebraError> {
    let lead = |p: &Poly| coefficients(p, symbol).pop().map(|(_, c)| c).unwrap_or_default();
    let (lead_b, degree_b) = (lead(b), degree(b, symbol));
    let mut rest = a.clone();
    while !rest.is_zero() && degree(&rest, symbol) >= degree_b {
        let shift = Poly::term(Monomial::nominal(symbol, degree(&rest, symbol) - degree_b), rational::integer(1));
        let subtract = lead(&rest).times(&shift, Order::NOMINAL)?.times(b, Order::NOMINAL)?;
        rest = rest.times(&lead_b, Order::NOMINAL)?.minus(&subtract)?;
    }
    Ok(rest)
}

#[cfg(test)]
mod tests {
    use super::super::Alphabet;
    use super::*;

    #[test]
    fn common_factors_of_several_symbols_are_found() {
        let mut alphabet = Alphabet::default();
        let [r, h, l] = ["R", "H", "L"].map(|n| Poly::nominal(alphabet.constant(n).unwrap()));
        let times = |a: &Poly, b: &Poly| a.times(b, Order::NOMINAL).unwrap();
        let (u, v, w) = (r.plus(&h).unwrap(), r.minus(&l).unwrap(), times(&h, &l).plus(&Poly::integer(3)).unwrap());
        let (a, b) = (times(&times(&u, &v), &u), times(&times(&u, &w), &u));
        let g = gcd(&a, &b).unwrap();
        assert!(divide(&g, &times(&u, &u)).unwrap().unwrap().as_number().is_some());
        assert!(gcd(&v, &w).unwrap().as_number().is_some());
        assert_eq!(divide(&a, &u).unwrap(), Some(times(&u, &v)));
        assert_eq!(divide(&v, &u).unwrap(), None);
    }
}
