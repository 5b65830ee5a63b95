//! What is assumed of a motion error: none, a known function, a sum of functions.

use super::{Coordinate, Univariate};
use crate::algebra::{AlgebraError, Alphabet, Poly};

/// What is assumed of a motion error.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// Negligible.
    Zero,
    /// Given as data from another measurement.
    Known,
    /// A sum of polynomials of the coordinate with unknown coefficients.
    Polynomials(Vec<Univariate>),
    /// `Σ cₖ cos kx + sₖ sin kx`, k = 1…n, of a rotary axis; a constant belongs to the location errors.
    Fourier(u8),
}

impl Basis {
    /// Polynomials x, x², … xⁿ of T(6); a constant belongs to the location errors.
    pub fn polynomial(degree: u8) -> Self {
        Self::Polynomials((1..=usize::from(degree)).map(Univariate::power).collect())
    }

    /// Suffixes of the coefficients' names: `1`, `2`, … or `_cos1`, `_sin1`, ….
    pub fn suffixes(&self) -> Vec<String> {
        match self {
            Self::Zero | Self::Known => Vec::new(),
            Self::Polynomials(p) => (1..=p.len()).map(|k| k.to_string()).collect(),
            Self::Fourier(n) => (1..=*n).flat_map(|k| [format!("_cos{k}"), format!("_sin{k}")]).collect(),
        }
    }

    /// The basis functions along a run.
    pub fn along(&self, coordinate: &Coordinate, alphabet: &Alphabet) -> Result<Vec<Poly>, AlgebraError> {
        match (self, coordinate) {
            (Self::Polynomials(p), Coordinate::Linear(x)) => p.iter().map(|f| f.at(x)).collect(),
            (Self::Polynomials(p), Coordinate::Rotary(x)) => p.iter().map(|f| f.at(&x.poly)).collect(),
            (Self::Fourier(n), Coordinate::Rotary(x)) => {
                let mut functions = Vec::with_capacity(2 * usize::from(*n));
                for k in 1..=i32::from(*n) {
                    let (sin, cos) = x.times(k)?.sin_cos(alphabet)?;
                    functions.extend([cos, sin]);
                }
                Ok(functions)
            }
            (Self::Zero | Self::Known, _) | (_, Coordinate::Rest) | (Self::Fourier(_), Coordinate::Linear(_)) => {
                Ok(Vec::new())
            }
        }
    }

    /// The basis functions' values at a coordinate (mm or rad).
    pub fn values(&self, x: f64, alphabet: &Alphabet, constant: &impl Fn(&str) -> f64) -> Vec<f64> {
        match self {
            Self::Zero | Self::Known => Vec::new(),
            Self::Polynomials(p) => p.iter().map(|f| f.value(x, alphabet, constant)).collect(),
            Self::Fourier(n) => (1..=*n).flat_map(|k| [(f64::from(k) * x).cos(), (f64::from(k) * x).sin()]).collect(),
        }
    }
}
