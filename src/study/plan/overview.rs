//! All that `plan` has to say.

use trunnion::study::plan::design::Recommended;
use trunnion::study::plan::{Addition, Compared, Comparison};
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::Model;

/// All there is to say.
pub struct Found<'a> {
    pub model: &'a Model,
    pub derivation: &'a Derivation,
    pub comparison: &'a Comparison,
    /// Half width of the uniform noise, µm.
    pub noise_um: f64,
    /// Whether the runs to leave out were named.
    pub named: bool,
    pub compared: Vec<Compared>,
    /// The confounded groups in words.
    pub described: Vec<String>,
    /// The fewest runs for each function, and how they would be measured.
    pub recommended: Vec<Recommended>,
    /// Runs of the catalogue that fit the machine.
    pub tried: usize,
    pub added: Vec<Addition>,
}
