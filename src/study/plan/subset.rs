//! The same machine with fewer runs.

use trunnion_codegen::identify::{DeriveError, derive};
use trunnion_codegen::model::Model;

/// The model with only these of its runs; what its order of parameters names and these runs do not see is left out.
///
/// # Errors
/// [`DeriveError`] where these runs have no measurement model.
pub fn subset(model: &Model, runs: &[usize]) -> Result<Model, DeriveError> {
    let mut part = model.clone();
    part.runs = runs.iter().filter_map(|&run| model.runs.get(run).cloned()).collect();
    loop {
        match derive(&part) {
            Ok(_) => return Ok(part),
            Err(DeriveError::UnknownParameter(at)) if at < part.order.len() => drop(part.order.remove(at)),
            Err(e) => return Err(e),
        }
    }
}
