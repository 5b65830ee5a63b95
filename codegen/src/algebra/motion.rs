//! What of a polynomial moves along a sweep.

use super::{Alphabet, Monomial, Poly};

impl Poly {
    /// By products of what moves along a sweep, ascending; what is left is of constants.
    pub(crate) fn by_motion(&self, alphabet: &Alphabet) -> Vec<(Monomial, Self)> {
        let without = |m: &Monomial, constants: bool| {
            let ids = alphabet.nominals().filter(|(id, _)| alphabet.is_constant(*id) == constants);
            ids.fold(*m, |m, (id, _)| m.with_exponent(id, 0))
        };
        self.group(|m| without(m, true), |m| without(m, false))
    }
}
