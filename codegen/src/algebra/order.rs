//! The order of truncation.

use super::{AlgebraError, MAX_ERROR_ORDER};

/// How many errors a term may multiply; higher terms are never formed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Order(u8);

impl Order {
    /// Order 0: nominal values only.
    pub const NOMINAL: Self = Self(0);
    /// Order 1: the linear model.
    pub const LINEAR: Self = Self(1);

    /// The highest there is.
    pub(super) const MOST: Self = Self(MAX_ERROR_ORDER as u8);

    /// Any order up to [`MAX_ERROR_ORDER`].
    pub fn new(order: usize) -> Result<Self, AlgebraError> {
        if order > MAX_ERROR_ORDER { Err(AlgebraError::OrderTooHigh) } else { Ok(Self(order as u8)) }
    }

    /// The number of errors.
    pub fn get(self) -> usize {
        usize::from(self.0)
    }
}
