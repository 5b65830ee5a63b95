//! One column per physical parameter: its coefficient in every run, the basis functions put in.

use super::DeriveError;
use crate::algebra::{ErrorId, Order, Poly};
use crate::basis::Basis;
use crate::model::Model;

/// A physical parameter: what a person could measure or align, if it could be told apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// `o_ya`, `d_yy1`, `w_z1`.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a parameter comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A location or set-up error.
    Constant(ErrorId),
    /// A coefficient: position in [`Model::functions`] and in its basis.
    Coefficient(usize, usize),
}

/// The columns in elimination order, and each run's known terms.
pub(super) struct Columns {
    pub parameters: Vec<Parameter>,
    /// `raw[run][parameter]`: products left as they stand.
    pub raw: Vec<Vec<Poly>>,
    pub known: Vec<Vec<(usize, Poly)>>,
    pub unseen: Vec<ErrorId>,
}

pub(super) fn columns(model: &Model, readings: &[Poly]) -> Result<Columns, DeriveError> {
    let mut found: Vec<(Parameter, Vec<Poly>)> = Vec::new();
    let mut known = vec![Vec::new(); readings.len()];
    let mut seen = Vec::new();
    let mut without_basis = Vec::new();
    for (run, reading) in readings.iter().enumerate() {
        for (errors, coefficient) in reading.by_errors() {
            let Some(error) = errors.errors().next() else { continue };
            seen.push(error);
            let name = model.alphabet.error_name(error);
            let Some((axis, _)) = model.axis_of(error) else {
                put(&mut found, readings.len(), name.to_owned(), Origin::Constant(error), run, coefficient);
                continue;
            };
            let Some((position, function)) = model.functions.iter().enumerate().find(|(_, f)| f.error == error) else {
                without_basis.push((run, error, coefficient));
                continue;
            };
            if function.basis == Basis::Known {
                known[run].push((position, coefficient));
                continue;
            }
            let values = function.basis.along(&model.runs[run].at[axis], &model.alphabet)?;
            for (k, (value, suffix)) in values.iter().zip(function.basis.suffixes()).enumerate() {
                let column = coefficient.times(value, Order::NOMINAL)?;
                put(
                    &mut found,
                    readings.len(),
                    format!("{name}{suffix}"),
                    Origin::Coefficient(position, k),
                    run,
                    column,
                );
            }
        }
    }
    if !without_basis.is_empty() {
        return Err(DeriveError::NoBasis(without_basis));
    }
    found.retain(|(_, columns)| columns.iter().any(|c| !c.is_zero()));
    sort(model, &mut found)?;
    let raw = (0..readings.len()).map(|run| found.iter().map(|(_, columns)| columns[run].clone()).collect()).collect();
    let unseen = model.alphabet.errors().map(|(id, ..)| id).filter(|id| !seen.contains(id)).collect();
    Ok(Columns { parameters: found.into_iter().map(|(p, _)| p).collect(), raw, known, unseen })
}

fn put(found: &mut Vec<(Parameter, Vec<Poly>)>, runs: usize, name: String, origin: Origin, run: usize, column: Poly) {
    let at = found.iter().position(|(p, _)| p.origin == origin).unwrap_or_else(|| {
        found.push((Parameter { name, origin }, vec![Poly::ZERO; runs]));
        found.len() - 1
    });
    found[at].1[run] = column;
}

/// Coefficients of estimated functions first, so that what they are confounded with shows in their own definition; then
/// the declared order; then the order of the symbols.
fn sort(model: &Model, found: &mut [(Parameter, Vec<Poly>)]) -> Result<(), DeriveError> {
    if let Some(at) = model.order.iter().position(|text| found.iter().all(|(p, _)| p.name != text.value)) {
        return Err(DeriveError::UnknownParameter(at));
    }
    found.sort_by_key(|(p, _)| {
        let estimated = matches!(p.origin, Origin::Coefficient(f, _) if model.functions[f].estimate);
        let declared = model.order.iter().position(|text| text.value == p.name).unwrap_or(model.order.len());
        let symbol = match p.origin {
            Origin::Constant(error) => (error, 0),
            Origin::Coefficient(f, k) => (model.functions[f].error, k),
        };
        (!estimated, declared, symbol)
    });
    Ok(())
}
