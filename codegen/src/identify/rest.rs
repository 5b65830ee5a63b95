//! Resting axes: whether their errors may be counted with the set-up.
//!
//! An axis that stands at its zero has constant errors. As a rule nobody could tell them from where the balls are, and the
//! description leaves them out. That is exact only where they change the readings of the runs in which it rests as set-up and
//! location errors of the rest of the machine could, all runs together; else the axis is taken at its coordinate 0, and
//! such an error stays an unknown of its own. What takes up others must itself be left out nowhere: an error that makes up for
//! its own share in another run would be told apart by what no run reads. A location error that is to be found is left out nowhere.

use super::derivation::DeriveError;
use crate::algebra::{AlgebraError, Angle, ErrorId, Fraction, Monomial, Order, Poly, Row, reduce, subtract};
use crate::basis::{Basis, Coordinate};
use crate::ids::{AxisId, RunId};
use crate::measurement::reading;
use crate::model::{AxisKind, Model};
use std::collections::BTreeMap;
use typed_index_collections::TiVec;

/// What an error does to the readings of all runs: by run and trigonometric monomial.
type Effect = BTreeMap<(RunId, Monomial), Poly>;

/// Takes every resting axis at its coordinate 0 of which an error cannot be counted with the set-up; the others are left out
/// of the runs in which it rests.
///
/// An error is left out where errors that keep their whole effect can do what is missing of it; a location error that is left
/// out so has, up to these, its whole effect as well, and may stand for others in turn. Where nothing more can be left out, a
/// location error is kept, or in the end a motion error, and the rest is looked at again.
///
/// # Errors
/// [`DeriveError`] where a run has no reading.
pub fn settle(model: &mut Model) -> Result<(), DeriveError> {
    let mut moved = model.clone();
    let axes: Vec<AxisId> = (0..model.axes().count()).map(AxisId::from).collect();
    for (axis, run) in axes.iter().flat_map(|axis| model.runs.keys().map(move |run| (*axis, run))) {
        if model.runs[run].at[axis] == Coordinate::Rest {
            moved.runs[run].at[axis] = zero(model, axis);
        }
    }
    let (folded, whole) = (effects(model)?, effects(&moved)?);
    let mut open: Vec<(ErrorId, AxisId, Effect)> = Vec::new();
    for (error, effect) in &whole {
        let of =
            |a: &AxisId| model.axis(*a).is_some_and(|a| a.motion.contains(error) || a.location.contains(&Some(*error)));
        let Some(axis) = axes.iter().copied().find(of) else { continue };
        let missing = difference(effect, folded.get(error))?;
        if !missing.is_empty() && !vanishes(model, axis, *error)? {
            open.push((*error, axis, missing));
        }
    }
    let (mut standing, mut kept): (Vec<Effect>, Vec<ErrorId>) = (Vec::new(), Vec::new());
    open.retain(|(error, ..)| {
        let wanted = model.axis_of(*error).is_none() && model.function(*error).is_some();
        if wanted {
            kept.push(*error);
            standing.extend(whole.get(error).cloned());
        }
        !wanted
    });
    // Location before motion errors: they need nothing assumed of them.
    open.sort_by_key(|(error, ..)| model.axis_of(*error).is_some());
    let constant = |error: &ErrorId| model.axis_of(*error).is_none();
    let partly = |error: &ErrorId| open.iter().any(|(own, ..)| own == error) || kept.contains(error);
    let complete = folded.iter().filter(|(error, _)| constant(error) && !partly(error));
    standing.extend(complete.map(|(_, effect)| effect.clone()));
    let mut left_out: Vec<(ErrorId, AxisId)> = Vec::new();
    while !open.is_empty() {
        let mut next = None;
        for (at, (_, _, missing)) in open.iter().enumerate() {
            if spanned(model, &standing, missing)? {
                next = Some(at);
                break;
            }
        }
        let (error, axis, _) = open.remove(next.unwrap_or(0));
        let effects = if next.is_some() { &folded } else { &whole };
        match next {
            Some(_) => left_out.push((error, axis)),
            None => kept.push(error),
        }
        if constant(&error) {
            standing.extend(effects.get(&error).cloned());
        }
    }
    for (axis, run) in axes.iter().flat_map(|axis| model.runs.keys().map(move |run| (*axis, run))).collect::<Vec<_>>() {
        let described = model.axis(axis);
        let own = |e: &ErrorId| described.is_some_and(|a| a.motion.contains(e) || a.location.contains(&Some(*e)));
        if model.runs[run].at[axis] == Coordinate::Rest && kept.iter().any(own) {
            let at = zero(model, axis);
            let out = left_out.iter().filter(|(_, of)| *of == axis).map(|(error, _)| *error);
            let out: Vec<ErrorId> = out.collect();
            model.runs[run].at[axis] = at;
            model.runs[run].left_out.extend(out);
        }
    }
    Ok(())
}

/// An axis' coordinate 0.
fn zero(model: &Model, axis: AxisId) -> Coordinate {
    match model.axis(axis).map(|a| a.kind) {
        Some(AxisKind::Rotary) => Coordinate::Rotary(Angle::zero()),
        _ => Coordinate::Linear(Poly::ZERO),
    }
}

/// Whether what is assumed of a motion error makes it zero at the coordinate 0; never so of a location error.
fn vanishes(model: &Model, axis: AxisId, error: ErrorId) -> Result<bool, AlgebraError> {
    let Some((_, function)) = model.function(error) else { return Ok(false) };
    let zero = zero(model, axis);
    match function.basis {
        Basis::Zero => Ok(true),
        Basis::Known => Ok(false),
        Basis::Functions(_) => Ok(function.basis.along(&zero, &model.alphabet)?.iter().all(Poly::is_zero)),
    }
}

/// What every error does, a motion error as if it were constant.
fn effects(model: &Model) -> Result<BTreeMap<ErrorId, Effect>, DeriveError> {
    let mut effects: BTreeMap<ErrorId, Effect> = BTreeMap::new();
    for (run, described) in model.runs.iter_enumerated() {
        let read = reading(model, described, Order::LINEAR).map_err(|e| DeriveError::Reading(run, e))?;
        for (errors, coefficient) in read.by_errors() {
            let Some(error) = errors.errors().next() else { continue };
            for (monomial, factor) in coefficient.normal(&model.alphabet)?.by_motion(&model.alphabet) {
                effects.entry(error).or_default().insert((run, monomial), factor);
            }
        }
    }
    Ok(effects)
}

/// What an error does in the runs in which its axis rests and is left out.
fn difference(kept: &Effect, folded: Option<&Effect>) -> Result<Effect, AlgebraError> {
    let mut left = Effect::new();
    for (place, factor) in kept {
        let before = folded.and_then(|f| f.get(place));
        let rest = before.map_or_else(|| Ok(factor.clone()), |before| factor.minus(before))?;
        if !rest.is_zero() {
            left.insert(*place, rest);
        }
    }
    Ok(left)
}

/// Whether `standing` effects together can make up `effect`.
fn spanned(model: &Model, standing: &[Effect], effect: &Effect) -> Result<bool, AlgebraError> {
    let mut places: BTreeMap<(RunId, Monomial), usize> = BTreeMap::new();
    for key in standing.iter().chain([effect]).flat_map(BTreeMap::keys) {
        let next = places.len();
        places.entry(*key).or_insert(next);
    }
    let row = |effect: &Effect| {
        let mut row: Row<usize> = TiVec::from(vec![Fraction::zero(); places.len()]);
        effect.iter().for_each(|(key, factor)| row[places[key]] = Fraction::whole(factor.clone()));
        row
    };
    let reduced = reduce(standing.iter().map(row).collect(), 0..places.len(), &model.alphabet)?;
    let mut rest = row(effect);
    for (pivot, own) in &reduced.rows {
        subtract(&mut rest, own, *pivot, &model.alphabet)?;
    }
    Ok(rest.iter().all(Fraction::is_zero))
}
