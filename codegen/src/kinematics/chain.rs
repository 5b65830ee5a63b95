//! Chains of 4×4 transforms in the paper's order.
//!
//! Rotary axis, T(1): `OM · SM · EM · AM`, the errors stand before the motion. Linear axis, T(2):
//! `SM · TM · EM`, they follow it. OM and SM are one matrix here: `OM · SM` is SM with OM's translation.

use crate::algebra::{AlgebraError, Alphabet, ErrorId, Order, Poly, PolyVector, Transform};
use crate::basis::Coordinate;
use crate::ids::AxisId;
use crate::model::{AxisKind, Ball, Model, Run};
use core::ops::Range;

/// The workpiece ball and the tool ball in machine coordinates, T(3) and T(8), mm.
pub fn ball_positions(model: &Model, run: &Run, order: Order) -> Result<[PolyVector; 2], AlgebraError> {
    let (sides, all) = (model.workpiece.len(), model.axes().count());
    Ok([
        position(model, run, 0..sides, &run.workpiece_ball, order)?,
        position(model, run, sides..all, &run.tool_ball, order)?,
    ])
}

/// Carries the ball from the last axis' frame to the machine's, matrix times vector: nothing but points is expanded.
fn position(
    model: &Model,
    run: &Run,
    axes: Range<usize>,
    ball: &Ball,
    order: Order,
) -> Result<PolyVector, AlgebraError> {
    let mut point = ball.at.clone();
    if let Some(setup) = ball.setup {
        for (coordinate, error) in point.iter_mut().zip(setup) {
            *coordinate = coordinate.plus(&Poly::error(error))?;
        }
    }
    for axis in axes.rev().map(AxisId::from) {
        for transform in transforms(model, run, axis)?.iter().rev() {
            point = transform.apply(&point, order)?;
        }
        for p in &mut point {
            *p = p.normal(&model.alphabet)?;
        }
    }
    Ok(point)
}

/// The axis' factors, leftmost first.
fn transforms(model: &Model, run: &Run, id: AxisId) -> Result<Vec<Transform>, AlgebraError> {
    let Some(axis) = model.axis(id) else { return Ok(Vec::new()) };
    let nominal = match &run.at[id] {
        Coordinate::Rest => return Ok(Vec::new()),
        Coordinate::Linear(travel) => Transform::translation(along(&axis.direction, travel)?),
        Coordinate::Rotary(angle) => {
            let (sin, cos) = angle.sin_cos(&model.alphabet)?;
            rotation(&axis.direction, &sin, &cos, &model.alphabet)?
        }
    };
    let kept = |error: Option<ErrorId>| error.filter(|e| !run.left_out.contains(e));
    let mut motion = errors(axis.motion.map(|e| kept(Some(e))));
    for nuisance in run.nuisance.iter().filter(|n| n.axis == id) {
        let parameter = Poly::error(nuisance.error);
        for (own, factor) in motion.iter_mut().zip(&nuisance.factors) {
            *own = own.plus(&parameter.times(factor, Order::LINEAR)?)?;
        }
    }
    let motion = small(motion);
    let moved = match axis.kind {
        AxisKind::Rotary => [motion, nominal],
        AxisKind::Linear => [nominal, motion],
    };
    let location = axis.location.map(kept);
    let location = location.iter().any(Option::is_some).then(|| small(errors(location)));
    Ok(location.into_iter().chain(moved).collect())
}

fn errors(errors: [Option<ErrorId>; 6]) -> [Poly; 6] {
    errors.map(|e| e.map(Poly::error).unwrap_or_default())
}

/// The matrix of six small errors X Y Z A B C.
fn small([x, y, z, a, b, c]: [Poly; 6]) -> Transform {
    Transform::small([a, b, c], [x, y, z])
}

fn along(direction: &PolyVector, travel: &Poly) -> Result<PolyVector, AlgebraError> {
    let mut by = PolyVector::default();
    for (b, d) in by.iter_mut().zip(direction) {
        *b = d.times(travel, Order::NOMINAL)?;
    }
    Ok(by)
}

/// Rodrigues' rotation about a unit vector n: `cos·I + sin·[n]× + (1 − cos)·n nᵀ`.
fn rotation(n: &PolyVector, sin: &Poly, cos: &Poly, alphabet: &Alphabet) -> Result<Transform, AlgebraError> {
    let times = |a: &Poly, b: &Poly| a.times(b, Order::NOMINAL);
    let versine = Poly::one().minus(cos)?;
    let mut rows: [[Poly; 3]; 3] = Default::default();
    for (i, row) in rows.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            let mut value = times(&versine, &times(&n[i], &n[j])?)?;
            if i == j {
                value = value.plus(cos)?;
            } else {
                let (k, positive) = (3 - i - j, (i + 1) % 3 != j);
                let turn = times(sin, &n[k])?;
                value = if positive { value.plus(&turn)? } else { value.minus(&turn)? };
            }
            *entry = value.normal(alphabet)?;
        }
    }
    Ok(Transform::new(rows, PolyVector::default()))
}
