//! Where a path begins and ends: the axes are at speed in all that is measured, so they need some way beyond it, and the bar its
//! feed-in, within their ranges.

use super::reach::OutOfRange;
use super::setup::Setup;
use std::f64::consts::TAU;
use trunnion_codegen::algebra::{ErrorId, at};
use trunnion_codegen::graph::LANES;
use trunnion_codegen::ids::{AxisId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::model::{Axis, AxisKind};

/// The way by which a bar is shortened into the path, mm: an instrument begins to record there.
pub const FEED_IN: f64 = 1.5;
/// Steps in which an end is looked for, rad.
const STEP: f64 = TAU / 1440.0;
/// What an overshoot takes at most of all that the axes can sweep: half of it is measured.
const OVERSHOOT: f64 = 0.25;
/// What an end makes way for the feed-in by, at most.
const WAY: f64 = 0.125;

/// Where a path begins and ends, and what of it is measured.
pub(super) struct Ends {
    /// The first and the last sweep, rad.
    pub ends: [f64; 2],
    /// How much of either end is not measured, rad.
    pub overshoot: f64,
    /// The bar's direction at both ends, as [`Path::outward`](super::Path::outward).
    pub outward: Option<[Vec<f64>; 2]>,
}

/// A machine without errors.
struct Perfect;

impl ErrorValues for Perfect {
    fn value(&self, _: ErrorId, _: f64) -> f64 {
        0.0
    }
}

impl Setup {
    /// The ends of a run's path that goes on by `overshoot` (rad) beyond what is measured: of a turn and the overshoot, what the axes can
    /// reach. What is measured makes way for it where they cannot go on.
    ///
    /// # Errors
    /// [`OutOfRange`] where a linear axis has no room for the feed-in.
    pub(super) fn ends(&self, run: RunId, moved: &[(AxisId, &Axis)], overshoot: f64) -> Result<Ends, OutOfRange> {
        let whole = self.sweep_range(run, (0.0, TAU));
        let steps = (overshoot / STEP).ceil() as usize;
        let beyond: Vec<f64> = (1..=steps).map(|k| overshoot * k as f64 / steps as f64).collect();
        let farthest = |reached: &dyn Fn(f64) -> bool| {
            let count = beyond.partition_point(|by| reached(*by));
            beyond[..count].last().copied().unwrap_or(0.0)
        };
        let before = farthest(&|by| self.reaches(run, (whole.0 - by, whole.1)).is_ok());
        let behind = farthest(&|by| self.reaches(run, (whole.0 - before, whole.1 + by)).is_ok());
        let width = whole.1 - whole.0 + before + behind;
        let overshoot = overshoot.min(OVERSHOOT * width);
        let (first, last) = (whole.0 - before.min(overshoot), whole.1 + behind.min(overshoot));
        let (first, at_first) = self.fed_in(run, moved, first, WAY * width)?;
        let (last, at_last) = self.fed_in(run, moved, last, -WAY * width)?;
        self.reaches(run, (first, last))?;
        let outward = at_first.zip(at_last).map(|(first, last)| [first, last]);
        Ok(Ends { ends: [first, last], overshoot, outward })
    }

    /// Where an end is that has room for the feed-in: there, or by up to `way` (rad) on; and the bar's direction, none where no axis
    /// lengthens it.
    fn fed_in(
        &self,
        run: RunId,
        moved: &[(AxisId, &Axis)],
        end: f64,
        way: f64,
    ) -> Result<(f64, Option<Vec<f64>>), OutOfRange> {
        let mut beyond = None;
        for step in 0..=(way.abs() / STEP) as usize {
            let sweep = end + (step as f64 * STEP).copysign(way);
            let Some(outward) = self.outward(run, moved, sweep) else { return Ok((end, None)) };
            let limited = moved.iter().zip(&outward).filter_map(|((id, axis), by)| {
                let at = self.coordinates(run, *id, &[sweep])[0] + FEED_IN * by;
                let [low, high] = axis.range.filter(|_| axis.kind == AxisKind::Linear)?;
                (!(low..=high).contains(&at)).then(|| self.out_of_range(run, *id, at))
            });
            match limited.into_iter().next() {
                None => return Ok((sweep, Some(outward))),
                first => beyond = beyond.or(first),
            }
        }
        beyond.map_or(Ok((end, None)), Err)
    }

    /// What the linear axes have to do to lengthen a bar by one, at a sweep.
    fn outward(&self, run: RunId, moved: &[(AxisId, &Axis)], sweep: f64) -> Option<Vec<f64>> {
        let bar = self.bar(run)?;
        let mut balls = [[[0.0; LANES]; 3]; 2];
        self.exact(run, &[sweep]).run().balls(0, &Perfect, &mut balls);
        let unit: [f64; 3] = core::array::from_fn(|i| (balls[1][i][0] - balls[0][i][0]) / bar);
        let mut left = unit;
        let by = moved.iter().map(|(id, axis)| {
            let Some(direction) = self.moves(*id, axis) else { return 0.0 };
            let by: f64 = (0..3).map(|i| unit[i] * direction[i]).sum();
            (0..3).for_each(|i| left[i] -= by * direction[i]);
            by
        });
        let by: Vec<f64> = by.collect();
        left.iter().all(|x| x.abs() < 1e-6).then_some(by)
    }

    /// Where a linear axis that no rotary one carries moves the tool against the workpiece.
    fn moves(&self, id: AxisId, axis: &Axis) -> Option<[f64; 3]> {
        let (workpiece, place) = (self.model.workpiece.len(), usize::from(id));
        let (carriers, sign) = if place < workpiece {
            (&self.model.workpiece[..place], -1.0)
        } else {
            (&self.model.tool[..place - workpiece], 1.0)
        };
        let carried = carriers.iter().any(|axis| axis.kind == AxisKind::Rotary);
        let value = |p| sign * at(p, &self.model.alphabet, 0.0, |n| self.constant(n));
        (axis.kind == AxisKind::Linear && !carried).then(|| axis.direction.each_ref().map(value))
    }
}
