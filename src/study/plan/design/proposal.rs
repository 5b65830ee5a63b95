//! What to measure for a function: the sets found by numbers, held against the exact derivation of each.

use super::budgets::{Budgeted, budgets};
use super::choices::{Choices, with_runs};
use super::pool::{Measured, Pool};
use super::search::{Enough, Next, Within, fewest, grade};
use crate::study::plan::{Intended, Prediction, predict, uniform_std};
use crate::study::{EstimateError, Estimator, Setup, SetupError};
use thiserror::Error;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Draft, DraftRun, Model};
use trunnion_codegen::quantity::Unit;

/// A function's uncertainty may be this much larger than the least that can be reached, where nothing is asked.
pub(super) const NEAR: f64 = 1.1;
/// Standard uncertainties in an expanded one.
pub(super) const COVERAGE_FACTOR: f64 = 1.96;
/// Alternatives beside the best.
const ALTERNATIVES: usize = 2;
/// Sets that are derived exactly, at most.
const TRIED: usize = 150;
/// A condition up to which everything that the runs see is told apart well.
const WELL: f64 = 1000.0;
/// Times its limit: so large is an error that nothing is known of.
pub(super) const UNKNOWN: f64 = 100.0;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The functions by name, each with what its expanded uncertainty may be (mm or rad) where that is said.
    pub functions: Vec<(String, Option<f64>)>,
    /// How it would be measured.
    pub measured: Measured,
}

/// Why nothing is proposed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DesignError {
    /// Not an estimated function of the model.
    #[error("`{name}` is no estimated function of this model\n  expected {known}")]
    NoFunction {
        /// The name given.
        name: String,
        /// Those there are.
        known: String,
    },
    /// The machine with the runs to choose from, or with those proposed, has no measurement model.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The proposed runs give no estimate.
    #[error(transparent)]
    Estimate(#[from] EstimateError),
}

/// Runs proposed for what is asked.
#[derive(Clone, Debug)]
pub struct Design {
    /// All runs there were to choose from.
    pub choices: Vec<DraftRun>,
    /// What can be reached of each function.
    pub functions: Vec<Reachable>,
    /// Sets that suffice, the best first.
    pub proposals: Vec<Proposal>,
}

/// What can be reached of a function; expanded uncertainties of 95 %, mm or rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Reachable {
    /// Its name.
    pub name: String,
    /// The unit of its values in reports: µrad or µm.
    pub unit: Unit,
    /// What was asked, if anything was.
    pub asked: Option<f64>,
    /// What was looked for: what was asked, or what is near the best.
    pub within: f64,
    /// The least from all that is measured: of the proposals, and of all runs together.
    pub best: f64,
}

/// A set of runs.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The machine with these runs.
    pub draft: Draft,
    /// The same, derived.
    pub setup: Setup,
    /// Placings of the balls.
    pub placings: usize,
    /// What it would give from noise alone.
    pub prediction: Prediction,
    /// What it would give of each function asked for from all sources.
    pub budgets: Vec<Budgeted>,
}

/// Proposes runs for functions of a model; `done` is told how many placings of the balls are being tried.
///
/// # Errors
/// [`DesignError`]
pub fn design(
    draft: &Draft,
    model: &Model,
    asked: &Asked,
    done: &(dyn Fn(usize) + Sync),
) -> Result<Design, DesignError> {
    let functions =
        asked.functions.iter().map(|(name, _)| estimated(model, name)).collect::<Result<Vec<FunctionId>, _>>()?;
    let choices = Choices::all(draft, model, &functions)?;
    let wanted: Vec<Option<f64>> =
        asked.functions.iter().map(|(_, within)| within.map(|expanded| expanded / COVERAGE_FACTOR)).collect();
    let mut weighed = weigh(&choices, &functions, &wanted, asked, UNKNOWN)?;
    let determined = weighed.determined;
    if !determined {
        // Nothing determines all that is asked: what the limits leave is part of it.
        weighed = weigh(&choices, &functions, &wanted, asked, 1.0)?;
    }
    let Weighed { pool, within, .. } = weighed;
    let (mut hardly, mut refused) = (Vec::new(), None);
    let mut held = Held { functions: &functions, wanted: &wanted, asked, within: Vec::new(), over: Vec::new() };
    let mut tried = 0;
    fewest(&pool, &within, done, &mut |enough| {
        tried += 1;
        match exact(draft, &choices, &enough, asked) {
            Err(error) => {
                refused.get_or_insert(error);
            }
            Ok(proposal) => {
                let of = |f: &FunctionId| proposal.prediction.functions.iter().find(|p| p.function == *f);
                let as_said = |f: &FunctionId| of(f).is_some_and(|p| p.told.extent == Extent::Determined);
                if !determined || functions.iter().all(as_said) {
                    match proposal.prediction.condition <= WELL {
                        true => held.take(proposal),
                        false => hardly.push(proposal),
                    }
                }
            }
        }
        if held.within.len() > ALTERNATIVES || tried >= TRIED { Next::Enough } else { Next::More }
    });
    hardly.sort_by_key(|proposal| grade(proposal.prediction.condition));
    let missing = (ALTERNATIVES + 1).saturating_sub(held.within.len());
    hardly.into_iter().take(missing).for_each(|proposal| held.take(proposal));
    let proposals = held.best();
    if let Some(error) = refused.filter(|_| proposals.is_empty()) {
        return Err(error);
    }
    let whole = Setup::new(choices.model.clone(), &lengths(asked)).ok();
    let all = whole.and_then(|setup| budgets(&setup, &functions, &asked.measured).ok());
    let least = |i: usize| {
        let of = proposals.iter().map(|p| &p.budgets).chain(&all);
        of.filter_map(|budgets| Some(budgets.get(i)?.measured)).fold(f64::INFINITY, f64::min)
    };
    let reachable = |(i, (name, asked)): (usize, &(String, Option<f64>))| Reachable {
        name: name.clone(),
        unit: model.alphabet.error_quantity(model.functions[functions[i]].error).deviation(),
        asked: *asked,
        within: within.get(&functions[i]).copied().unwrap_or(f64::INFINITY) * COVERAGE_FACTOR,
        best: least(i),
    };
    let functions = asked.functions.iter().enumerate().map(reachable).collect();
    Ok(Design { choices: choices.runs, functions, proposals })
}

/// Proposals, held to what is asked.
struct Held<'a> {
    functions: &'a [FunctionId],
    /// Standard uncertainties, where anything is asked.
    wanted: &'a [Option<f64>],
    asked: &'a Asked,
    /// Those that give it from all sources.
    within: Vec<Proposal>,
    /// Those that do not, with by how much they miss it.
    over: Vec<(f64, Proposal)>,
}

impl Held<'_> {
    fn take(&mut self, mut proposal: Proposal) {
        proposal.budgets = budgets(&proposal.setup, self.functions, &self.asked.measured).unwrap_or_default();
        let share = |(own, wanted): (&Budgeted, &Option<f64>)| Some(own.measured / (COVERAGE_FACTOR * (*wanted)?));
        let beyond = proposal.budgets.iter().zip(self.wanted).filter_map(share).fold(0.0, f64::max);
        if beyond > 1.0 { self.over.push((beyond, proposal)) } else { self.within.push(proposal) }
    }

    /// Those within; where there is none, the nearest to it.
    fn best(mut self) -> Vec<Proposal> {
        if self.within.is_empty() {
            self.over.sort_by_key(|(beyond, _)| grade(*beyond));
            self.within.extend(self.over.into_iter().take(ALTERNATIVES + 1).map(|(_, proposal)| proposal));
        }
        self.within
    }
}

/// A pool and what is asked of it, as standard uncertainties.
struct Weighed {
    pool: Pool,
    within: Within,
    /// Whether all runs together reach what is asked.
    determined: bool,
}

fn weigh(
    choices: &Choices,
    functions: &[FunctionId],
    wanted: &[Option<f64>],
    asked: &Asked,
    beyond: f64,
) -> Result<Weighed, DesignError> {
    let pool = Pool::new(choices, functions, &asked.measured, beyond)?;
    let best = pool.uncertainties(&pool.known(pool.runs()), functions.iter().copied()).unwrap_or_default();
    let mut within = Within::new();
    let mut determined = true;
    for (&function, wanted) in functions.iter().zip(wanted) {
        let least = best.get(&function).copied().unwrap_or(f64::INFINITY);
        let limit = asked.measured.limits.of_error(&choices.model, choices.model.functions[function].error);
        // Of what is not determined the limits are all that is known.
        determined &= least < wanted.unwrap_or(uniform_std(limit));
        within.insert(function, wanted.map_or(NEAR * least, |wanted| wanted.max(NEAR * least)));
    }
    Ok(Weighed { pool, within, determined })
}

/// The estimated function called so, in the model or in a report.
///
/// # Errors
/// [`DesignError::NoFunction`]
pub fn estimated(model: &Model, name: &str) -> Result<FunctionId, DesignError> {
    let estimated = || model.functions.iter_enumerated().filter(|(_, f)| f.estimate);
    let called = |f: FunctionId| model.alphabet.error_name(model.functions[f].error);
    let known = || estimated().map(|(f, _)| called(f)).collect::<Vec<_>>().join(", ");
    // In a report it is called as its notation says: ε_xa is eps_xa.
    let is = |f: &FunctionId| called(*f) == name || model.notation.function(called(*f)) == name;
    let found = estimated().map(|(f, _)| f).find(is);
    found.ok_or_else(|| DesignError::NoFunction { name: name.to_owned(), known: known() })
}

fn lengths(asked: &Asked) -> Vec<(&str, f64)> {
    asked.measured.lengths.iter().map(|(name, mm)| (name.as_str(), *mm)).collect()
}

/// A set, derived and weighed as a model of its own.
fn exact(draft: &Draft, choices: &Choices, enough: &Enough, asked: &Asked) -> Result<Proposal, DesignError> {
    let runs: Vec<DraftRun> = enough.runs.iter().filter_map(|&i| choices.runs.get(i).cloned()).collect();
    let draft = with_runs(draft, &runs);
    let setup = Setup::new(draft.build().map_err(SetupError::Description)?, &lengths(asked))?;
    let Measured { samples, range, sigma, .. } = asked.measured;
    let prediction = predict(&setup, Intended { samples, range, sigma }, Estimator::Joint)?;
    Ok(Proposal { draft, setup, placings: enough.placings, prediction, budgets: Vec::new() })
}
