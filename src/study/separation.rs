//! How well the samples of a fit separate its base parameters.

use trunnion_codegen::ids::BaseId;

/// How well the samples separate the base parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// Condition number of the design, columns scaled.
    pub condition: f64,
    /// Those that take part in what is separated worst.
    pub weakest: Vec<BaseId>,
}
