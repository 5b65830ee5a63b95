//! What an angle less whole turns is: its symbol's meaning.

use super::SweepId;

/// `multiple · sweep` less whole turns, so that it lies in `start · π/12` and a turn from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrappedAngle {
    /// The sweep.
    pub sweep: SweepId,
    /// How often the angle goes round with it: at least once.
    pub multiple: i32,
    /// Where its turn begins, in steps of 15°: 0 to 23.
    pub start: i32,
}
