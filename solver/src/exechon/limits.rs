//! How far struts and axes go.

use super::{KinematicsError, Limit, pose::Joints};
use crate::Real;

/// From `low` to `high`, both within.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range<T> {
    /// The least value, mm or rad.
    pub low: T,
    /// The largest value, mm or rad.
    pub high: T,
}

/// The strokes of Table 1 as strut lengths (mm) and axis angles (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<T> {
    /// Of each strut, joint to joint, mm.
    pub struts: Range<T>,
    /// Of the A axis, rad.
    pub a: Range<T>,
    /// Of the C axis, rad.
    pub c: Range<T>,
}

impl<T: Real> Range<T> {
    /// Everything.
    pub fn all() -> Self {
        Self { low: T::neg_infinity(), high: T::infinity() }
    }

    /// Whether there is a value in it.
    pub(super) fn is_proper(&self) -> bool {
        self.low < self.high
    }

    /// The end beyond which `value` is.
    fn passed(&self, value: T) -> Option<T> {
        if value < self.low {
            Some(self.low)
        } else if value <= self.high {
            None
        } else {
            Some(self.high)
        }
    }
}

impl<T: Real> Limits<T> {
    /// No limits.
    pub fn none() -> Self {
        Self { struts: Range::all(), a: Range::all(), c: Range::all() }
    }

    /// Checks joints: struts, then A, then C.
    pub(super) fn check(&self, joints: &Joints<T>) -> Result<(), KinematicsError<T>> {
        let [l1, l2, l3] = joints.struts;
        let values = [
            (Limit::Strut1, l1, self.struts),
            (Limit::Strut2, l2, self.struts),
            (Limit::Strut3, l3, self.struts),
            (Limit::A, joints.a, self.a),
            (Limit::C, joints.c, self.c),
        ];
        for (limit, value, range) in values {
            if let Some(bound) = range.passed(value) {
                return Err(KinematicsError::OutOfRange { limit, value, bound });
            }
        }
        Ok(())
    }
}
