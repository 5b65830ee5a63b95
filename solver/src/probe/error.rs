//! Why touches give no offset.

use core::{error, fmt};

/// Why touches give no offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProbeError {
    /// A value is NaN or infinite.
    NotFinite,
    /// The ring's radius less the ball's is not positive.
    Radius,
    /// The touches are farther from the centre than the ring allows with any offset.
    BeyondRing,
    /// Fewer touches than unknowns.
    TooFewTouches {
        /// How many there are.
        touches: usize,
        /// How many are needed.
        needed: usize,
    },
    /// The touches do not tell offset, centre and radius apart: too few directions, or the spindle was not turned.
    NotSeparated,
    /// The iteration does not settle: the touches are not near one circle.
    NoConvergence,
}

impl fmt::Display for ProbeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("a value of the touches is not a finite number"),
            Self::Radius => f.write_str("the ring's radius less the stylus ball's is not positive"),
            Self::BeyondRing => f.write_str("the touches are farther from the centre than the ring allows with any offset"),
            Self::TooFewTouches { touches, needed } => {
                write!(f, "{touches} touch(es) where at least {needed} are needed")
            }
            Self::NotSeparated => f.write_str(
                "the touches do not tell the offset from the ring's centre and radius: touch in four directions, and again with the spindle reversed",
            ),
            Self::NoConvergence => f.write_str("the touches are not near one circle"),
        }
    }
}

impl error::Error for ProbeError {}
