//! What may be said of a function: how far it is determined, and what a number beside it is a number of.

use super::seen::Seen;
use super::setup::Setup;
use trunnion_codegen::emit::equations::{Remaining, Style, extent, remaining, seen_sum};
use trunnion_codegen::identify::Extent;

/// What may be said of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    /// How far it is determined.
    pub extent: Extent,
    /// In words: `determined up to cos(c), which 2/L·EYC_cos2 makes as well`.
    pub words: String,
    /// What the numbers are of: the function's name, or the sum it is seen in; `None` where it is not seen.
    pub sum: Option<String>,
    /// What stands between the two.
    pub up_to: Vec<Remaining>,
}

impl Seen {
    /// What may be said of it.
    pub fn told(&self, setup: &Setup) -> Told {
        let (model, derivation) = (&setup.model, &setup.derivation);
        Told {
            extent: self.extent(),
            words: extent(model, derivation, &self.determination, Style::Pretty),
            sum: seen_sum(model, derivation, &self.determination),
            up_to: remaining(model, derivation, &self.determination),
        }
    }
}
