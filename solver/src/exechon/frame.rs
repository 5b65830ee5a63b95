//! Machine coordinates.

use super::vector::{combine, components, plus};
use super::{Pose, Vector};
use crate::Real;

/// Machine coordinates in base coordinates: those of the tool at home, its z axis along the tool direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<T> {
    origin: Vector<T>,
    axes: [Vector<T>; 3],
}

impl<T: Real> Frame<T> {
    pub(super) fn of(home: &Pose<T>) -> Self {
        Self { origin: home.point, axes: home.spindle }
    }

    /// A point (mm) of machine coordinates in base coordinates.
    pub fn point_to_base(&self, point: Vector<T>) -> Vector<T> {
        plus(&self.origin, T::one(), &self.direction_to_base(point))
    }

    /// A direction of machine coordinates in base coordinates.
    pub fn direction_to_base(&self, direction: Vector<T>) -> Vector<T> {
        combine(&self.axes, &direction)
    }

    /// A point (mm) of base coordinates in machine coordinates.
    pub fn point_from_base(&self, point: Vector<T>) -> Vector<T> {
        self.direction_from_base(plus(&point, -T::one(), &self.origin))
    }

    /// A direction of base coordinates in machine coordinates.
    pub fn direction_from_base(&self, direction: Vector<T>) -> Vector<T> {
        components(&self.axes, &direction)
    }
}
