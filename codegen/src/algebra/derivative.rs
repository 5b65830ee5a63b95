//! The derivative of a polynomial along its sweep.

use super::{AlgebraError, Alphabet, Order, Poly, SweepId, integer};

impl Poly {
    /// d/d(sweep) of a polynomial in constants, the sweep, its sine and its cosine, in normal form.
    ///
    /// # Errors
    /// [`AlgebraError`] where the exact arithmetic overflows.
    pub fn derivative(&self, sweep: SweepId, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let [own, sin, cos] = alphabet.sweep_symbols(sweep);
        let inner = [(own, Self::one()), (sin, Self::nominal(cos)), (cos, Self::nominal(sin).negated())];
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
