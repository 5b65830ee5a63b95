//! Why a run has no reading: its balls are not where the instrument needs them.

use crate::algebra::{AlgebraError, Monomial, Order, Poly};

/// Why a run has no reading.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReadingError {
    /// The nominal distance of the balls is not the bar's length: what it is instead.
    NotTheBar(Length),
    /// The balls of a displacement reading do not nominally coincide: how far they are apart.
    NotTogether(Length),
    /// An exact computation failed.
    Algebra(AlgebraError),
}

impl From<AlgebraError> for ReadingError {
    fn from(e: AlgebraError) -> Self {
        Self::Algebra(e)
    }
}

impl core::fmt::Display for ReadingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotTheBar(_) => f.write_str("the balls are nominally not the bar's length apart"),
            Self::NotTogether(_) => f.write_str("the balls are nominally not together"),
            Self::Algebra(e) => core::fmt::Display::fmt(e, f),
        }
    }
}

impl core::error::Error for ReadingError {}

/// The nominal distance of the balls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Length {
    /// A single term, mm.
    Exactly(Poly),
    /// The square root of this, mm².
    RootOf(Poly),
}

/// The root of a squared length.
pub(super) fn length(square: &Poly) -> Result<Length, AlgebraError> {
    if let [(m, c)] = square.terms() {
        let half: Vec<i8> = m.powers().iter().map(|p| p / 2).collect();
        if let (Ok(powers), Some(root)) = (half.try_into(), c.sqrt()) {
            let candidate = Poly::term(Monomial::of_powers(powers), root);
            if candidate.times(&candidate, Order::NOMINAL)? == *square {
                return Ok(Length::Exactly(candidate));
            }
        }
    }
    Ok(Length::RootOf(square.clone()))
}
