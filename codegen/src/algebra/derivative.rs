//! The derivative of a polynomial along its sweep.

use super::{AlgebraError, Alphabet, Monomial, Nominal, Order, Poly, Rational, SweepId, integer};

impl Poly {
    /// d/d(sweep) of a polynomial in constants, the sweep, its sine and its cosine, roots and angles of them, in normal form.
    ///
    /// # Errors
    /// [`AlgebraError`] where the exact arithmetic overflows.
    pub fn derivative(&self, sweep: SweepId, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let [own, sin, cos] = alphabet.sweep_symbols(sweep);
        let mut inner = vec![(own, Self::one()), (sin, Self::nominal(cos)), (cos, Self::nominal(sin).negated())];
        let has = |id| self.terms().iter().any(|(m, _)| m.exponent(id) != 0);
        for (id, nominal) in alphabet.nominals().filter(|(id, _)| has(*id)) {
            match nominal {
                // w′ = (w²)′ / 2w
                Nominal::Root { root, .. } => {
                    let square = Self::from_terms(root.of.clone())?.derivative(sweep, alphabet)?;
                    let over = Self::term(Monomial::nominal(id, -1), Rational::new(1, 2));
                    inner.push((id, square.times(&over, Order::NOMINAL)?));
                }
                // α′ = cos α · (sin α)′ − sin α · (cos α)′
                Nominal::Arctangent { angle, .. } => {
                    let [y, x] = [&angle.sin, &angle.cos].map(|terms| Self::from_terms(terms.clone()));
                    let (y, x) = (y?, x?);
                    let first = x.times(&y.derivative(sweep, alphabet)?, Order::NOMINAL)?;
                    let second = y.times(&x.derivative(sweep, alphabet)?, Order::NOMINAL)?;
                    inner.push((id, first.minus(&second)?));
                }
                _ => {}
            }
        }
        let mut sum = Self::ZERO;
        for (m, c) in self.terms() {
            for (id, by) in &inner {
                let exponent = m.exponent(*id);
                if exponent != 0 {
                    let lowered = Self::term(m.with_exponent(*id, exponent - 1), c * &integer(exponent.into()));
                    sum = sum.plus(&lowered.times(by, Order::NOMINAL)?)?;
                }
            }
        }
        sum.normal(alphabet)
    }
}
