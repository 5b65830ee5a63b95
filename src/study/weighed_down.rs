//! Readings that a robust fit weighs down.

use trunnion_codegen::ids::RunId;

/// What was weighed down in a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct WeighedDown {
    /// The run.
    pub run: RunId,
    /// Readings with a weight below one.
    pub samples: usize,
    /// Robust standard deviation of the residuals, mm.
    pub scale: f64,
    /// Those weighed down most: sweep (rad) and weight, the least first.
    pub most: Vec<(f64, f64)>,
}
