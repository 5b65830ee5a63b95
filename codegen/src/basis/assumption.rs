//! What is assumed of a motion error: none, a known function, a sum of functions.

use super::function::{Arithmetic, BasisFunction};
use super::{Coordinate, Univariate};
use crate::algebra::{AlgebraError, Alphabet, Angle, Poly, Turned, wrapped_value};
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
    Functions(Functions),
}

/// Functions of a coordinate.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Functions {
    /// The functions.
    pub terms: TiVec<TermId, BasisFunction>,
    /// Where their turn begins, in steps of 15°, of polynomials whose conditions make them periodic: they are functions of the
    /// angle less whole turns.
    pub turn_from: Option<i32>,
    /// The coordinates at which they satisfy conditions.
    pub points: Vec<Poly>,
}

impl Basis {
    /// Polynomials x, x², … xⁿ of T(6); a constant belongs to the location errors.
    pub fn polynomial(degree: u8) -> Self {
        Self::polynomials((1..=usize::from(degree)).map(Univariate::power))
    }

    /// Polynomials of the coordinate.
    pub fn polynomials(functions: impl IntoIterator<Item = Univariate>) -> Self {
        let terms = functions.into_iter().map(BasisFunction::Polynomial).collect();
        Self::Functions(Functions { terms, ..Functions::default() })
    }

    /// 1 alone: a location error.
    pub fn one() -> Self {
        Self::Functions(Functions { terms: [BasisFunction::One].into_iter().collect(), ..Functions::default() })
    }

    /// Whether it is that of a location error, the same at every coordinate.
    pub fn is_one(&self) -> bool {
        self.functions().raw == [BasisFunction::One]
    }

    /// `Σ cₖ cos kx + sₖ sin kx`, k = 1…n, of a rotary axis; a constant belongs to the location errors.
    pub fn fourier(harmonics: u8) -> Self {
        let terms = (1..=harmonics).flat_map(|k| [BasisFunction::Cosine(k), BasisFunction::Sine(k)]).collect();
        Self::Functions(Functions { terms, ..Functions::default() })
    }

    /// The functions whose coefficients are unknown.
    pub fn functions(&self) -> &TiSlice<TermId, BasisFunction> {
        match self {
            Self::Zero | Self::Known => TiSlice::from_ref(&[]),
            Self::Functions(functions) => &functions.terms,
        }
    }

    /// Where the turn of a periodic polynomial basis begins, in steps of 15°.
    pub fn turn_from(&self) -> Option<i32> {
        if let Self::Functions(functions) = self { functions.turn_from } else { None }
    }

    /// The coordinates at which the functions satisfy conditions.
    pub fn points(&self) -> &[Poly] {
        if let Self::Functions(functions) = self { &functions.points } else { &[] }
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
        let turned = match (self.turn_from(), angle) {
            (Some(start), Some(angle)) => Some(Turned::new(angle, start).poly(angle, alphabet)?),
            _ => None,
        };
        let x = turned.as_ref().unwrap_or(x);
        self.functions().iter().map(|f| f.of(&mut Along { x, angle, alphabet })).collect()
    }

    /// The functions' values at a coordinate (mm or rad).
    pub fn values(&self, x: f64, alphabet: &Alphabet, constant: &impl Fn(&str) -> f64) -> TiVec<TermId, f64> {
        let x = self.turn_from().map_or(x, |start| wrapped_value(x, start));
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
