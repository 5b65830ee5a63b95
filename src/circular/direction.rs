//! Which way a path goes.

use core::fmt;

/// Which way a circle is gone through, as seen with the first axis of the plane to the right and the second one upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The angle decreases.
    Clockwise,
    /// The angle increases.
    Counterclockwise,
}

impl Direction {
    /// By which factor the angle goes on.
    pub const fn sign(self) -> f64 {
        match self {
            Self::Clockwise => -1.0,
            Self::Counterclockwise => 1.0,
        }
    }

    /// As instruments write it: `CW`, `CCW`.
    pub const fn short(self) -> &'static str {
        match self {
            Self::Clockwise => "CW",
            Self::Counterclockwise => "CCW",
        }
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Clockwise => "clockwise",
            Self::Counterclockwise => "counterclockwise",
        })
    }
}
