//! Why a model is no component.

use crate::graph::Unbound;
use core::fmt;

/// Why a model is no component.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ComponentError {
    /// An expression depends on a symbol that is neither a constant nor the run's sweep: a defect of the derivation.
    Unbound(Unbound),
    /// HAL has no memory for it.
    TooManyUnknowns {
        /// Base parameters of the model.
        unknowns: usize,
        /// As many as there is room for.
        most: usize,
    },
}

impl fmt::Display for ComponentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unbound(unbound) => unbound.fmt(f),
            Self::TooManyUnknowns { unknowns, most } => {
                write!(
                    f,
                    "the model has {unknowns} base parameters\n  expected at most {most}: HAL has no memory for more"
                )
            }
        }
    }
}

impl core::error::Error for ComponentError {}

impl From<Unbound> for ComponentError {
    fn from(unbound: Unbound) -> Self {
        Self::Unbound(unbound)
    }
}
