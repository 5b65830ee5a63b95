//! Which way something moves along a run: its symbol's meaning.

use super::SweepId;
use super::path::Terms;

/// The sign of a velocity, `of · d(sweep)/dt`: 1, −1, or 0 at a reversal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sense {
    /// The sweep.
    pub sweep: SweepId,
    /// The terms of by how much what moves moves with the sweep, up to a positive factor.
    pub of: Terms,
}
