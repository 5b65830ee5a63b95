//! How near a report comes to the machine that its readings were simulated on.

use super::draw::SimulatedMachine;
use super::fit::Fit;
use super::report::Report;
use super::setup::Setup;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::kinematics::ErrorValues;

/// The truth beside a report, in the report's order and units.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovery {
    /// True values of the coefficients.
    pub coefficients: Vec<f64>,
    /// The estimated functions.
    pub functions: Vec<RecoveredFunction>,
}

/// The truth beside a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct RecoveredFunction {
    /// True value at each point.
    pub truth: Vec<f64>,
    /// Largest difference of the estimate from it.
    pub largest: f64,
    /// Points whose 95 % band holds it.
    pub inside: usize,
}

/// Compares the report of a fit with the machine; a sum of several errors with that sum.
pub fn recovery(setup: &Setup, machine: &SimulatedMachine, fit: &Fit, report: &Report) -> Recovery {
    let base = machine.base(setup);
    let of = |name: &str| setup.derivation.base.position(|b| b.name == name).map_or(f64::NAN, |b| base[b]);
    let functions = report.functions.iter().map(|curve| {
        let error = setup.model.functions[curve.function].error;
        let sum = fit.seen(curve.function).filter(|_| curve.told.extent == Extent::UpTo);
        let at = |x: f64| {
            let x = curve.coordinate_unit.to_inner(x);
            curve.unit.from_inner(sum.map_or_else(|| machine.value(error, x), |sum| sum.truth(setup, &base, x)))
        };
        let truth: Vec<f64> = curve.points.iter().map(|p| at(p.at)).collect();
        let errors = || curve.points.iter().zip(&truth).map(|(p, truth)| ((p.value - truth).abs(), p.u95));
        RecoveredFunction {
            largest: errors().map(|(error, _)| error).fold(0.0, f64::max),
            inside: errors().filter(|(error, u95)| error <= u95).count(),
            truth,
        }
    });
    Recovery { coefficients: report.coefficients.iter().map(|c| of(&c.name)).collect(), functions: functions.collect() }
}
