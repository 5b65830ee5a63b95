//! What sums are made of.

use crate::study::seen::Seen;

/// A function at a coordinate (mm or rad) in a sum.
#[derive(Clone, Copy, Debug)]
pub struct Term<'a> {
    /// What it is multiplied with.
    pub factor: f64,
    /// The function.
    pub seen: &'a Seen,
    /// The coordinate.
    pub at: f64,
}
