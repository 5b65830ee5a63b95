//! Symbols of a path whose angles are given by their sine and cosine: what they mean.

use super::{Monomial, Rational, SweepId};

/// The terms of a polynomial, where no polynomial can stand.
pub type Terms = Vec<(Monomial, Rational)>;

/// The positive root of a polynomial of the sweep: a symbol w with w² = `of`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// What it is the root of.
    pub of: Terms,
}

/// The angle that has these for its sine and its cosine, −π to π.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arctangent {
    /// The sweep along which it turns.
    pub sweep: SweepId,
    /// Its sine.
    pub sin: Terms,
    /// Its cosine.
    pub cos: Terms,
}
