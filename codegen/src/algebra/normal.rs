//! The one form of a polynomial under what is known of its symbols: sines and cosines, √2, roots.

use super::rational::{self, integer};
use super::{AlgebraError, Alphabet, MAX_ERROR_ORDER, Monomial, Order, Poly, Term};

impl Poly {
    /// The form under cos² = 1 − sin² for every sweep, √2² = 2 and the square of every root: cosines, √2 and roots at most once in
    /// a term. It is unique where it divides by no root.
    pub fn normal(&self, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let mut p = self.clone();
        for (id, root) in alphabet.roots() {
            while p.terms().iter().any(|(m, _)| m.exponent(id) >= 2) {
                let (high, mut low): (Vec<Term>, Vec<Term>) =
                    p.into_terms().into_iter().partition(|(m, _)| m.exponent(id) >= 2);
                let square = Self::from_terms(root.of.clone())?;
                let lowered = high.into_iter().map(|(m, c)| (m.with_exponent(id, m.exponent(id) - 2), c));
                let lowered = Self::from_terms(lowered.collect())?;
                low.extend(lowered.times(&square, Order::MOST)?.into_terms());
                p = Self::from_terms(low)?;
            }
        }
        let mut p = p.normal_root2()?;
        for (sin, cos) in alphabet.circles() {
            let reducible = |m: &Monomial| m.exponent(cos) >= 2;
            while p.terms().iter().any(|(m, _)| reducible(m)) {
                let mut terms = Vec::with_capacity(2 * p.terms().len());
                for (m, c) in p.into_terms() {
                    if reducible(&m) {
                        let lower = m.with_exponent(cos, m.exponent(cos) - 2);
                        let sin2 = lower.times(&Monomial::nominal(sin, 2), MAX_ERROR_ORDER)?;
                        terms.extend(sin2.map(|m| (m, -&c)));
                        terms.push((lower, c));
                    } else {
                        terms.push((m, c));
                    }
                }
                p = Self::from_terms(terms)?;
            }
        }
        Ok(p)
    }

    /// Whether it is zero along every path, whatever it divides by.
    pub fn vanishes(&self, alphabet: &Alphabet) -> Result<bool, AlgebraError> {
        Ok(self
            .times(&Self::term(Self::divisor([self], alphabet), integer(1)), Order::MOST)?
            .normal(alphabet)?
            .is_zero())
    }

    /// The powers of roots that any of some polynomials divides by.
    pub fn divisor<'a>(polys: impl IntoIterator<Item = &'a Self>, alphabet: &Alphabet) -> Monomial {
        let monomials = || polys.into_iter().flat_map(|p| p.terms().iter().map(|(m, _)| *m));
        let lowest = monomials().fold(Monomial::ONE, |lowest, m| lowest.lower(&m));
        alphabet.roots().fold(Monomial::ONE, |m, (id, _)| m.with_exponent(id, -lowest.exponent(id)))
    }

    /// √2² = 2 put in, and nothing else.
    pub(crate) fn normal_root2(&self) -> Result<Self, AlgebraError> {
        let root2 = Alphabet::ROOT2;
        if self.terms().iter().all(|(m, _)| matches!(m.exponent(root2), 0 | 1)) {
            return Ok(self.clone());
        }
        let reduce = |(m, c): &Term| {
            let exponent = m.exponent(root2);
            let twos = rational::power_of_two(exponent.div_euclid(2));
            (m.with_exponent(root2, exponent.rem_euclid(2)), c * &twos)
        };
        Self::from_terms(self.terms().iter().map(reduce).collect())
    }

    pub(super) fn has_root2(&self) -> bool {
        self.terms().iter().any(|(m, _)| m.exponent(Alphabet::ROOT2) != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rational;
    use super::*;

    #[test]
    fn powers_of_cosine_have_one_form() {
        let mut alphabet = Alphabet::default();
        let sweep = alphabet.sweep("a").unwrap();
        let [_, s, c] = alphabet.sweep_symbols(sweep).map(Poly::nominal);
        let order = Order::LINEAR;
        let c4 = c.power(4, order).unwrap().normal(&alphabet).unwrap();
        let s2 = s.power(2, order).unwrap();
        let once = Poly::one().minus(&s2).unwrap();
        assert_eq!(c4, once.times(&once, order).unwrap());
        let circle = c.power(2, order).unwrap().plus(&s2).unwrap();
        assert_eq!(circle.normal(&alphabet).unwrap(), Poly::one());
    }

    #[test]
    fn root_two_squares_to_two_and_divides() {
        let alphabet = Alphabet::default();
        let root = Poly::nominal(Alphabet::ROOT2);
        let order = Order::NOMINAL;
        assert_eq!(root.times(&root, order).unwrap().normal(&alphabet).unwrap(), Poly::integer(2));
        let inverse = Poly::term(Monomial::nominal(Alphabet::ROOT2, -1), integer(1));
        let half = root.scaled(&Rational::new(1, 2)).unwrap();
        assert_eq!(inverse.normal(&alphabet).unwrap(), half);
    }
}
