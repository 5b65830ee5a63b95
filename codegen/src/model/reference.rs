//! Squareness and parallelism: orientation errors that are declared against another axis, ISO 230-1's `EC(0X)Y`.
//!
//! In the chain such an error turns its axis against machine coordinates, so it is the angle to the other axis only if
//! that one defines the direction: it must have no such error itself and must not be carried along.

use super::description::{Axis, Model, Reference};
use super::{Problem, ProblemKind};

/// What is wrong with the references of a model's axes.
pub(super) fn problems(model: &Model) -> Vec<Problem> {
    let axes = model.axes().flat_map(|axis| axis.references.iter().map(move |reference| (axis, reference)));
    axes.filter_map(|(axis, r)| Some(Problem { span: r.place.clone(), kind: wrong(model, axis, r)? })).collect()
}

fn wrong(model: &Model, axis: &Axis, reference: &Reference) -> Option<ProblemKind> {
    if reference.axis == axis.name {
        return Some(ProblemKind::OwnReference(axis.name.clone()));
    }
    let Some(other) = model.axes().find(|a| a.name == reference.axis) else {
        return Some(ProblemKind::UnknownAxis(reference.axis.clone()));
    };
    let carries = |lower: &Axis, upper: &Axis| {
        let at = |side: &[Axis], name: &str| side.iter().position(|a| a.name == name);
        let below = |side: &[Axis]| Some(at(side, &lower.name)? < at(side, &upper.name)?);
        below(&model.workpiece).or_else(|| below(&model.tool)).unwrap_or(false)
    };
    if carries(axis, other) {
        return Some(ProblemKind::CarriedReference(reference.axis.clone(), axis.name.clone()));
    }
    if other.location[reference.component.index()].is_some() && !carries(other, axis) {
        return Some(ProblemKind::TurnedReference(reference.axis.clone(), reference.component.letter()));
    }
    let k = reference.component.index() % 3;
    // A refused direction is zero, and told elsewhere.
    let fixed = |a: &Axis| !a.direction[k].is_zero() && (0..3).all(|i| i == k || a.direction[i].is_zero());
    let no_angle = || ProblemKind::NoAngle(reference.component.letter(), reference.axis.clone(), axis.name.clone());
    (fixed(axis) || fixed(other)).then(no_angle)
}
