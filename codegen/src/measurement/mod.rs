//! From the two balls to what the instrument reads, as a polynomial in the errors: eqs. (4) and (5).

mod bar;
mod displacement;
mod exact;

pub use bar::Length;
pub use exact::ExactReading;

use crate::algebra::{AlgebraError, Order, Poly};
use crate::model::{Model, ReadingKind, Run};

/// Why a run has no reading.
#[derive(Clone, Debug, PartialEq, Eq)]
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

/// The reading of a run up to `order` errors, in normal form, mm; its order-0 part is 0.
pub fn reading(model: &Model, run: &Run, order: Order) -> Result<Poly, ReadingError> {
    match &run.reading {
        ReadingKind::BarLength(radius) => bar::deviation(model, run, *radius, order),
        ReadingKind::Displacement(direction) => displacement::displacement(model, run, direction, order),
    }
}
