//! Polynomials of one coordinate with exact coefficients.

use crate::algebra::{AlgebraError, Alphabet, Order, Poly, Rational, at};

/// A polynomial of one coordinate: coefficients of x⁰, x¹, …, each exact in π, √2 and the constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Univariate(pub Vec<Poly>);

impl Univariate {
    /// xⁿ
    pub fn power(n: usize) -> Self {
        Self((0..=n).map(|k| if k == n { Poly::one() } else { Poly::ZERO }).collect())
    }

    /// The power of its last coefficient.
    pub fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// The value at `x`, products left as they stand: `(R c)²` becomes `R² c²`, not `R² (1 − s²)`.
    pub fn at(&self, x: &Poly) -> Result<Poly, AlgebraError> {
        let (mut sum, mut power) = (Poly::ZERO, Poly::one());
        for (n, coefficient) in self.0.iter().enumerate() {
            if n > 0 {
                power = power.times(x, Order::NOMINAL)?;
            }
            sum = sum.plus(&coefficient.times(&power, Order::NOMINAL)?)?;
        }
        Ok(sum)
    }

    /// The coefficients of x⁰, x¹, … as numbers.
    pub fn coefficients(&self, alphabet: &Alphabet, constant: &impl Fn(&str) -> f64) -> Vec<f64> {
        self.0.iter().map(|c| at(c, alphabet, 0.0, constant)).collect()
    }

    /// The value at a number.
    pub fn value(&self, x: f64, alphabet: &Alphabet, constant: &impl Fn(&str) -> f64) -> f64 {
        self.coefficients(alphabet, constant).iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// The n-th derivative.
    pub(super) fn derivative(&self, n: u32) -> Result<Self, AlgebraError> {
        (0..n).try_fold(self.clone(), |f, _| {
            let lowered = f.0.iter().enumerate().skip(1).map(|(k, c)| c.scaled(&Rational::from(k as i128)));
            Ok(Self(lowered.collect::<Result<_, _>>()?))
        })
    }

    /// The product.
    pub(super) fn times(&self, other: &Self) -> Result<Self, AlgebraError> {
        let mut product = vec![Poly::ZERO; (self.0.len() + other.0.len()).saturating_sub(1)];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = product[i + j].plus(&a.times(b, Order::NOMINAL)?)?;
            }
        }
        Ok(Self(product))
    }

    /// The sum.
    pub(super) fn plus(&self, other: &Self) -> Result<Self, AlgebraError> {
        let zero = Poly::ZERO;
        let coefficient = |n: usize| self.0.get(n).unwrap_or(&zero).plus(other.0.get(n).unwrap_or(&zero));
        (0..self.0.len().max(other.0.len())).map(coefficient).collect::<Result<_, _>>().map(Self)
    }
}
