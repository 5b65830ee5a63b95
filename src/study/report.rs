//! What a fit says: numbers with units, and what to be wary of.

use super::draw::Limits;
use super::fit::{Fit, Observation};
use super::neglected::neglected;
use super::setup::{Setup, SetupError, coordinate};
use super::systematic::{Term, systematic};
use trunnion_codegen::algebra::{Nominal, Poly};
use trunnion_codegen::basis::Basis;
use trunnion_codegen::emit::equations;
use trunnion_codegen::ids::{AxisId, BaseId, FunctionId};
use trunnion_codegen::quantity::{Quantity, Unit};
use trunnion_solver::lstsq::student_t_95;

/// Above this condition (columns scaled) coefficients are called hardly separable: a whole turn of the paper's runs has 184,
/// 220° has 504, −90…90° has 1,180, and 120° already 20,000.
pub const WARN_CONDITION: f64 = 3000.0;

/// A fit with units.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Each run: name, samples, root mean square of its residuals in µm.
    pub runs: Vec<(String, usize, f64)>,
    /// The estimated base parameters.
    pub coefficients: Vec<Coefficient>,
    /// The estimated functions.
    pub functions: Vec<Curve>,
    /// Condition number of the design, columns scaled.
    pub condition: f64,
    /// Per run, the largest second-order reading that linearisation drops within the stated limits, µm.
    pub neglected: Vec<f64>,
    /// What to be wary of.
    pub warnings: Vec<Warning>,
}

/// A base parameter's estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficient {
    /// `k1`
    pub name: String,
    /// Estimate.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
    /// Unit of both.
    pub unit: String,
}

/// An estimated function over the range of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// `eps_xa`
    pub name: String,
    /// Unit of its values: µrad or µm.
    pub unit: Unit,
    /// Name of its coordinate: the axis' letter.
    pub coordinate: String,
    /// Unit of its coordinate: degrees or mm.
    pub coordinate_unit: Unit,
    /// Points every 5° (or over 20 steps of a linear axis) within the range.
    pub points: Vec<Point>,
    /// The largest systematic error that the dropped second-order terms can leave in it, in its unit.
    pub neglected: f64,
    /// The same on machines drawn within the limits: root mean square where it is largest, in its unit.
    pub neglected_typical: f64,
    /// The products of two errors that contribute most there, in its unit.
    pub neglected_terms: Vec<Term>,
}

/// One point of a curve, in its units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Coordinate.
    pub at: f64,
    /// Estimate.
    pub value: f64,
    /// Half width of the 95 % band.
    pub u95: f64,
}

/// What to be wary of.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// These coefficients are hardly told apart.
    HardlySeparated {
        /// Condition number.
        condition: f64,
        /// Names of the coefficients.
        names: Vec<String>,
        /// The data go round a whole turn.
        whole_turn: bool,
    },
    /// An estimated function is seen only together with other errors.
    SeenTogether {
        /// Name of the function.
        function: String,
        /// What is estimated in place of its coefficients: name and definition.
        instead: Vec<(String, String)>,
    },
    /// A known function was taken as zero.
    TakenAsZero {
        /// Its name in a table.
        known: String,
        /// Its unit: µm or µrad.
        unit: Unit,
        /// Per estimated function: name, unit, and the largest error that one unit of it can cause there.
        costs: Vec<(String, Unit, f64)>,
    },
}

impl core::fmt::Display for Warning {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::HardlySeparated { condition, names, whole_turn } => {
                let remedy = match whole_turn {
                    true => "take fewer terms in the bases or add a run (`trunnion plan` compares)",
                    false => "measure over a longer arc",
                };
                write!(
                    f,
                    "these samples hardly tell {} apart (condition {condition:.0}): small disturbances move them far; {remedy}",
                    names.join(", ")
                )
            }
            Self::SeenTogether { function, instead } => {
                let each = instead.iter().map(|(name, sum)| format!("{name} stands for {sum}"));
                write!(f, "{function} is seen only together with other errors: {}", each.collect::<Vec<_>>().join("; "))
            }
            Self::TakenAsZero { known, unit, costs } => {
                write!(f, "no table: {known} is taken as zero")?;
                for (name, own, cost) in costs {
                    write!(f, "; each {unit} of it can put up to {cost:.1} {own} into {name}")?;
                }
                Ok(())
            }
        }
    }
}

/// The report of a fit. `without_table` says that the known functions were taken as zero.
///
/// # Errors
/// [`SetupError`] where the second-order derivation overflows.
pub fn report(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    limits: Limits,
    without_table: bool,
) -> Result<Report, SetupError> {
    let name = |b: BaseId| setup.derivation.base[b].name.clone();
    let coefficient = |(i, &b): (usize, &BaseId)| Coefficient {
        name: name(b),
        value: fit.values[i],
        std: fit.covariance[(i, i)].max(0.0).sqrt(),
        unit: coefficient_unit(setup, b),
    };
    let mut bounds = Vec::new();
    for o in observations {
        let sweeps: Vec<f64> = o.samples.iter().map(|s| s.sweep).collect();
        bounds.push(neglected(setup, o.run, &sweeps, limits)?.bound);
    }
    let curves = setup.estimated().filter_map(|f| curve(setup, observations, fit, f, &bounds, limits).transpose());
    let functions = curves.collect::<Result<Vec<Curve>, SetupError>>()?;
    let mut warnings = Vec::new();
    if fit.separation.condition > WARN_CONDITION {
        let names = fit.separation.weakest.iter().map(|&b| name(b)).collect();
        let whole_turn = observations.iter().any(goes_round);
        warnings.push(Warning::HardlySeparated { condition: fit.separation.condition, names, whole_turn });
    }
    warnings.extend(setup.estimated().filter_map(|f| seen_together(setup, fit, f)));
    if without_table {
        warnings.extend(taken_as_zero(setup, observations, fit));
    }
    let run = |(o, rms): (&Observation, &f64)| {
        (setup.model.runs[o.run].name.clone(), o.samples.len(), Unit::Um.from_inner(*rms))
    };
    Ok(Report {
        runs: observations.iter().zip(&fit.rms).map(run).collect(),
        coefficients: fit.base.iter().enumerate().map(coefficient).collect(),
        functions,
        condition: fit.separation.condition,
        neglected: bounds.iter().map(|b| Unit::Um.from_inner(b.iter().copied().fold(0.0, f64::max))).collect(),
        warnings,
    })
}

/// Whether samples cover a turn but for one coarse step.
fn goes_round(observation: &Observation) -> bool {
    let sweeps = observation.samples.iter().map(|s| s.sweep);
    let (low, high) = sweeps.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (l.min(s), h.max(s)));
    high - low >= 330f64.to_radians()
}

fn seen_together(setup: &Setup, fit: &Fit, function: FunctionId) -> Option<Warning> {
    let own = |b: &&BaseId| {
        let estimates = setup.derivation.base[**b].estimates;
        estimates.is_some_and(|c| c.function == function) && !setup.derivation.is_alone(**b)
    };
    let sum = |&b: &BaseId| {
        let base = &setup.derivation.base[b];
        (base.name.clone(), equations::definition(&setup.model, &setup.derivation, base))
    };
    let instead: Vec<_> = fit.base.iter().filter(own).map(sum).collect();
    (!instead.is_empty()).then(|| Warning::SeenTogether { function: setup.function_name(function), instead })
}

/// Terms of second order that are named with a function.
const NAMED_TERMS: usize = 8;

/// An estimated function where the runs that see it went.
fn curve(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    function: FunctionId,
    bounds: &[Vec<f64>],
    limits: Limits,
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
        points.push(Point { at, value: unit.from_inner(value), u95: unit.from_inner(t * std) });
        let sensitivity = fit.sensitivity(setup, observations, function, coordinate_unit.to_inner(at));
        let sum = |(w, b): (&[f64], &Vec<f64>)| w.iter().zip(b).map(|(w, b)| w.abs() * b).sum::<f64>();
        dropped = dropped.max(unit.from_inner(sensitivity.observations().zip(bounds).map(sum).sum::<f64>()));
    }
    let coordinates: Vec<f64> = points.iter().map(|p| coordinate_unit.to_inner(p.at)).collect();
    let left = systematic(setup, observations, fit, function, limits, &coordinates)?;
    let scaled =
        |t: &Term| Term { name: t.name.clone(), typical: unit.from_inner(t.typical), bound: unit.from_inner(t.bound) };
    Ok(Some(Curve {
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

/// What leaving out the table costs: for each known function the largest error that one unit of it, of the worst shape, can
/// cause in an estimated function.
fn taken_as_zero(setup: &Setup, observations: &[Observation], fit: &Fit) -> Vec<Warning> {
    let mut known: Vec<FunctionId> =
        observations.iter().flat_map(|o| setup.derivation.runs[o.run].known.iter().map(|(f, _)| *f)).collect();
    known.sort_unstable();
    known.dedup();
    let mut costs: Vec<Vec<(String, Unit, f64)>> = vec![Vec::new(); known.len()];
    for function in setup.estimated() {
        let own = setup.quantity(function).deviation();
        let span = observations.iter().flat_map(|o| o.samples.iter().map(|s| s.sweep));
        let (first, last) = span.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
        for (cost, &k) in costs.iter_mut().zip(&known) {
            let one = setup.quantity(k).deviation().to_inner(1.0);
            let largest = (0..=36).map(|i| first + (last - first) * f64::from(i) / 36.0).map(|x| {
                let sensitivity = fit.sensitivity(setup, observations, function, x);
                sensitivity.observations().zip(observations).map(|(w, o)| worst(setup, o, w, k)).sum::<f64>()
            });
            cost.push((setup.function_name(function), own, own.from_inner(largest.fold(0.0, f64::max) * one)));
        }
    }
    let warning = |(&k, costs): (&FunctionId, Vec<_>)| Warning::TakenAsZero {
        known: trunnion_codegen::emit::model::known_name(&setup.model, k),
        unit: setup.quantity(k).deviation(),
        costs,
    };
    known.iter().zip(costs).map(warning).collect()
}

fn worst(setup: &Setup, observation: &Observation, weights: &[f64], known: FunctionId) -> f64 {
    let Some(at) = setup.derivation.runs[observation.run].known.iter().position(|(f, _)| *f == known) else {
        return 0.0;
    };
    let mut row = setup.row(observation.run);
    observation.samples.iter().zip(weights).map(|(s, w)| (w * row.at(s.sweep).1[at]).abs()).sum()
}

/// Unit of a base parameter: the reading's mm over that of its regressor.
pub fn coefficient_unit(setup: &Setup, base: BaseId) -> String {
    let b = &setup.derivation.base[base];
    if let Some(coefficient) = b.estimates {
        let function = coefficient.function;
        let Some(axis) = setup.axis(function) else { return String::new() };
        let (value, per) = (setup.quantity(function).inner(), coordinate(axis).inner());
        return match &setup.model.functions[function].basis {
            Basis::Polynomials(p) => {
                let degree = p.get(usize::from(coefficient.term)).map_or(0, |u| u.0.len().saturating_sub(1));
                format!("{value}/{per}^{degree}")
            }
            _ => value.to_string(),
        };
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
