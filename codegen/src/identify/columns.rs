//! One column per physical parameter: its coefficient in every run, the basis functions put in.

use super::assume::assume;
use super::derivation::DeriveError;
use super::parameter::{Assumed, Column, Parameter};
use crate::algebra::{AlgebraError, Alphabet, ErrorId, Order, Poly};
use crate::basis::Basis;
use crate::ids::{FunctionId, ParameterId, RunId, TermId};
use crate::limits::COEFFICIENTS;
use crate::model::{Coefficient, Model, Origin};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The columns in elimination order, and each run's known terms.
pub(super) struct Columns {
    pub parameters: TiVec<ParameterId, Parameter>,
    /// Powers of cosine are left as they stand.
    pub raw: TiVec<RunId, TiVec<ParameterId, Poly>>,
    pub known: TiVec<RunId, Vec<(FunctionId, Poly)>>,
    pub unseen: Vec<ErrorId>,
    pub assumed: Vec<Assumed>,
}

pub(super) fn columns(model: &Model, readings: &TiSlice<RunId, Poly>) -> Result<Columns, DeriveError> {
    let mut found: Vec<Column> = Vec::new();
    let mut known = ti_vec![Vec::new(); readings.len()];
    let mut seen = Vec::new();
    let mut without_basis = Vec::new();
    let mut terms = 0;
    for (run, reading) in readings.iter_enumerated() {
        for (errors, coefficient) in reading.by_errors() {
            let Some(error) = errors.errors().next() else { continue };
            seen.push(error);
            let Some((axis, _)) = model.axis_of(error) else {
                let located =
                    model.function(error).map(|(function, _)| Coefficient { function, term: TermId::from(0) });
                let origin = located.map_or(Origin::Constant(error), Origin::Coefficient);
                put(&mut found, readings.len(), origin, run, coefficient);
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
            for (term, value) in values.iter_enumerated() {
                let origin = Origin::Coefficient(Coefficient { function: id, term });
                let column = coefficient.times(value, Order::NOMINAL)?.normal_root2()?;
                terms += column.terms().len();
                if terms > COEFFICIENTS {
                    return Err(AlgebraError::TooLong.into());
                }
                put(&mut found, readings.len(), origin, run, column);
            }
        }
    }
    if !without_basis.is_empty() {
        return Err(DeriveError::NoBasis(without_basis));
    }
    let assumed = assume(&model.assumptions, &mut found, readings.len(), &model.alphabet)?;
    found = seen_of(found, &model.alphabet)?;
    let mut named: Vec<(Parameter, Column)> = found.into_iter().map(|c| (Parameter::new(model, c.origin), c)).collect();
    sort(model, &mut named, &assumed)?;
    let raw = readings.keys().map(|run| named.iter().map(|(_, column)| column.by_run[run].clone()).collect()).collect();
    let unseen = model.alphabet.errors().map(|(id, ..)| id).filter(|id| !seen.contains(id)).collect();
    Ok(Columns { parameters: named.into_iter().map(|(p, _)| p).collect(), raw, known, unseen, assumed })
}

/// Those that change a reading: products as they stand may be zero without looking so.
fn seen_of(found: Vec<Column>, alphabet: &Alphabet) -> Result<Vec<Column>, AlgebraError> {
    let mut kept = Vec::with_capacity(found.len());
    for column in found {
        let unseen = column.by_run.iter().map(|c| c.vanishes(alphabet)).collect::<Result<Vec<_>, _>>()?;
        if unseen.contains(&false) {
            kept.push(column);
        }
    }
    Ok(kept)
}

fn put(found: &mut Vec<Column>, runs: usize, origin: Origin, run: RunId, coefficient: Poly) {
    let at = found.iter().position(|c| c.origin == origin).unwrap_or_else(|| {
        found.push(Column { origin, by_run: ti_vec![Poly::ZERO; runs] });
        found.len() - 1
    });
    found[at].by_run[run] = coefficient;
}

/// Coefficients of estimated functions first, so that what they are confounded with shows in their own definition; what moves with
/// the feed last; then the declared order; then the order of the symbols. What is assumed may stand in the declared order.
fn sort(model: &Model, found: &mut [(Parameter, Column)], assumed: &[Assumed]) -> Result<(), DeriveError> {
    let assumed: Vec<Parameter> = assumed.iter().map(|a| Parameter::new(model, a.origin)).collect();
    let known = |name: &str| found.iter().map(|(p, _)| p).chain(&assumed).any(|p| p.name == name);
    if let Some(unknown) = model.order.iter().find(|text| !known(&text.value)) {
        return Err(DeriveError::UnknownParameter(unknown.clone()));
    }
    found.sort_by_key(|(p, _)| {
        let estimated = matches!(p.origin, Origin::Coefficient(c) if model.functions[c.function].estimate);
        let declared = model.order.iter().position(|text| text.value == p.name).unwrap_or(model.order.len());
        let symbol = match p.origin {
            Origin::Constant(error) => (error, None),
            Origin::Coefficient(c) => (model.functions[c.function].error, Some(c.term)),
        };
        let with_the_feed = matches!(p.origin, Origin::Constant(error) if model.is_nuisance(error));
        (!estimated, with_the_feed, declared, symbol)
    });
    Ok(())
}
