//! What is assumed of a motion error: none, a known function, a sum of functions.

use super::function::{Arithmetic, BasisFunction};
use super::{Coordinate, Univariate};
use crate::algebra::{AlgebraError, Alphabet, Angle, Poly};
use crate::ids::TermId;
use typed_index_collections::{TiSlice, TiVec};

/// What is assumed of a motion error.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// Negligible.
    Zero,
    /// Given as data from another measurement.
    Known,
    /// A sum of functions of the coordinate with unknown coefficients.
    Functions(TiVec<TermId, BasisFunction>),
}

impl Basis {
    /// Polynomials x, x², … xⁿ of T(6); a constant belongs to the location errors.
    pub fn polynomial(degree: u8) -> Self {
        Self::polynomials((1..=usize::from(degree)).map(Univariate::power))
    }

    /// Polynomials of the coordinate.
    pub fn polynomials(functions: impl IntoIterator<Item = Univariate>) -> Self {
        Self::Functions(functions.into_iter().map(BasisFunction::Polynomial).collect())
    }

    /// `Σ cₖ cos kx + sₖ sin kx`, k = 1…n, of a rotary axis; a constant belongs to the location errors.
    pub fn fourier(harmonics: u8) -> Self {
        Self::Functions((1..=harmonics).flat_map(|k| [BasisFunction::Cosine(k), BasisFunction::Sine(k)]).collect())
    }

    /// The functions whose coefficients are unknown.
    pub fn functions(&self) -> &TiSlice<TermId, BasisFunction> {
        match self {
            Self::Zero | Self::Known => TiSlice::from_ref(&[]),
            Self::Functions(functions) => functions,
        }
    }

    /// Suffixes of the coefficients' names: `1`, `2`, … or `_cos1`, `_sin1`, ….
    pub fn suffixes(&self) -> impl Iterator<Item = String> {
        self.functions().iter_enumerated().map(|(term, f)| f.suffix(term))
    }

    /// The functions along a run; none at rest.
    ///
    /// # Errors
    /// [`AlgebraError`] where the exact arithmetic overflows.
    pub fn along(&self, coordinate: &Coordinate, alphabet: &Alphabet) -> Result<TiVec<TermId, Poly>, AlgebraError> {
        let (x, angle) = match coordinate {
            Coordinate::Rest => return Ok(TiVec::new()),
            Coordinate::Linear(x) => (x, None),
            Coordinate::Rotary(angle) => (&angle.poly, Some(angle)),
        };
        self.functions().iter().map(|f| f.of(&mut Along { x, angle, alphabet })).collect()
    }

    /// The functions' values at a coordinate (mm or rad).
    pub fn values(&self, x: f64, alphabet: &Alphabet, constant: &impl Fn(&str) -> f64) -> TiVec<TermId, f64> {
        self.functions().iter().map(|f| f.of(&mut At { x, alphabet, constant })).collect()
    }
}

/// Exact polynomials along a run.
struct Along<'a> {
    x: &'a Poly,
    /// The coordinate of a rotary axis.
    angle: Option<&'a Angle>,
    alphabet: &'a Alphabet,
}

impl Along<'_> {
    /// Sine and cosine of a multiple; a linear axis has none.
    fn sin_cos(&self, multiple: u8) -> Result<(Poly, Poly), AlgebraError> {
        self.angle.map_or(Ok((Poly::ZERO, Poly::ZERO)), |angle| angle.times(multiple.into())?.sin_cos(self.alphabet))
    }
}

impl Arithmetic for Along<'_> {
    type Value = Result<Poly, AlgebraError>;

    fn polynomial(&mut self, f: &Univariate) -> Self::Value {
        f.at(self.x)
    }

    fn cosine(&mut self, multiple: u8) -> Self::Value {
        Ok(self.sin_cos(multiple)?.1)
    }

    fn sine(&mut self, multiple: u8) -> Self::Value {
        Ok(self.sin_cos(multiple)?.0)
    }
}

/// Numbers at a coordinate.
struct At<'a, C> {
    x: f64,
    alphabet: &'a Alphabet,
    constant: &'a C,
}

impl<C: Fn(&str) -> f64> Arithmetic for At<'_, C> {
    type Value = f64;

    fn polynomial(&mut self, f: &Univariate) -> f64 {
        f.value(self.x, self.alphabet, self.constant)
    }

    fn cosine(&mut self, multiple: u8) -> f64 {
        (f64::from(multiple) * self.x).cos()
    }

    fn sine(&mut self, multiple: u8) -> f64 {
        (f64::from(multiple) * self.x).sin()
    }
}
