//! The reading of a run, by its instrument.

use super::ReadingError;
use super::{bar, displacement};
use crate::algebra::{Order, Poly};
use crate::model::{Model, ReadingKind, Run};

/// The reading of a run up to `order` errors, in normal form, mm; its order-0 part is 0.
pub fn reading(model: &Model, run: &Run, order: Order) -> Result<Poly, ReadingError> {
    match &run.reading {
        ReadingKind::BarLength(radius) => bar::deviation(model, run, *radius, order),
        ReadingKind::Displacement(direction) => displacement::displacement(model, run, direction, order),
    }
}
