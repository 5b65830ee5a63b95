//! What to be wary of in a fit.

use super::fit::{Fit, Observation};
use super::least_squares::Separation;
use super::setup::Setup;
use core::fmt;
use trunnion_codegen::emit::{equations, model};
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
pub(super) fn warnings(setup: &Setup, observations: &[Observation], fit: &Fit, without_table: bool) -> Vec<Warning> {
    let whole_turn = observations.iter().any(|o| goes_round(span(std::slice::from_ref(o))));
    let mut warnings: Vec<Warning> =
        Warning::hardly_separated(setup, &fit.separation, whole_turn).into_iter().collect();
    warnings.extend(setup.estimated().filter_map(|f| seen_together(setup, fit, f)));
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
        let (first, last) = span(observations);
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
        known: model::known_name(&setup.model, k),
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
