//! Where the tool is to be.

use super::vector::{finite, norm};
use super::{Input, TargetError, Vector};
use crate::Real;

/// Lengths of a direction that differ from 1 by less than this are taken for rounding.
const UNIT: f64 = 1e-6;

/// A tool point and a tool direction of length one, in base coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target<T> {
    point: Vector<T>,
    direction: Vector<T>,
}

impl<T: Real> Target<T> {
    /// A target: tool point in mm, and tool direction, from the tool's tip away from the spindle.
    ///
    /// # Errors
    /// [`TargetError`] for values that are not finite and for a direction whose length is zero or differs from one by
    /// more than 1e-6 (a smaller difference is divided out).
    pub fn new(point: Vector<T>, direction: Vector<T>) -> Result<Self, TargetError<T>> {
        if !finite(&point) {
            return Err(TargetError::NotFinite(Input::Point));
        }
        if !finite(&direction) {
            return Err(TargetError::NotFinite(Input::Direction));
        }
        let norm = norm(&direction);
        if norm == T::zero() {
            return Err(TargetError::ZeroDirection);
        }
        if (norm - T::one()).abs() > T::of(UNIT).max(T::of(8.0) * T::epsilon()) {
            return Err(TargetError::NotUnit { norm });
        }
        Ok(Self { point, direction: direction.map(|d| d / norm) })
    }

    /// The tool point, mm.
    pub fn point(&self) -> &Vector<T> {
        &self.point
    }

    /// The tool direction, of length one.
    pub fn direction(&self) -> &Vector<T> {
        &self.direction
    }
}
