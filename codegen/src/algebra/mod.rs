//! Exact algebra: sparse polynomials with rational coefficients, truncated in the errors while they multiply.
//!
//! After this room every expression is exact or an [`AlgebraError`]; no wrong digit can leave it, and a
//! floating-point number only where one is asked for. It knows symbols, not machines: what a symbol means is decided in `kinematics`.

mod alphabet;
mod angle;
mod derivative;
mod elimination;
mod fraction;
mod gcd;
mod harmonics;
mod matrix;
mod modular;
mod monomial;
mod motion;
mod normal;
mod order;
mod path;
mod poly;
mod rational;
mod reversal;
mod sense;
mod symbol;
mod turn;
mod value;
pub(crate) mod vectors;
mod wrapped;

pub use crate::quantity::Quantity;
pub use alphabet::{Alphabet, Nominal};
pub use angle::Angle;
pub use elimination::{Reduced, Row, reduce, subtract};
pub use fraction::Fraction;
pub use harmonics::{Harmonic, Harmonics};
pub use matrix::{PolyVector, Transform};
pub(crate) use matrix::{difference, dot};
pub use monomial::{MAX_ERROR_ORDER, MAX_NOMINALS, Monomial, Powers};
pub use order::Order;
pub use path::{Arctangent, Root, Terms};
pub use poly::{Poly, Term};
pub use rational::{Rational, integer, to_f64};
pub use sense::Sense;
pub use symbol::{ErrorId, NominalId, SweepId};
pub use turn::Turned;
pub use value::{at, nominal_value, whole_turns, wrapped_value};
pub use wrapped::WrappedAngle;

/// Why an exact computation could not be carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AlgebraError {
    /// The exponent of a nominal symbol left −127…127.
    ExponentOverflow,
    /// A divisor was zero.
    DivisionByZero,
    /// More nominal symbols (constants, sweeps, their sines and cosines, senses) than a monomial holds.
    TooManyNominals,
    /// More error symbols than identifiers.
    TooManyErrors,
    /// Coefficients so long that nobody could read them, after more work than anybody would wait for.
    TooLong,
    /// A truncation order above [`MAX_ERROR_ORDER`].
    OrderTooHigh,
}

impl core::fmt::Display for AlgebraError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let text = match self {
            Self::ExponentOverflow => "an exponent left -127..127",
            Self::DivisionByZero => "division by zero",
            Self::TooManyNominals => {
                "more than 24 constants, sweeps, their sines and cosines, and directions of motion in one model"
            }
            Self::TooManyErrors => "more than 65535 error symbols in one model",
            Self::TooLong => {
                "the coefficients grow beyond use: fewer runs, lower degrees or simpler directions give shorter ones"
            }
            Self::OrderTooHigh => "the order in the errors is above 8",
        };
        f.write_str(text)
    }
}

impl core::error::Error for AlgebraError {}
