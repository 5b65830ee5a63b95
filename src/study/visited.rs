//! Where runs take an axis: the coordinates over which a function is evaluated, tabulated and compared.

use super::fit::Observation;
use super::setup::Setup;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::quantity::Unit;

/// The lowest and the highest coordinate of a function's axis (mm or rad) along runs, each given with values of its sweep;
/// `None` where it rests in all of them. A location error is the same at every coordinate: at 0.
pub fn visited<S: AsRef<[f64]>>(
    setup: &Setup,
    function: FunctionId,
    runs: impl IntoIterator<Item = (RunId, S)>,
) -> Option<(f64, f64)> {
    if setup.model.functions[function].is_location() {
        return Some((0.0, 0.0));
    }
    let (axis, _) = setup.model.axis_of_function(function)?;
    let along = |(run, sweeps): (RunId, S)| setup.coordinates(run, axis, sweeps.as_ref());
    let at: Vec<f64> = runs.into_iter().flat_map(along).collect();
    let (low, high) = at.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
    (low <= high).then_some((low, high))
}

/// The sweeps of measured runs.
pub fn sweeps(observations: &[Observation]) -> impl Iterator<Item = (RunId, Vec<f64>)> {
    observations.iter().map(|o| (o.run, o.samples.iter().map(|s| s.sweep).collect()))
}

/// `steps` + 1 coordinates from one end to the other.
pub fn between((low, high): (f64, f64), steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |i| low + (high - low) * i as f64 / steps.max(1) as f64)
}

/// Coordinates at which a function is tabulated, in the unit of its coordinate: every 5°, or 20 steps of a linear axis, and both
/// ends, at which it may well be largest.
pub fn marks((low, high): (f64, f64), unit: Unit) -> Vec<f64> {
    let (low, high) = (unit.from_inner(low), unit.from_inner(high));
    let step = if unit == Unit::Deg { 5.0 } else { (high - low) / 20.0 };
    if step <= 0.0 {
        return vec![low];
    }
    // Rounding in degrees must not lose a point at either end.
    let slack = 1e-9 * step;
    let (first, last) = (((low - slack) / step).ceil() as i64, ((high + slack) / step).floor() as i64);
    let mut marks: Vec<f64> = (first..=last).map(|i| i as f64 * step).collect();
    if marks.first().is_none_or(|mark| mark - slack > low) {
        marks.insert(0, decimal(low));
    }
    if marks.last().is_none_or(|mark| mark + slack < high) {
        marks.push(decimal(high));
    }
    marks
}

/// A coordinate in mm or rad, as a person has stated it in a unit.
pub fn in_unit(unit: Unit, inner: f64) -> f64 {
    decimal(unit.from_inner(inner))
}

/// A coordinate in its unit, without what conversions and sums of steps have added to a decimal fraction.
pub fn decimal(x: f64) -> f64 {
    // No negative zero.
    (x * 1e9).round() / 1e9 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_go_to_both_ends() {
        let degrees = |low: f64, high: f64| marks((low.to_radians(), high.to_radians()), Unit::Deg);
        assert_eq!(degrees(-7.5, 11.0), [-7.5, -5.0, 0.0, 5.0, 10.0, 11.0]);
        assert_eq!(degrees(-5.0, 5.0), [-5.0, 0.0, 5.0]);
        assert_eq!(degrees(1.0, 2.0), [1.0, 2.0]);
        assert_eq!(degrees(3.0, 3.0), [3.0]);
        let along = marks((-10.0, 105.0), Unit::Mm);
        assert_eq!((along[0], along[along.len() - 1], along.len()), (-10.0, 105.0, 22));
    }
}
