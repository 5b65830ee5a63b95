//! Physical parameters.

use crate::algebra::ErrorId;
use crate::ids::{FunctionId, TermId};

/// A physical parameter: what a person could measure or align, if it could be told apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// `o_ya`, `d_yy1`, `w_z1`.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a parameter comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A location or set-up error.
    Constant(ErrorId),
    /// A coefficient of a function.
    Coefficient(Coefficient),
}

/// What a function of a basis is multiplied with in the sum for a motion error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coefficient {
    /// The motion error's function.
    pub function: FunctionId,
    /// The function of its basis.
    pub term: TermId,
}
