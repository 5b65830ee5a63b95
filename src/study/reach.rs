//! Where a run's sweep may go: every axis stays within its range.

use super::setup::{Setup, coordinate};
use super::visited::{between, in_unit};
use std::f64::consts::TAU;
use thiserror::Error;
use trunnion_codegen::ids::{AxisId, RunId};
use trunnion_codegen::quantity::Unit;

/// Steps of a turn in which the sweep is looked at: a quarter of a degree.
const STEPS: usize = 1440;
/// Rounding of a coordinate at the end of its range, mm or rad.
const SLACK: f64 = 1e-9;

/// A sweep that takes an axis out of its range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "run {run}: axis {axis} would go to {reached:.3} {unit}\n  expected it within its range, {low} to {high} {unit}"
)]
pub struct OutOfRange {
    /// The run.
    pub run: String,
    /// The axis.
    pub axis: String,
    /// Where it would be, in `unit`.
    pub reached: f64,
    /// Its range, in `unit`.
    pub low: f64,
    /// The same.
    pub high: f64,
    /// Degrees or mm.
    pub unit: Unit,
}

impl Setup {
    /// Whether a run stays within its axes' ranges all along `range` of its sweep, rad.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first coordinate beyond.
    pub fn reaches(&self, run: RunId, range: (f64, f64)) -> Result<(), OutOfRange> {
        let at: Vec<f64> = between(range, STEPS).collect();
        match self.beyond(run, &at).into_iter().flatten().next() {
            None => Ok(()),
            Some((axis, at)) => Err(self.out_of_range(run, axis, at)),
        }
    }

    /// What of `range` (rad) a run can sweep with every axis in its range: all of it, or the longest part; of a whole turn the
    /// longest part of any turn, so that an axis that goes from −30° to 110° is swept so.
    pub fn sweep_range(&self, run: RunId, range: (f64, f64)) -> (f64, f64) {
        if self.reaches(run, range).is_ok() {
            return range;
        }
        let whole = range.1 - range.0 >= TAU - SLACK;
        let looked_at = if whole { (range.0 - TAU, range.1) } else { range };
        let steps = ((looked_at.1 - looked_at.0) / TAU * STEPS as f64).ceil() as usize;
        let at: Vec<f64> = between(looked_at, steps).collect();
        let inside: Vec<bool> = self.beyond(run, &at).iter().map(Option::is_none).collect();
        let (mut longest, mut start) = ((0, 0), None);
        for i in 0..=at.len() {
            match (inside.get(i) == Some(&true), start) {
                (true, None) => start = Some(i),
                (false, Some(from)) => {
                    // Of equal ones the last, which is the one within the turn that was asked for.
                    if i - 1 - from >= longest.1 - longest.0 {
                        longest = (from, i - 1);
                    }
                    start = None;
                }
                _ => {}
            }
        }
        let (from, to) = (at[longest.0], at[longest.1]);
        (from, to.min(from + TAU))
    }

    /// At each sweep, in their order, the first axis beyond its range, and where it is.
    fn beyond(&self, run: RunId, sweeps: &[f64]) -> Vec<Option<(AxisId, f64)>> {
        let mut beyond = vec![None; sweeps.len()];
        let limited = self.model.axes().enumerate().filter_map(|(i, axis)| Some((AxisId::from(i), axis.range?)));
        let limited: Vec<(AxisId, [f64; 2])> = limited.collect();
        if limited.is_empty() {
            return beyond;
        }
        for (axis, [low, high]) in limited {
            for (place, x) in beyond.iter_mut().zip(self.followed(run, axis, sweeps)) {
                let out = !(low - SLACK..=high + SLACK).contains(&x);
                *place = place.or(out.then_some((axis, x)));
            }
        }
        beyond
    }

    pub(super) fn out_of_range(&self, run: RunId, axis: AxisId, at: f64) -> OutOfRange {
        let described = self.model.axis(axis);
        let unit = described.map_or(Unit::Mm, |a| coordinate(a).coordinate());
        let [low, high] = described.and_then(|a| a.range).unwrap_or_default().map(|end| in_unit(unit, end));
        OutOfRange {
            run: self.model.runs[run].name.clone(),
            axis: described.map_or_else(String::new, |a| a.name.clone()),
            reached: in_unit(unit, at),
            low,
            high,
            unit,
        }
    }
}
