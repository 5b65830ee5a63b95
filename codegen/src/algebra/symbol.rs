//! Ids of symbols: a monomial holds these, the alphabet says what they mean.

/// Index of a nominal symbol: a constant, √2, π, a sweep, or a sweep's sine or cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NominalId(pub(super) u8);

/// Index of a sweep (the parameter of a path, an angle in rad).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SweepId(pub(super) u8);

/// Index of an error symbol, counted from 1 so that 0 can mean "none" inside a monomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ErrorId(pub(super) u16);

impl ErrorId {
    /// Position in [`Alphabet::errors`](super::Alphabet::errors).
    pub fn index(self) -> usize {
        usize::from(self.0) - 1
    }
}
