//! The functions of a basis, each stated once: what it is, how its coefficient is called and in which unit that is.

use super::Univariate;
use crate::ids::TermId;

/// A function of an axis' coordinate x.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BasisFunction {
    /// 1, of a location error: it is the same wherever the axis is.
    One,
    /// A polynomial of x.
    Polynomial(Univariate),
    /// `cos kx`, of a rotary axis.
    Cosine(u8),
    /// `sin kx`, of a rotary axis.
    Sine(u8),
}

/// What functions of a coordinate are made of, wherever they are needed: numbers, exact polynomials along a run, nodes of a
/// graph, text. Each has its own coordinate.
pub trait Arithmetic {
    /// A function in this form.
    type Value;

    /// A polynomial of the coordinate.
    fn polynomial(&mut self, f: &Univariate) -> Self::Value;

    /// The cosine of a multiple of the coordinate.
    fn cosine(&mut self, multiple: u8) -> Self::Value;

    /// The sine of a multiple of the coordinate.
    fn sine(&mut self, multiple: u8) -> Self::Value;
}

impl BasisFunction {
    /// The function in the form of an arithmetic.
    pub fn of<A: Arithmetic>(&self, arithmetic: &mut A) -> A::Value {
        match self {
            Self::One => arithmetic.polynomial(&Univariate::power(0)),
            Self::Polynomial(f) => arithmetic.polynomial(f),
            Self::Cosine(k) => arithmetic.cosine(*k),
            Self::Sine(k) => arithmetic.sine(*k),
        }
    }

    /// What its coefficient's name ends in, as this term of a basis: `1`, `_cos1`, `_sin1`; a location error is its own.
    pub fn suffix(&self, term: TermId) -> String {
        match self {
            Self::One => String::new(),
            Self::Polynomial(_) => (usize::from(term) + 1).to_string(),
            Self::Cosine(k) => format!("_cos{k}"),
            Self::Sine(k) => format!("_sin{k}"),
        }
    }

    /// The unit of its coefficient, from those of the error and the coordinate: `rad/rad^2`.
    pub fn coefficient_unit(&self, error: &str, coordinate: &str) -> String {
        match self {
            Self::Polynomial(f) => format!("{error}/{coordinate}^{}", f.degree()),
            Self::One | Self::Cosine(_) | Self::Sine(_) => error.to_owned(),
        }
    }
}
