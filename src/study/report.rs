//! What a fit says: numbers with units, and what to be wary of.

use super::budget::{Budget, Instrument, Sources};
use super::called::called;
use super::curve::{Curve, Curves};
use super::fit::{Estimator, Fit, Observation};
use super::histogram::Histogram;
use super::hysteresis::{Hysteresis, hysteresis};
use super::limits::ErrorLimits;
use super::misfit::Look;
use super::recording::Few;
use super::setup::{Setup, SetupError, coordinate};
use super::trace::Trace;
use super::warning::{Warning, warnings};
use super::weighed_down::WeighedDown;
use trunnion_codegen::algebra::{Nominal, Poly};
use trunnion_codegen::emit::equations;
use trunnion_codegen::ids::BaseId;
use trunnion_codegen::quantity::{Quantity, Unit};

/// A fit with units.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Name of the model.
    pub model: String,
    /// How it was estimated.
    pub estimator: Estimator,
    /// Of a factor: `traces` and `histograms` are not there, and neither residuals far out nor mistakes were looked for.
    pub of_factor: bool,
    /// Limits of the machine's errors in every line of the budget that needs them.
    pub limits: ErrorLimits,
    /// What is known of the instrument; nothing is in no line.
    pub instrument: Instrument,
    /// Each run: name, samples, root mean square of its residuals in µm; of one that was measured several times each time, with
    /// its number after the name.
    pub runs: Vec<(String, usize, f64)>,
    /// What each of `runs` read over its sweep, and its residuals.
    pub traces: Vec<Trace>,
    /// How often residuals of each of `runs` are of which size.
    pub histograms: Vec<Histogram>,
    /// The estimated base parameters.
    pub coefficients: Vec<EstimatedCoefficient>,
    /// The estimated functions.
    pub functions: Vec<Curve>,
    /// Condition number of the design, columns scaled.
    pub condition: f64,
    /// Per run, the largest second-order reading that linearisation drops within the stated limits, µm.
    pub neglected: Vec<f64>,
    /// Per run, what it drops of all orders: not more on 95 % of the machines within the limits, µm.
    pub neglected_usual: Vec<f64>,
    /// What was weighed down of each run's readings; none without that.
    pub weighed_down: Vec<(String, WeighedDown)>,
    /// The runs that were measured in both directions.
    pub hysteresis: Vec<Hysteresis>,
    /// What to be wary of.
    pub warnings: Vec<Warning>,
}

/// A base parameter's estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct EstimatedCoefficient {
    /// `k1`
    pub name: String,
    /// What it is in physical parameters, where it is more than the one it is named after.
    pub definition: Option<String>,
    /// Estimate.
    pub value: f64,
    /// Its standard uncertainty from the scatter of the readings alone.
    pub noise_std: f64,
    /// Its combined standard uncertainty.
    pub std: f64,
    /// Its expanded uncertainty, 95 %.
    pub u95: f64,
    /// What that is made of.
    pub budget: Budget,
    /// Unit of all.
    pub unit: String,
}

/// The report of a fit. `without_table` says that the known functions were taken as zero.
///
/// # Errors
/// [`SetupError`] where the second-order derivation overflows.
pub fn report(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    limits: ErrorLimits,
    instrument: &Instrument,
    without_table: bool,
) -> Result<Report, SetupError> {
    let standing = |(o, look): (&Observation, &Look)| {
        let mut few = Few::default();
        o.samples.iter().for_each(|sample| few.add(sample));
        let Ok(standing) = few.standing_for(o, &look.spikes);
        standing
    };
    let standing: Vec<Observation> = observations.iter().zip(&fit.looks).map(standing).collect();
    report_on(setup, &standing, fit, limits, instrument, without_table)
}

/// As [`report`], of a fit of [recordings](super::fit_recorded): `observations` stand for all of their samples.
///
/// # Errors
/// The same.
pub fn report_on(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    limits: ErrorLimits,
    instrument: &Instrument,
    without_table: bool,
) -> Result<Report, SetupError> {
    let name = |b: BaseId| setup.derivation.base[b].name.clone();
    let sources = Sources::new(setup, observations, fit, limits, instrument, without_table);
    let coefficient = |(i, &b): (usize, &BaseId)| {
        let budget = sources.coefficient(b);
        EstimatedCoefficient {
            name: name(b),
            definition: (!setup.derivation.is_alone(b) || !setup.derivation.has_own_name(b))
                .then(|| equations::definition(&setup.model, &setup.derivation, &setup.derivation.base[b])),
            value: fit.values[i],
            noise_std: fit.covariance[(i, i)].max(0.0).sqrt(),
            std: budget.combined.std,
            u95: budget.combined.expanded,
            unit: coefficient_unit(setup, b),
            budget,
        }
    };
    let curves = Curves::new(setup, observations, fit, &sources, limits)?;
    let called = |i: usize| called(setup, observations, i);
    let run = |(i, look): (usize, &Look)| (called(i), look.samples, Unit::Um.from_inner(look.rms));
    Ok(Report {
        model: setup.model.name.clone(),
        estimator: fit.estimator,
        of_factor: fit.of_factor,
        limits,
        instrument: *instrument,
        runs: fit.looks.iter().enumerate().map(run).collect(),
        traces: fit.traces.clone(),
        histograms: fit.histograms.clone(),
        coefficients: fit.base.iter().enumerate().map(coefficient).collect(),
        functions: fit.functions().iter().filter_map(|f| curves.of(f)).collect(),
        condition: fit.separation.condition,
        neglected: curves.neglected.iter().map(|n| Unit::Um.from_inner(n.largest())).collect(),
        neglected_usual: sources.dropped().iter().map(|size| Unit::Um.from_inner(*size)).collect(),
        weighed_down: fit.weighed_down.iter().cloned().enumerate().map(|(i, down)| (called(i), down)).collect(),
        hysteresis: hysteresis(setup, observations, &fit.averages),
        warnings: warnings(setup, observations, fit, without_table, sources.dropped(), instrument.noise),
    })
}

/// Unit of a base parameter: the reading's mm over that of its regressor.
pub fn coefficient_unit(setup: &Setup, base: BaseId) -> String {
    let b = &setup.derivation.base[base];
    if let Some(coefficient) = b.estimates {
        let function = coefficient.function;
        let Some(axis) = setup.axis(function) else { return String::new() };
        let (value, per) = (setup.quantity(function).inner(), coordinate(axis).inner());
        let term = &setup.model.functions[function].basis.functions()[coefficient.term];
        return term.coefficient_unit(&value.to_string(), &per.to_string());
    }
    let run = &setup.derivation.runs[b.run];
    let regressor = run.regressors.iter().find(|(i, _)| *i == base).map(|(_, r)| r);
    let degree = |p: &Poly| {
        let length = |id| matches!(setup.model.alphabet.nominal(id), Nominal::Constant(_));
        let ids = setup.model.alphabet.nominals().map(|(id, _)| id).filter(|id| length(*id));
        p.terms().first().map_or(0, |(m, _)| ids.map(|id| i32::from(m.exponent(id))).sum::<i32>())
    };
    let power = regressor.map_or(0, |r| degree(r.numerator()) - r.denominator().map_or(0, degree));
    let length = Quantity::Length.inner();
    match 1 - power {
        1 => length.to_string(),
        0 => "1".to_owned(),
        -1 => format!("1/{length}"),
        n if n < 0 => format!("1/{length}^{}", -n),
        n => format!("{length}^{n}"),
    }
}
