//! What there is to say.

use trunnion::study::Estimator;
use trunnion::study::plan::{Addition, Compared};
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::Model;

/// All of it.
pub struct Found<'a> {
    pub model: &'a Model,
    pub derivation: &'a Derivation,
    pub estimator: Estimator,
    pub compared: Vec<Compared>,
    /// The confounded groups in words.
    pub described: Vec<String>,
    /// Runs of the catalogue that fit the machine.
    pub tried: usize,
    pub added: Vec<Addition>,
}
