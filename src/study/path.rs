//! How the axes move in a run, point by point, for a control that moves in straight lines between points.

use super::ends::Ends;
use super::reach::OutOfRange;
use super::setup::Setup;
use super::visited::between;
use std::f64::consts::TAU;
use trunnion_codegen::algebra::at;
use trunnion_codegen::ids::{AxisId, RunId};
use trunnion_codegen::model::{Axis, AxisKind, Run};

/// How far a straight line between two points may be off the path, mm: 0.1 µm with what a program's five decimals are off.
const CHORD: f64 = 9e-5;
/// Radius at which an angle is off, mm, where there is no bar.
const LEVER: f64 = 150.0;
/// Steps between points, rad: at least, and at most.
const STEPS: [f64; 2] = [0.02, 2.0];
/// Points at which the path is looked at.
const LOOKED_AT: usize = 1440;

/// A run's path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where the balls are nominally, each in the frame of what carries it, mm: the workpiece's, the tool's.
    pub balls: [[f64; 3]; 2],
    /// The axes that move or stand at a coordinate, in the model's order: their names, and whether they turn.
    pub axes: Vec<(String, AxisKind)>,
    /// What is measured, from the first to the last sweep, rad.
    pub measured: [f64; 2],
    /// How far the path goes on beyond both ends of that, rad: the axes come to speed and to rest there.
    pub overshoot: f64,
    /// Sweeps from beyond one end to beyond the other, in equal steps, rad.
    pub sweeps: Vec<f64>,
    /// The axes' coordinates at each of them, mm or rad.
    pub points: Vec<Vec<f64>>,
    /// The bar's direction at both ends as the linear axes lengthen it, in the order of the axes: to be multiplied with a length.
    /// None of a run that reads a displacement, or where linear axes do not lengthen it.
    pub outward: Option<[Vec<f64>; 2]>,
}

impl Setup {
    /// The path of a run over what of a turn its axes can reach, with `overshoot` (rad) beyond both ends of what is measured: where an
    /// axis cannot go on, less is measured.
    ///
    /// # Errors
    /// [`OutOfRange`] where a linear axis has no room for the feed-in.
    pub fn path(&self, run: RunId, overshoot: f64) -> Result<Path, OutOfRange> {
        let moved = self.moved(run);
        let Ends { ends: [first, last], overshoot, outward } = self.ends(run, &moved, overshoot)?;
        let points = |steps: usize| {
            let sweeps: Vec<f64> = between((first, last), steps).collect();
            let points = self.points(run, &moved, &sweeps);
            (sweeps, points)
        };
        let lever = self.bar(run).unwrap_or(LEVER);
        let weights: Vec<f64> =
            moved.iter().map(|(_, axis)| if axis.kind == AxisKind::Rotary { lever } else { 1.0 }).collect();
        let (looked_at, seen): (Vec<f64>, Vec<Vec<f64>>) = points(LOOKED_AT);
        let width = looked_at[1] - looked_at[0];
        let step = step(&seen, &weights, width);
        let (sweeps, points) = points(((last - first) / step).ceil().max(1.0) as usize);
        let measured = [first + overshoot, last - overshoot];
        Ok(Path { measured, overshoot, outward, sweeps, points, ..self.standing(run, first + overshoot) })
    }

    /// `count` values of a run's sweep, rad, evenly over what of a turn its axes can reach: a whole turn without its end.
    pub fn evenly(&self, run: RunId, count: usize) -> Vec<f64> {
        let (from, to) = self.sweep_range(run, (0.0, TAU));
        let steps = if to - from < TAU - 1e-9 { count.saturating_sub(1) } else { count };
        (0..count).map(|i| from + (to - from) * i as f64 / steps.max(1) as f64).collect()
    }

    /// A run that stops at values of its sweep, rad, in their order.
    pub fn positions(&self, run: RunId, sweeps: Vec<f64>) -> Path {
        let points = self.points(run, &self.moved(run), &sweeps);
        let measured = sweeps.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &x| [l.min(x), h.max(x)]);
        Path { measured, sweeps, points, ..self.standing(run, measured[0]) }
    }

    /// A path of a run that goes nowhere yet, its balls as they are at a sweep.
    fn standing(&self, run: RunId, sweep: f64) -> Path {
        let Run { workpiece_ball, tool_ball, .. } = &self.model.runs[run];
        let place = |p| at(p, &self.model.alphabet, sweep, |n| self.constant(n));
        Path {
            balls: [workpiece_ball, tool_ball].map(|ball| ball.at.each_ref().map(place)),
            axes: self.moved(run).iter().map(|(_, axis)| (axis.name.clone(), axis.kind)).collect(),
            measured: [sweep; 2],
            overshoot: 0.0,
            sweeps: Vec::new(),
            points: Vec::new(),
            outward: None,
        }
    }

    /// The axes that move in a run, or stand at a coordinate.
    fn moved(&self, run: RunId) -> Vec<(AxisId, &Axis)> {
        let axes = self.model.axes().enumerate().map(|(i, axis)| (AxisId::from(i), axis));
        axes.filter(|(id, _)| is_moved(&self.model.runs[run], *id)).collect()
    }

    /// The linear axes that a run moves, where its test is not one of a plane (`['X', 'Y']`); axes go by the first letters of their
    /// names, and none is known where one has another.
    pub fn other_plane(&self, run: RunId, plane: [char; 2]) -> Option<Vec<String>> {
        let goes = |id: AxisId| {
            let at = self.coordinates(run, id, &[0.0, 1.0, 2.0, 4.0]);
            at.iter().any(|x| (x - at[0]).abs() > 1e-9)
        };
        let moved = self.moved(run).into_iter().filter(|(id, axis)| axis.kind == AxisKind::Linear && goes(*id));
        let names: Vec<String> = moved.map(|(_, axis)| axis.name.clone()).collect();
        let letters: Vec<char> = names.iter().filter_map(|name| name.chars().next()).collect();
        let known = letters.iter().all(|letter| "XYZUVW".contains(*letter));
        let within = letters.iter().all(|letter| plane.contains(letter));
        let around = plane.iter().all(|letter| letters.contains(letter));
        (known && !within && !around).then_some(names)
    }

    /// The coordinates of axes at each of some sweeps.
    fn points(&self, run: RunId, axes: &[(AxisId, &Axis)], sweeps: &[f64]) -> Vec<Vec<f64>> {
        let along: Vec<Vec<f64>> = axes.iter().map(|(id, _)| self.followed(run, *id, sweeps)).collect();
        (0..sweeps.len()).map(|i| along.iter().map(|axis| axis[i]).collect()).collect()
    }
}

fn is_moved(run: &Run, axis: AxisId) -> bool {
    run.at[axis].poly().is_some()
}

/// The step at which a straight line is [`CHORD`] off the path at most, by its largest second derivative: h = √(8·chord/|x″|).
fn step(points: &[Vec<f64>], weights: &[f64], width: f64) -> f64 {
    let bend = points.windows(3).map(|three| {
        let second = |(axis, weight): (usize, &f64)| {
            weight * (three[0][axis] - 2.0 * three[1][axis] + three[2][axis]) / (width * width)
        };
        weights.iter().enumerate().map(second).map(|x| x * x).sum::<f64>().sqrt()
    });
    let bend = bend.fold(0.0, f64::max);
    (8.0 * CHORD / bend).sqrt().clamp(STEPS[0].to_radians(), STEPS[1].to_radians())
}
