//! One column per physical parameter: its coefficient in every run, the basis functions put in.

use super::derivation::DeriveError;
use super::parameter::{Coefficient, Origin, Parameter};
use crate::algebra::{ErrorId, Order, Poly};
use crate::basis::Basis;
use crate::ids::{FunctionId, ParameterId, RunId};
use crate::model::Model;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A parameter with its coefficient in the reading of every run, products left as they stand.
type Column = (Parameter, TiVec<RunId, Poly>);

/// The columns in elimination order, and each run's known terms.
pub(super) struct Columns {
    pub parameters: TiVec<ParameterId, Parameter>,
    /// Products are left as they stand.
    pub raw: TiVec<RunId, TiVec<ParameterId, Poly>>,
    pub known: TiVec<RunId, Vec<(FunctionId, Poly)>>,
    pub unseen: Vec<ErrorId>,
}

pub(super) fn columns(model: &Model, readings: &TiSlice<RunId, Poly>) -> Result<Columns, DeriveError> {
    let mut found: Vec<Column> = Vec::new();
    let mut known = ti_vec![Vec::new(); readings.len()];
    let mut seen = Vec::new();
    let mut without_basis = Vec::new();
    for (run, reading) in readings.iter_enumerated() {
        for (errors, coefficient) in reading.by_errors() {
            let Some(error) = errors.errors().next() else { continue };
            seen.push(error);
            let name = model.alphabet.error_name(error);
            let Some((axis, _)) = model.axis_of(error) else {
                put(&mut found, readings.len(), name.to_owned(), Origin::Constant(error), run, coefficient);
                continue;
            };
            let Some((id, function)) = model.function(error) else {
                without_basis.push((run, error, coefficient));
                continue;
            };
            if function.basis == Basis::Known {
                known[run].push((id, coefficient));
                continue;
            }
            let values = function.basis.along(&model.runs[run].at[axis], &model.alphabet)?;
            for ((term, value), suffix) in values.iter_enumerated().zip(function.basis.suffixes()) {
                let origin = Origin::Coefficient(Coefficient { function: id, term });
                let column = coefficient.times(value, Order::NOMINAL)?;
                put(&mut found, readings.len(), format!("{name}{suffix}"), origin, run, column);
            }
        }
    }
    if !without_basis.is_empty() {
        return Err(DeriveError::NoBasis(without_basis));
    }
    found.retain(|(_, column)| column.iter().any(|c| !c.is_zero()));
    sort(model, &mut found)?;
    let raw = readings.keys().map(|run| found.iter().map(|(_, column)| column[run].clone()).collect()).collect();
    let unseen = model.alphabet.errors().map(|(id, ..)| id).filter(|id| !seen.contains(id)).collect();
    Ok(Columns { parameters: found.into_iter().map(|(p, _)| p).collect(), raw, known, unseen })
}

fn put(found: &mut Vec<Column>, runs: usize, name: String, origin: Origin, run: RunId, coefficient: Poly) {
    let at = found.iter().position(|(p, _)| p.origin == origin).unwrap_or_else(|| {
        found.push((Parameter { name, origin }, ti_vec![Poly::ZERO; runs]));
        found.len() - 1
    });
    found[at].1[run] = coefficient;
}

/// Coefficients of estimated functions first, so that what they are confounded with shows in their own definition; then
/// the declared order; then the order of the symbols.
fn sort(model: &Model, found: &mut [Column]) -> Result<(), DeriveError> {
    if let Some(unknown) = model.order.iter().find(|text| found.iter().all(|(p, _)| p.name != text.value)) {
        return Err(DeriveError::UnknownParameter(unknown.clone()));
    }
    found.sort_by_key(|(p, _)| {
        let estimated = matches!(p.origin, Origin::Coefficient(c) if model.functions[c.function].estimate);
        let declared = model.order.iter().position(|text| text.value == p.name).unwrap_or(model.order.len());
        let symbol = match p.origin {
            Origin::Constant(error) => (error, None),
            Origin::Coefficient(c) => (model.functions[c.function].error, Some(c.term)),
        };
        (!estimated, declared, symbol)
    });
    Ok(())
}
