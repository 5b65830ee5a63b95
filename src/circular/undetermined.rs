//! What the paths do not tell, and why.

use thiserror::Error;

/// Why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Undetermined {
    /// It turns with the direction.
    #[error("needs both directions")]
    OneDirection,
    /// It is defined for full circles only.
    #[error("needs a full circle")]
    PartialCircle,
    /// The two paths have no angle in common.
    #[error("needs paths over the same angles")]
    Apart,
    /// The axis does not turn round on the arc, or too near to its end.
    #[error("needs {:.0}° of path before the reversal and {:.0}° after it", .before.to_degrees(), .after.to_degrees())]
    NoReversal {
        /// That has to be there before, rad.
        before: f64,
        /// And after, rad.
        after: f64,
    },
    /// Other errors look alike on this arc.
    #[error("the arc does not tell it from the others: the readings' scatter would be magnified {times:.0} times")]
    Arc {
        /// The standard deviation from noise, as a multiple of that of a mean of as many readings.
        times: f64,
    },
    /// Other errors are the same at these angles.
    #[error("these angles do not tell it from the others")]
    Confounded,
    /// Fewer samples than it takes.
    #[error("too few samples")]
    Samples,
}
