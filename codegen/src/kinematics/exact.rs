//! The same chains in numbers: full 4×4 products of the same matrices, nothing dropped.
//!
//! What a simulated instrument reads comes from here, so that a fit is never tested against its own linear model.

use crate::algebra::{ErrorId, Poly};
use crate::model::{Axis, AxisKind, Ball, Coordinate, Model, Run, at};

/// Values of the errors at one place of a run: mm and rad.
pub trait ErrorValues {
    /// Value of an error; of a motion error at the coordinate (mm or rad) of its axis.
    fn value(&self, error: ErrorId, coordinate: f64) -> f64;
}

type Point = [f64; 3];

/// The workpiece ball and the tool ball in machine coordinates, mm, at one value of the sweep (rad).
pub fn exact_positions(
    model: &Model,
    run: &Run,
    sweep: f64,
    constant: &impl Fn(&str) -> f64,
    errors: &impl ErrorValues,
) -> [Point; 2] {
    let value = |p: &Poly| at(p, &model.alphabet, sweep, constant);
    let position = |axes: &[Axis], coordinates: &[Coordinate], ball: &Ball| {
        let mut point: Point =
            core::array::from_fn(|i| value(&ball.at[i]) + ball.setup.map_or(0.0, |s| errors.value(s[i], 0.0)));
        for (axis, coordinate) in axes.iter().zip(coordinates).rev() {
            let Some(coordinate) = coordinate.poly().map(value) else { continue };
            let direction = core::array::from_fn(|i| value(&axis.direction[i]));
            let motion = axis.motion.map(|e| errors.value(e, coordinate));
            let location = axis.location.map(|e| e.map_or(0.0, |e| errors.value(e, coordinate)));
            point = match axis.kind {
                AxisKind::Rotary => small(&motion, rotate(&direction, coordinate, point)),
                AxisKind::Linear => {
                    let moved = small(&motion, point);
                    core::array::from_fn(|i| moved[i] + coordinate * direction[i])
                }
            };
            point = small(&location, point);
        }
        point
    };
    let (workpiece, tool) = run.at.split_at(model.workpiece.len());
    [position(&model.workpiece, workpiece, &run.workpiece_ball), position(&model.tool, tool, &run.tool_ball)]
}

/// `[1 −c b x; c 1 −a y; −b a 1 z] · p`
fn small([x, y, z, a, b, c]: &[f64; 6], [px, py, pz]: Point) -> Point {
    [px - c * py + b * pz + x, c * px + py - a * pz + y, -b * px + a * py + pz + z]
}

/// Rodrigues' rotation of `p` about the unit vector `n`.
fn rotate(n: &Point, angle: f64, p: Point) -> Point {
    let (sin, cos) = angle.sin_cos();
    let cross = [n[1] * p[2] - n[2] * p[1], n[2] * p[0] - n[0] * p[2], n[0] * p[1] - n[1] * p[0]];
    let along = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    core::array::from_fn(|i| cos * p[i] + sin * cross[i] + (1.0 - cos) * along * n[i])
}
