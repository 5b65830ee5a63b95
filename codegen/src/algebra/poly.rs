//! Sparse polynomials, sorted by monomial, with no zero coefficient: equal polynomials are equal values.

use crate::limits::PAIRS;

use super::rational::{self, integer};
use super::{AlgebraError, ErrorId, MAX_ERROR_ORDER, Monomial, NominalId, Order, Rational};

/// A coefficient and its monomial.
pub type Term = (Monomial, Rational);

/// A polynomial with exact coefficients.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Poly {
    terms: Vec<Term>,
}

impl Poly {
    /// 0
    pub const ZERO: Self = Self { terms: Vec::new() };

    /// 1
    pub fn one() -> Self {
        Self::constant(integer(1))
    }

    /// A number.
    pub fn constant(value: Rational) -> Self {
        Self::term(Monomial::ONE, value)
    }

    /// An integer.
    pub fn integer(n: i128) -> Self {
        Self::constant(integer(n))
    }

    /// A single term.
    pub fn term(monomial: Monomial, coefficient: Rational) -> Self {
        if coefficient.is_zero() { Self::ZERO } else { Self { terms: vec![(monomial, coefficient)] } }
    }

    /// A nominal symbol.
    pub fn nominal(id: NominalId) -> Self {
        Self::term(Monomial::nominal(id, 1), integer(1))
    }

    /// An error symbol.
    pub fn error(id: ErrorId) -> Self {
        Self::term(Monomial::error(id), integer(1))
    }

    /// Sorts, adds equal monomials up and drops zeros.
    pub fn from_terms(mut terms: Vec<Term>) -> Result<Self, AlgebraError> {
        if !terms.is_sorted_by(|a, b| a.0 < b.0) {
            terms.sort_unstable_by_key(|t| t.0);
            let mut kept = 0;
            for i in 1..terms.len() {
                if terms[kept].0 == terms[i].0 {
                    terms[kept].1 = &terms[kept].1 + &terms[i].1;
                } else {
                    kept += 1;
                    terms.swap(kept, i);
                }
            }
            terms.truncate(kept + 1);
        }
        terms.retain(|t| !t.1.is_zero());
        Ok(Self { terms })
    }

    /// The terms in ascending order of their monomials.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    pub(super) fn into_terms(self) -> Vec<Term> {
        self.terms
    }

    /// The terms as they are printed: by errors, then highest in cosine, sine, sweep and last the constants.
    pub fn printed(&self) -> Vec<Term> {
        let mut terms = self.terms.clone();
        let backwards = |m: &Monomial| m.powers().iter().rev().copied().collect::<Vec<_>>();
        terms.sort_by_cached_key(|(m, _)| (m.only_errors(), core::cmp::Reverse(backwards(m))));
        terms
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number, if it is one.
    pub fn as_number(&self) -> Option<Rational> {
        match self.terms.as_slice() {
            [] => Some(integer(0)),
            [(m, c)] if *m == Monomial::ONE => Some(c.clone()),
            _ => None,
        }
    }

    /// Sum.
    pub fn plus(&self, other: &Self) -> Result<Self, AlgebraError> {
        let (mut a, mut b) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        loop {
            match (a.peek(), b.peek()) {
                (Some(x), Some(y)) if x.0 == y.0 => {
                    let sum = &x.1 + &y.1;
                    if !sum.is_zero() {
                        terms.push((x.0, sum));
                    }
                    a.next();
                    b.next();
                }
                (Some(x), Some(y)) if x.0 < y.0 => terms.extend(a.next().cloned()),
                (_, Some(_)) => terms.extend(b.next().cloned()),
                (Some(_), None) => terms.extend(a.next().cloned()),
                (None, None) => return Ok(Self { terms }),
            }
        }
    }

    /// Difference.
    pub fn minus(&self, other: &Self) -> Result<Self, AlgebraError> {
        self.plus(&other.negated())
    }

    /// −p
    pub fn negated(&self) -> Self {
        Self { terms: self.terms.iter().map(|(m, c)| (*m, -c)).collect() }
    }

    /// Product with a number.
    pub fn scaled(&self, factor: &Rational) -> Result<Self, AlgebraError> {
        if factor.is_zero() {
            return Ok(Self::ZERO);
        }
        Ok(Self { terms: self.terms.iter().map(|(m, c)| (*m, c * factor)).collect() })
    }

    /// Quotient by a single term.
    pub(super) fn over(&self, monomial: Monomial, number: &Rational) -> Result<Self, AlgebraError> {
        let inverse = monomial.recip()?;
        let over = |(m, c): &Term| m.times(&inverse, MAX_ERROR_ORDER)?.map(|m| Ok((m, c.over(number)?))).transpose();
        let terms: Result<Vec<Option<Term>>, AlgebraError> = self.terms.iter().map(over).collect();
        Ok(Self { terms: terms?.into_iter().flatten().collect() })
    }

    /// What its numbers have in common, and itself over that: with coprime whole coefficients.
    ///
    /// # Errors
    /// As of every exact computation.
    pub fn primitive(&self) -> Result<(Rational, Self), AlgebraError> {
        let content = rational::content(self.terms.iter().map(|(_, c)| c));
        let whole = if content.is_one() { self.clone() } else { self.over(Monomial::ONE, &content)? };
        Ok((content, whole))
    }

    /// Appends the terms of `self · other` up to `order` errors to `out`, unsorted: the inner loop of every 4×4 product.
    pub(super) fn product_into(&self, other: &Self, order: Order, out: &mut Vec<Term>) -> Result<(), AlgebraError> {
        if self.terms.len() * other.terms.len() > PAIRS {
            return Err(AlgebraError::TooLong);
        }
        if [self, other].into_iter().flat_map(Self::terms).any(|(_, c)| c.is_long_fraction()) {
            // Common divisors are searched once for each term of the product, not for each pair.
            let ((common, a), (factor, b)) = (self.primitive()?, other.primitive()?);
            out.extend(a.times(&b, order)?.scaled(&(&common * &factor))?.terms);
            return Ok(());
        }
        for (ma, ca) in &self.terms {
            for (mb, cb) in &other.terms {
                if let Some(m) = ma.times(mb, order.get())? {
                    out.push((m, ca * cb));
                }
            }
        }
        Ok(())
    }

    /// Product without the terms of more than `order` errors, which are never formed.
    pub fn times(&self, other: &Self, order: Order) -> Result<Self, AlgebraError> {
        let mut terms = Vec::with_capacity(PAIRS.min(self.terms.len() * other.terms.len()));
        self.product_into(other, order, &mut terms)?;
        Self::from_terms(terms)
    }

    /// `self^exponent`, truncated.
    pub fn power(&self, exponent: u32, order: Order) -> Result<Self, AlgebraError> {
        (0..exponent).try_fold(Self::one(), |p, _| p.times(self, order))
    }

    /// The terms with exactly `order` errors.
    pub fn of_order(&self, order: usize) -> Self {
        Self { terms: self.terms.iter().filter(|(m, _)| m.order() == order).cloned().collect() }
    }

    /// Splits by errors: each product of errors with its nominal coefficient, in ascending order.
    pub fn by_errors(&self) -> Vec<(Monomial, Poly)> {
        self.group(Monomial::only_errors, Monomial::without_errors)
    }

    /// Splits into `key(m) · rest(m)`, keys ascending.
    pub fn group(
        &self,
        key: impl Fn(&Monomial) -> Monomial,
        rest: impl Fn(&Monomial) -> Monomial,
    ) -> Vec<(Monomial, Poly)> {
        let mut terms: Vec<(Monomial, Term)> = self.terms.iter().map(|(m, c)| (key(m), (rest(m), c.clone()))).collect();
        terms.sort_unstable_by_key(|t| (t.0, t.1.0));
        let mut groups: Vec<(Monomial, Poly)> = Vec::new();
        for (k, term) in terms {
            match groups.last_mut() {
                Some((last, poly)) if *last == k => poly.terms.push(term),
                _ => groups.push((k, Poly { terms: vec![term] })),
            }
        }
        groups
    }

    /// Value with `nominal` and `error` giving the symbols' values.
    pub fn evaluate(&self, nominal: impl Fn(NominalId) -> f64, error: impl Fn(ErrorId) -> f64) -> f64 {
        self.terms
            .iter()
            .map(|(m, c)| rational::to_f64(c) * m.evaluate(&nominal) * m.errors().map(&error).product::<f64>())
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Alphabet, Quantity};
    use super::*;

    fn circle() -> (Alphabet, Poly, Poly) {
        let mut alphabet = Alphabet::default();
        let sweep = alphabet.sweep("a").unwrap();
        let [_, sin, cos] = alphabet.sweep_symbols(sweep);
        (alphabet, Poly::nominal(sin), Poly::nominal(cos))
    }

    #[test]
    fn products_of_two_errors_are_never_formed_at_order_one() {
        let mut alphabet = Alphabet::default();
        let d = Poly::error(alphabet.error("d", Quantity::Length).unwrap());
        let e = Poly::error(alphabet.error("e", Quantity::Angle).unwrap());
        let sum = Poly::one().plus(&d).unwrap().plus(&e).unwrap();
        assert_eq!(sum.times(&sum, Order::LINEAR).unwrap().terms().len(), 3);
        assert_eq!(sum.times(&sum, Order::new(2).unwrap()).unwrap().terms().len(), 6);
        assert_eq!(Order::new(9), Err(AlgebraError::OrderTooHigh));
    }

    #[test]
    fn exponent_overflow_is_an_error() {
        let (_, s, _) = circle();
        let high = s.power(100, Order::NOMINAL).unwrap();
        assert_eq!(high.times(&high, Order::NOMINAL), Err(AlgebraError::ExponentOverflow));
    }

    #[test]
    fn multiplication_distributes_and_commutes() {
        let (alphabet, s, c) = circle();
        let order = Order::LINEAR;
        let p = s.plus(&c.scaled(&integer(3)).unwrap()).unwrap();
        let q = s.minus(&Poly::one()).unwrap();
        let left = p.times(&q, order).unwrap().normal(&alphabet).unwrap();
        let right = q.times(&p, order).unwrap().normal(&alphabet).unwrap();
        let parts = p.times(&s, order).unwrap().minus(&p).unwrap().normal(&alphabet).unwrap();
        assert_eq!(left, right);
        assert_eq!(left, parts);
        assert!(left.minus(&right).unwrap().is_zero());
    }

    #[test]
    fn long_fractions_multiply_like_short_ones() {
        let (_, s, c) = circle();
        let long = |n: i128| &Rational::new(n, (1 << 100) - 3) * &Rational::new(7, (1 << 90) - n);
        let p = s.scaled(&long(3)).unwrap().plus(&c.scaled(&long(-5)).unwrap()).unwrap();
        let q = c.scaled(&long(11)).unwrap().plus(&Poly::constant(Rational::new(2, 3))).unwrap();
        assert!(p.terms.iter().all(|(_, c)| c.is_long_fraction()));
        let pair = |((m, a), (n, b)): (&Term, &Term)| (m.times(n, 0).unwrap().unwrap(), a * b);
        let pairs = p.terms.iter().flat_map(|a| q.terms.iter().map(move |b| pair((a, b))));
        assert_eq!(p.times(&q, Order::NOMINAL).unwrap(), Poly::from_terms(pairs.collect()).unwrap());
    }
}
