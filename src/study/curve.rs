//! An estimated function over the range of the data, with its band and what linearisation leaves in it.

use super::draw::ErrorLimits;
use super::fit::{Fit, Observation};
use super::setup::{Setup, SetupError, coordinate};
use super::systematic::{Contribution, systematic};
use trunnion_codegen::ids::{AxisId, FunctionId};
use trunnion_codegen::quantity::Unit;
use trunnion_solver::lstsq::student_t_95;

/// An estimated function over the range of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The function.
    pub function: FunctionId,
    /// `eps_xa`
    pub name: String,
    /// Unit of its values: µrad or µm.
    pub unit: Unit,
    /// Name of its coordinate: the axis' letter.
    pub coordinate: String,
    /// Unit of its coordinate: degrees or mm.
    pub coordinate_unit: Unit,
    /// Points every 5° (or over 20 steps of a linear axis) within the range.
    pub points: Vec<CurvePoint>,
    /// The largest systematic error that the dropped second-order terms can leave in it, in its unit.
    pub neglected: f64,
    /// The same on machines drawn within the limits: root mean square where it is largest, in its unit.
    pub neglected_typical: f64,
    /// The products of two errors that contribute most there, in its unit.
    pub neglected_terms: Vec<Contribution>,
}

/// One point of a curve, in its units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Coordinate.
    pub at: f64,
    /// Estimate.
    pub value: f64,
    /// Half width of the 95 % band.
    pub u95: f64,
}

/// Terms of second order that are named with a function.
const NAMED_TERMS: usize = 8;

/// An estimated function where the runs that see it went.
pub(super) fn curve(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    function: FunctionId,
    bounds: &[Vec<f64>],
    limits: ErrorLimits,
) -> Result<Option<Curve>, SetupError> {
    let Some((axis, _)) = setup.model.axis_of(setup.model.functions[function].error) else { return Ok(None) };
    let Some(along) = setup.axis(function) else { return Ok(None) };
    let coordinate_unit = coordinate(along).coordinate();
    let coordinates: Vec<f64> =
        observations.iter().flat_map(|o| coordinates(setup, o, axis)).map(|x| coordinate_unit.from_inner(x)).collect();
    let low = coordinates.iter().copied().fold(f64::INFINITY, f64::min);
    let high = coordinates.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let step = if coordinate_unit == Unit::Deg { 5.0 } else { (high - low) / 20.0 };
    // Rounding in degrees must not lose a point at either end.
    let slack = 1e-9 * step;
    let (first, last) = (((low - slack) / step).ceil() as i64, ((high + slack) / step).floor() as i64);
    let unit = setup.quantity(function).deviation();
    let t = student_t_95::<f64>(fit.degrees_of_freedom);
    let mut dropped = 0.0f64;
    let mut points = Vec::new();
    for i in first..=last {
        let at = i as f64 * step;
        let (value, std) = fit.function(setup, function, coordinate_unit.to_inner(at));
        points.push(CurvePoint { at, value: unit.from_inner(value), u95: unit.from_inner(t * std) });
        let sensitivity = fit.sensitivity(setup, observations, function, coordinate_unit.to_inner(at));
        let sum = |(w, b): (&[f64], &Vec<f64>)| w.iter().zip(b).map(|(w, b)| w.abs() * b).sum::<f64>();
        dropped = dropped.max(unit.from_inner(sensitivity.observations().zip(bounds).map(sum).sum::<f64>()));
    }
    let coordinates: Vec<f64> = points.iter().map(|p| coordinate_unit.to_inner(p.at)).collect();
    let left = systematic(setup, observations, fit, function, limits, &coordinates)?;
    let scaled = |t: &Contribution| Contribution {
        name: t.name.clone(),
        typical: unit.from_inner(t.typical),
        bound: unit.from_inner(t.bound),
    };
    Ok(Some(Curve {
        function,
        name: setup.function_name(function),
        unit,
        coordinate: along.name.to_lowercase(),
        coordinate_unit,
        points,
        neglected: dropped,
        neglected_typical: unit.from_inner(left.typical),
        neglected_terms: left.terms.iter().take(NAMED_TERMS).filter(|t| t.typical > 0.0).map(scaled).collect(),
    }))
}

fn coordinates(setup: &Setup, observation: &Observation, axis: AxisId) -> Vec<f64> {
    let sweeps: Vec<f64> = observation.samples.iter().map(|s| s.sweep).collect();
    setup.exact(observation.run, &sweeps).run().coordinates(axis).flatten().collect()
}
