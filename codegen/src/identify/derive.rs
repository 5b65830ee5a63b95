//! The whole way from a description to its measurement model.

use super::columns::columns;
use super::derivation::{Derivation, DeriveError};
use super::factor::factor;
use crate::algebra::Order;
use crate::measurement::reading;
use crate::model::Model;
use typed_index_collections::TiVec;

/// Derives the measurement model: every reading at first order, the bases put in, the base parameters.
pub fn derive(model: &Model) -> Result<Derivation, DeriveError> {
    let read = |(i, run)| reading(model, run, Order::LINEAR).map_err(|e| DeriveError::Reading(i, e));
    let readings = model.runs.iter_enumerated().map(read).collect::<Result<TiVec<_, _>, _>>()?;
    let columns = columns(model, &readings)?;
    factor(model, readings, columns)
}
