//! The signs of velocities: where along a run something turns back.

use super::gcd::{exact, gcd};
use super::sense::Sense;
use super::{AlgebraError, Alphabet, Monomial, Order, Poly, Rational, SweepId, integer};

impl Sense {
    /// The sense of a coordinate along its run; `None` if it does not move. What is positive wherever lengths are is left out of
    /// it, so that equal signs are equal values, up to a sign.
    ///
    /// # Errors
    /// [`AlgebraError`] where the exact arithmetic overflows.
    pub fn along(coordinate: &Poly, sweep: SweepId, alphabet: &Alphabet) -> Result<Option<Self>, AlgebraError> {
        let velocity = coordinate.derivative(sweep, alphabet)?;
        if velocity.is_zero() {
            return Ok(None);
        }
        Ok(Some(Self { sweep, of: without_content(&velocity, alphabet)?.terms().to_vec() }))
    }

    /// That of the sweep itself.
    pub fn of_sweep(sweep: SweepId) -> Self {
        Self { sweep, of: Poly::one().terms().to_vec() }
    }

    /// The same of what moves the other way.
    pub fn reversed(&self) -> Self {
        Self { sweep: self.sweep, of: self.of.iter().map(|(m, c)| (*m, -c.clone())).collect() }
    }
}

/// `p` over its positive content: powers of constants, a common factor whose terms all have one sign, the leading coefficient's
/// size.
fn without_content(p: &Poly, alphabet: &Alphabet) -> Result<Poly, AlgebraError> {
    let ids = || alphabet.nominals().map(|(id, _)| id);
    let lowest = ids().filter(|id| alphabet.is_constant(*id)).fold(Monomial::ONE, |lowest, id| {
        let exponent = p.terms().iter().map(|(m, _)| m.exponent(id)).min();
        lowest.with_exponent(id, exponent.unwrap_or(0))
    });
    let whole = p.over(lowest, &Rational::ONE)?;
    let groups = whole.by_motion(alphabet);
    let mut content = Poly::ZERO;
    for (_, factor) in &groups {
        content = if factor.has_root2() { Poly::one() } else { gcd(&content, factor)? };
    }
    let one_sign =
        content.terms().iter().all(|(_, c)| c.is_negative()) || content.terms().iter().all(|(_, c)| !c.is_negative());
    let mut rest = Poly::ZERO;
    for (moving, factor) in &groups {
        let factor = if one_sign { exact(factor, &content)? } else { factor.clone() };
        rest = rest.plus(&factor.times(&Poly::term(*moving, integer(1)), Order::NOMINAL)?)?;
    }
    if one_sign && content.terms().iter().all(|(_, c)| c.is_negative()) {
        rest = rest.negated();
    }
    match rest.printed().first() {
        Some((_, leading)) => rest.over(Monomial::ONE, &leading.abs()),
        None => Ok(rest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Scope, parse};

    #[test]
    fn positive_factors_are_left_out() {
        let mut alphabet = Alphabet::default();
        for name in ["R", "L"] {
            alphabet.constant(name).unwrap();
        }
        let sweep = alphabet.sweep("a").unwrap();
        let poly = |text: &str| {
            Scope { alphabet: &alphabet, sweep: Some(sweep), defined: &[] }.poly(&parse(text).unwrap()).unwrap()
        };
        let sense = |text: &str| {
            let sense = Sense::along(&poly(text), sweep, &alphabet).unwrap();
            sense.map(|sense| Poly::from_terms(sense.of).unwrap())
        };
        assert_eq!(sense("R"), None);
        assert_eq!(sense("2*a - pi/4"), Some(Poly::one()));
        for text in ["R*cos(a)", "L - R*cos(a)", "-3*cos(a)/R", "(R + L)*cos(a)", "(R*L + 2*R**2)*cos(a)"] {
            let sign = if text.starts_with("L -") || text.starts_with('-') { "sin(a)" } else { "-sin(a)" };
            assert_eq!(sense(text), Some(poly(sign)), "{text}");
        }
        // A factor that may have either sign stays.
        assert_eq!(sense("(R - L)*cos(a)"), Some(poly("-(R - L)*sin(a)")));
        assert_eq!(sense("R*sin(a) + sqrt(2)*L*cos(a)"), Some(poly("R*cos(a) - sqrt(2)*L*sin(a)")));
    }
}
