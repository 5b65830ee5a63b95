//! Why a test has no figures.

use super::direction::Direction;
use core::fmt;
use thiserror::Error;
use trunnion_solver::circle::CircleError;

/// A path of a test, or both together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// One.
    Path(Direction),
    /// Both.
    Both,
}

impl fmt::Display for Which {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Path(direction) => write!(f, "the {direction} path"),
            Self::Both => f.write_str("both paths together"),
        }
    }
}

/// Why a test has no figures.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CircularError {
    /// A deviation that is no small part of the radius.
    #[error(
        "{}: a deviation of {deviation} mm on a radius of {radius} mm\n  expected deviations from the radius: is the unit right?",
        Which::Path(*.direction)
    )]
    Deviation {
        /// The path.
        direction: Direction,
        /// mm.
        deviation: f64,
        /// mm.
        radius: f64,
    },
    /// Points without a circle.
    #[error("{which}: {problem}\n  expected deviations around a circle")]
    Circle {
        /// Of which path.
        which: Which,
        /// Why.
        problem: CircleError,
    },
}
