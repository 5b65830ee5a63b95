//! What to be wary of in a fit.

use super::beyond::{Beyond, beyond};
use super::budget::{any_shape, without_table};
use super::dependence::Dependence;
use super::fit::{Fit, Observation};
use super::misfit::{Misfit, Odd, misfit};
use super::separation::Separation;
use super::setup::{Setup, coordinate};
use super::told::Told;
use super::visited::{between, sweeps, visited};
use core::fmt;
use std::f64::consts::{PI, TAU};
use trunnion_codegen::algebra::{Poly, at};
use trunnion_codegen::emit::model;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::{BaseId, FunctionId};
use trunnion_codegen::quantity::Unit;

/// Above this condition (columns scaled) coefficients are called hardly separable: a whole turn of the paper's runs has 184,
/// 220° has 504, −90…90° has 1,180, and 120° already 20,000.
pub const WARN_CONDITION: f64 = 3000.0;

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
    /// An estimated function is not determined.
    NotDetermined {
        /// Name of the function.
        function: String,
        /// How far it is.
        told: Told,
    },
    /// Conditions of a function's basis are at coordinates that the data do not reach.
    ConditionsNotReached {
        /// Name of the function.
        function: String,
        /// The coordinates, in their unit.
        points: Vec<f64>,
        /// Degrees or mm.
        unit: Unit,
    },
    /// Data are outside the interval for which a function's basis is stated.
    OutsideConditions {
        /// Name of the function.
        function: String,
        /// The interval, in its unit.
        interval: (f64, f64),
        /// What the data visit, in the same.
        visited: (f64, f64),
        /// Degrees or mm.
        unit: Unit,
    },
    /// An axis was measured beyond its range.
    BeyondRange(Beyond),
    /// Residuals are no noise.
    Misfit(Misfit),
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

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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
            Self::NotDetermined { function, told } => {
                write!(f, "{function} is {}", told.words)?;
                told.sum.as_ref().map_or(Ok(()), |sum| write!(f, ": the values are those of {sum}"))
            }
            Self::ConditionsNotReached { function, points, unit } => {
                let points: Vec<String> = points.iter().map(|x| format!("{x:.4}")).collect();
                write!(
                    f,
                    "the basis of {function} has conditions at {} {unit}, which the data do not reach: \
                     what is said of {function} rests on them as much as on the readings",
                    points.join(" and ")
                )
            }
            Self::OutsideConditions { function, interval, visited, unit } => write!(
                f,
                "the basis of {function} is stated from {:.4} to {:.4} {unit}, the data go from {:.4} to {:.4}: \
                 outside, its polynomials are only continued",
                interval.0, interval.1, visited.0, visited.1
            ),
            Self::BeyondRange(beyond) => beyond.fmt(f),
            Self::Misfit(Misfit { runs, mistake, without_table, of_factor }) => {
                let each = runs.iter().map(|Odd { run, look, times }| {
                    let (rms, r) = (Unit::Um.from_inner(look.rms), look.correlation);
                    let spikes = match look.spikes.len() {
                        0 => String::new(),
                        n => format!(", {n} far out"),
                    };
                    let times = times.map_or(String::new(), |times| format!(", {times:.1} times what is stated"));
                    format!("{run} ({rms:.3} µm rms{times}, correlation of neighbours {r:.2}{spikes})")
                });
                write!(f, "the residuals are not noise: {}; ", each.collect::<Vec<_>>().join(", "))?;
                match mistake {
                    Some(mistake) => write!(f, "{mistake}"),
                    None if *without_table => f.write_str("the known functions, taken as zero, are in them"),
                    None if *of_factor => {
                        f.write_str("which mistake explains it only a fit of the samples tells, not one of a factor")
                    }
                    None => f.write_str("no usual mistake explains it: the machine may do what the bases cannot"),
                }
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

impl Warning {
    /// Said where coefficients are hardly told apart.
    pub(super) fn hardly_separated(setup: &Setup, separation: &Separation, whole_turn: bool) -> Option<Self> {
        let name = |&b: &BaseId| setup.derivation.base[b].name.clone();
        (separation.condition > WARN_CONDITION).then(|| Self::HardlySeparated {
            condition: separation.condition,
            names: separation.weakest.iter().map(name).collect(),
            whole_turn,
        })
    }
}

/// All there is to be wary of. `without_table` says that the known functions were taken as zero.
/// `dropped` is what linearisation usually drops of each observation's readings, `noise` what is stated of one, mm.
pub(super) fn warnings(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    without_table: bool,
    dropped: &[f64],
    noise: f64,
) -> Vec<Warning> {
    let whole_turn = observations.iter().any(|o| goes_round(span(std::slice::from_ref(o))));
    let mut warnings: Vec<Warning> =
        Warning::hardly_separated(setup, &fit.separation, whole_turn).into_iter().collect();
    let not_determined = fit.functions().iter().filter(|seen| seen.extent() != Extent::Determined);
    warnings.extend(not_determined.map(|seen| {
        let function = setup.function_name(seen.function());
        Warning::NotDetermined { function, told: seen.told(setup) }
    }));
    warnings.extend(fit.functions().iter().filter_map(|seen| conditions(setup, observations, seen.function())));
    warnings.extend(beyond(setup, observations).into_iter().map(Warning::BeyondRange));
    let untold = without_table && !setup.known(observations.iter().map(|o| o.run)).is_empty();
    warnings.extend(misfit(setup, observations, fit, dropped, noise, untold).map(Warning::Misfit));
    if without_table {
        warnings.extend(taken_as_zero(setup, observations, fit));
    }
    warnings
}

/// First and last sweep, rad.
fn span(observations: &[Observation]) -> (f64, f64) {
    let sweeps = observations.iter().flat_map(|o| o.samples.iter().map(|s| s.sweep));
    sweeps.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), sweep| (low.min(sweep), high.max(sweep)))
}

/// Whether a range is a turn but for one coarse step.
pub(super) fn goes_round((low, high): (f64, f64)) -> bool {
    high - low >= 330f64.to_radians()
}

/// Coordinates this near, rad, count as reached: a coarse step of a whole turn.
const NEAR: f64 = 0.2;

/// Whether the data suit the conditions of a function's basis.
fn conditions(setup: &Setup, observations: &[Observation], function: FunctionId) -> Option<Warning> {
    let basis = &setup.model.functions[function].basis;
    let (axis, _) = setup.model.axis_of(setup.model.functions[function].error)?;
    let unit = coordinate(setup.axis(function)?).coordinate();
    let number = |p: &Poly| at(p, &setup.model.alphabet, 0.0, |n| setup.constant(n));
    let mut points: Vec<f64> = basis.points().iter().map(number).collect();
    points.sort_by(f64::total_cmp);
    points.dedup();
    let interval = (*points.first()?, *points.last()?);
    let along = |(run, sweeps): (_, Vec<f64>)| setup.coordinates(run, axis, &sweeps);
    let data: Vec<f64> = sweeps(observations).flat_map(along).collect();
    let visited = visited(setup, function, sweeps(observations))?;
    let function = setup.function_name(function);
    let near = if unit == Unit::Deg { NEAR } else { NEAR * (visited.1 - visited.0) };
    let (low, high) = (interval.0 - near, interval.1 + near);
    if basis.turn_from().is_none() && interval.0 < interval.1 && !(low <= visited.0 && visited.1 <= high) {
        let degrees = |(a, b): (f64, f64)| (unit.from_inner(a), unit.from_inner(b));
        return Some(Warning::OutsideConditions {
            function,
            interval: degrees(interval),
            visited: degrees(visited),
            unit,
        });
    }
    let away = |x: f64, point: f64| match basis.turn_from() {
        Some(_) => ((x - point + PI).rem_euclid(TAU) - PI).abs(),
        None => (x - point).abs(),
    };
    points.retain(|point| data.iter().all(|x| away(*x, *point) > near));
    let points: Vec<f64> = points.into_iter().map(|x| unit.from_inner(x)).collect();
    (!points.is_empty()).then_some(Warning::ConditionsNotReached { function, points, unit })
}

/// What leaving out the table costs: for each known function the largest error that one unit of it, of the worst shape, can
/// cause in an estimated function.
fn taken_as_zero(setup: &Setup, observations: &[Observation], fit: &Fit) -> Vec<Warning> {
    let known = setup.known(observations.iter().map(|o| o.run));
    let (ignored, on) = (without_table(setup, observations), Dependence::new(setup, observations, fit));
    let mut costs: Vec<Vec<(String, Unit, f64)>> = vec![Vec::new(); known.len()];
    for function in setup.estimated() {
        let own = setup.quantity(function).deviation();
        let Some(range) = visited(setup, function, sweeps(observations)) else { continue };
        for (cost, (&k, (_, factors))) in costs.iter_mut().zip(known.iter().zip(&ignored)) {
            let one = setup.quantity(k).deviation().to_inner(1.0);
            let of = |x| any_shape(&on.weights(&fit.functional(setup, function, x)), factors);
            let largest = between(range, 36).map(of);
            cost.push((setup.function_name(function), own, own.from_inner(largest.fold(0.0, f64::max) * one)));
        }
    }
    let warning = |(&k, costs): (&FunctionId, Vec<_>)| Warning::TakenAsZero {
        known: model::known_name(&setup.model, k),
        unit: setup.quantity(k).deviation(),
        costs,
    };
    known.iter().zip(costs).map(warning).collect()
}
