//! Sparse polynomials, sorted by monomial, with no zero coefficient: equal polynomials are equal values.

use crate::limits::PAIRS;

use super::rational::{self, integer};
use super::{AlgebraError, Alphabet, ErrorId, MAX_ERROR_ORDER, Monomial, NominalId, Order, Rational};

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

    /// Appends the terms of `self · other` up to `order` errors to `out`, unsorted: the inner loop of every 4×4 product.
    pub(super) fn product_into(&self, other: &Self, order: Order, out: &mut Vec<Term>) -> Result<(), AlgebraError> {
        if self.terms.len() * other.terms.len() > PAIRS {
            return Err(AlgebraError::TooLong);
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

    /// The form under cos² = 1 − sin² for every sweep, √2² = 2 and the square of every root: cosines, √2 and roots at most once in
    /// a term. It is unique where it divides by no root.
    pub fn normal(&self, alphabet: &Alphabet) -> Result<Self, AlgebraError> {
        let mut p = self.clone();
        for (id, root) in alphabet.roots() {
            while p.terms.iter().any(|(m, _)| m.exponent(id) >= 2) {
                let (high, mut low): (Vec<Term>, Vec<Term>) =
                    p.terms.into_iter().partition(|(m, _)| m.exponent(id) >= 2);
                let square = Self::from_terms(root.of.clone())?;
                let lowered = high.into_iter().map(|(m, c)| (m.with_exponent(id, m.exponent(id) - 2), c));
                let lowered = Self::from_terms(lowered.collect())?;
                low.extend(lowered.times(&square, Order::MOST)?.terms);
                p = Self::from_terms(low)?;
            }
        }
        let mut p = p.normal_root2()?;
        for (sin, cos) in alphabet.circles() {
            let reducible = |m: &Monomial| m.exponent(cos) >= 2;
            while p.terms.iter().any(|(m, _)| reducible(m)) {
                let mut terms = Vec::with_capacity(2 * p.terms.len());
                for (m, c) in p.terms {
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
        let monomials = || polys.into_iter().flat_map(|p| p.terms.iter().map(|(m, _)| *m));
        let lowest = monomials().fold(Monomial::ONE, |lowest, m| lowest.lower(&m));
        alphabet.roots().fold(Monomial::ONE, |m, (id, _)| m.with_exponent(id, -lowest.exponent(id)))
    }

    /// √2² = 2 put in, and nothing else.
    pub(crate) fn normal_root2(&self) -> Result<Self, AlgebraError> {
        let root2 = Alphabet::ROOT2;
        if self.terms.iter().all(|(m, _)| matches!(m.exponent(root2), 0 | 1)) {
            return Ok(self.clone());
        }
        let reduce = |(m, c): &Term| {
            let exponent = m.exponent(root2);
            let twos = rational::power_of_two(exponent.div_euclid(2));
            (m.with_exponent(root2, exponent.rem_euclid(2)), c * &twos)
        };
        Self::from_terms(self.terms.iter().map(reduce).collect())
    }

    pub(super) fn has_root2(&self) -> bool {
        self.terms.iter().any(|(m, _)| m.exponent(Alphabet::ROOT2) != 0)
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
    use super::super::Quantity;
    use super::*;

    fn circle() -> (Alphabet, Poly, Poly) {
        let mut alphabet = Alphabet::default();
        let sweep = alphabet.sweep("a").unwrap();
        let [_, sin, cos] = alphabet.sweep_symbols(sweep);
        (alphabet, Poly::nominal(sin), Poly::nominal(cos))
    }

    #[test]
    fn powers_of_cosine_have_one_form() {
        let (alphabet, s, c) = circle();
        let order = Order::LINEAR;
        let c4 = c.power(4, order).unwrap().normal(&alphabet).unwrap();
        let s2 = s.power(2, order).unwrap();
        let once = Poly::one().minus(&s2).unwrap();
        assert_eq!(c4, once.times(&once, order).unwrap());
        let circle = c.power(2, order).unwrap().plus(&s2).unwrap();
        assert_eq!(circle.normal(&alphabet).unwrap(), Poly::one());
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
    fn root_two_squares_to_two_and_divides() {
        let alphabet = Alphabet::default();
        let root = Poly::nominal(Alphabet::ROOT2);
        let order = Order::NOMINAL;
        assert_eq!(root.times(&root, order).unwrap().normal(&alphabet).unwrap(), Poly::integer(2));
        let inverse = Poly::term(Monomial::nominal(Alphabet::ROOT2, -1), integer(1));
        let half = root.scaled(&Rational::new(1, 2)).unwrap();
        assert_eq!(inverse.normal(&alphabet).unwrap(), half);
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
}
