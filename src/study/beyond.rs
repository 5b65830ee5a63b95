//! Readings taken where the model says that an axis does not go.

use super::fit::Observation;
use super::setup::{Setup, coordinate};
use super::visited::{decimal, sweeps};
use core::fmt;
use std::f64::consts::TAU;
use trunnion_codegen::ids::AxisId;
use trunnion_codegen::model::{Axis, AxisKind};
use trunnion_codegen::quantity::Unit;

/// So far beyond its range an axis' coordinate may be read at its ends, as a part of the range.
const SLACK: f64 = 1e-3;

/// An axis that was measured beyond its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// The axis.
    pub axis: String,
    /// Its range as the model has it, in `unit`.
    pub range: [f64; 2],
    /// From where to where it was measured, in the same.
    pub measured: [f64; 2],
    /// Degrees or mm.
    pub unit: Unit,
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { axis, range: [low, high], measured: [first, last], unit } = self;
        write!(
            f,
            "axis {axis} was measured from {first:.1} to {last:.1} {unit}, beyond its range in the model, {low} to {high} {unit}: \
             the file may be that of another run, or the range is not this machine's"
        )
    }
}

/// Each axis that was measured beyond its range; a turn more or less is the same place of a rotary one.
pub(super) fn beyond(setup: &Setup, observations: &[Observation]) -> Vec<Beyond> {
    let axes = setup.model.axes().enumerate().filter_map(|(at, axis)| Some((AxisId::from(at), axis, axis.range?)));
    let one = |(id, axis, [low, high]): (AxisId, &Axis, [f64; 2])| {
        let at: Vec<f64> = sweeps(observations).flat_map(|(run, sweeps)| setup.coordinates(run, id, &sweeps)).collect();
        let slack = SLACK * (high - low);
        let within = |x: &f64| {
            let above = x - (low - slack);
            let above = if axis.kind == AxisKind::Rotary { above.rem_euclid(TAU) } else { above };
            (0.0..=high - low + 2.0 * slack).contains(&above)
        };
        let unit = coordinate(axis).coordinate();
        let ends = at.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)]);
        let shown = |ends: [f64; 2]| ends.map(|x| decimal(unit.from_inner(x)));
        let told = || Beyond { axis: axis.name.clone(), range: shown([low, high]), measured: shown(ends), unit };
        (!at.iter().all(within)).then(told)
    };
    axes.filter_map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_beyond_its_range_is_told() {
        let setup = Setup::from_catalogue("tilting-table-b", &[]).unwrap();
        let run = setup.model.runs.keys().next().unwrap();
        let told = |from: f64, to: f64| {
            let sweeps = [from, (from + to) / 2.0, to].map(f64::to_radians);
            let told = beyond(&setup, &[Observation::zero(&setup, run, &sweeps)]);
            told.iter().map(Beyond::to_string).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(told(-30.0, 110.0), "");
        assert_eq!(told(-30.1, 110.1), "", "an encoder's noise");
        assert_eq!(told(330.0, 470.0), "", "a turn further");
        let expected = "axis B was measured from -105.0 to 104.0 deg, beyond its range in the model, -30 to 110 deg: ";
        assert!(told(-105.0, 104.0).starts_with(expected), "{}", told(-105.0, 104.0));
    }
}
