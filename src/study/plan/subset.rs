//! The same machine with fewer runs.

use trunnion_codegen::identify::{DeriveError, derive};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::Model;

/// The model with only these of its runs; what its order of parameters names and these runs do not see is left out.
///
/// # Errors
/// [`DeriveError`] where these runs have no measurement model.
pub fn subset(model: &Model, runs: &[RunId]) -> Result<Model, DeriveError> {
    let mut part = model.clone();
    part.runs = runs.iter().filter_map(|&run| model.runs.get(run).cloned()).collect();
    loop {
        match derive(&part) {
            Ok(_) => return Ok(part),
            Err(DeriveError::UnknownParameter(unknown)) => part.order.retain(|text| *text != unknown),
            Err(e) => return Err(e),
        }
    }
}
