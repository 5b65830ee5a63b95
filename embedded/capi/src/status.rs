//! What a call answers.

use trunnion_solver::lstsq::{Rejected, SolveError};
use trunnion_solver::model::{ImpossibleLength, MergeError};

/// What a call answers. Whatever is not `OK` has changed nothing but the result, which is then marked invalid.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrunnionStatus {
    /// Done.
    Ok = 0,
    /// A pointer is null.
    NullPointer = 1,
    /// A pointer is not aligned for its type.
    Misaligned = 2,
    /// The state or estimate was never initialised, or is one of another kind.
    NotInitialised = 3,
    /// The bar's nominal length is not a positive finite number.
    ImpossibleRadius = 4,
    /// A value given is NaN or infinite, or a result would be.
    NotFinite = 5,
    /// The values are finite, but beyond the range of the arithmetic.
    Overflow = 6,
    /// Fewer samples than the coefficients and the residual need.
    TooFewSamples = 7,
    /// The samples do not separate the coefficients named in the estimate's `confounded`.
    Confounded = 8,
    /// The states to merge are of bars of different length.
    DifferentRadius = 9,
}

impl From<ImpossibleLength> for TrunnionStatus {
    fn from(_: ImpossibleLength) -> Self {
        Self::ImpossibleRadius
    }
}

impl From<Rejected> for TrunnionStatus {
    fn from(why: Rejected) -> Self {
        match why {
            Rejected::Overflow => Self::Overflow,
            _ => Self::NotFinite,
        }
    }
}

impl<const P: usize> From<SolveError<P>> for TrunnionStatus {
    fn from(why: SolveError<P>) -> Self {
        match why {
            SolveError::TooFewSamples { .. } => Self::TooFewSamples,
            SolveError::RankDeficient(_) => Self::Confounded,
            _ => Self::NotFinite,
        }
    }
}

impl From<MergeError> for TrunnionStatus {
    fn from(why: MergeError) -> Self {
        match why {
            MergeError::Rejected(why) => why.into(),
            // Of the lengths there is one: the radius.
            _ => Self::DifferentRadius,
        }
    }
}

/// The status of an outcome.
pub(crate) fn status<E: Into<TrunnionStatus>>(outcome: Result<(), E>) -> TrunnionStatus {
    outcome.map_or_else(Into::into, |()| TrunnionStatus::Ok)
}
