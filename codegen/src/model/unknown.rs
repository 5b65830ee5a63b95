//! What a fit could find: location and set-up errors, and coefficients of functions.

use crate::algebra::ErrorId;
use crate::ids::{FunctionId, TermId};

/// Where a parameter comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    /// A location or set-up error.
    Constant(ErrorId),
    /// A coefficient of a function.
    Coefficient(Coefficient),
}

/// What a function of a basis is multiplied with in the sum for a motion error; a location error that is to be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coefficient {
    /// The error's function.
    pub function: FunctionId,
    /// The function of its basis.
    pub term: TermId,
}
