//! What the functions of an axis are functions of.

use crate::algebra::{Angle, Poly};

/// Where an axis is along a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// At its zero position, not moving: its errors are constant and counted with the set-up errors of the ball it carries.
    Rest,
    /// A linear axis, mm.
    Linear(Poly),
    /// A rotary axis, rad.
    Rotary(Angle),
}

impl Coordinate {
    /// The coordinate as a polynomial in the sweep, its sine and cosine; `None` at rest.
    pub fn poly(&self) -> Option<&Poly> {
        match self {
            Self::Rest => None,
            Self::Linear(poly) => Some(poly),
            Self::Rotary(angle) => Some(&angle.poly),
        }
    }
}
