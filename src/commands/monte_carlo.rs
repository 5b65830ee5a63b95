//! `trunnion monte-carlo`: how large the error of an estimated function gets.

use super::fit::Combine;
use super::model::ModelArguments;
use super::simulated::Simulation;
use super::{Refused, estimate, print};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use std::fmt::Write;
use trunnion::data::Unit;
use trunnion::study::{Estimator, Observation, Plan, Setup, Spread, Trial, WARN_CONDITION, Warning, fit, monte_carlo};
use trunnion_codegen::ids::{FunctionId, RunId};

/// Arguments of `monte-carlo`.
#[derive(Debug, Args)]
pub struct MonteCarlo {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    simulation: Simulation,
    /// Number of machines.
    #[arg(long, default_value_t = 2000, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    trials: u64,
    /// Only this estimator.
    #[arg(long, value_enum)]
    estimator: Option<Combine>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Distributions of the largest error of one function with one estimator.
pub struct Study {
    pub estimator: Estimator,
    pub function: String,
    /// What it comes from, in µrad or µm.
    pub spreads: [(&'static str, Spread); 3],
}

impl MonteCarlo {
    /// Draws, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        self.simulation.check()?;
        let (setup, _) = self.model.setup()?;
        let estimators = self.estimator.map_or(vec![Estimator::TwoStep, Estimator::Joint], |e| vec![e.into()]);
        for &estimator in &estimators {
            warn(&setup, &self.simulation, estimator)?;
        }
        let studies = studies(&setup, &self.simulation, self.trials, &estimators)?;
        let text = match self.json {
            true => format!(
                "{:#}\n",
                json!({ "model": setup.model.name, "trials": self.trials, "studies": studies.iter().map(object).collect::<Vec<_>>() })
            ),
            false => text(self.trials, &studies),
        };
        print(&text)
    }
}

/// Says on standard error where the range is too short for the numbers to mean much.
fn warn(setup: &Setup, simulation: &Simulation, estimator: Estimator) -> Result<(), Refused> {
    let name = |run: RunId| setup.model.runs[run].name.clone();
    let sweeps = simulation.sweeps();
    let design: Vec<Observation> = setup.model.runs.keys().map(|r| Observation::zero(setup, r, &sweeps)).collect();
    let separation = fit(setup, &design, estimator).map_err(|e| Refused::fit(setup, &name, &e))?.separation;
    if separation.condition > WARN_CONDITION {
        let names = separation.weakest.iter().map(|&b| setup.derivation.base[b].name.clone()).collect();
        let warning = Warning::HardlySeparated {
            condition: separation.condition,
            names,
            whole_turn: simulation.to_deg - simulation.from_deg >= 330.0,
        };
        eprintln!("warning: {}: {warning}", estimate::name(estimator));
    }
    Ok(())
}

/// Runs every estimator on every estimated function, with a progress bar on standard error.
pub fn studies(
    setup: &Setup,
    simulation: &Simulation,
    trials: u64,
    estimators: &[Estimator],
) -> Result<Vec<Study>, Refused> {
    let plan = Plan {
        trials,
        samples: simulation.samples,
        range: simulation.range(),
        limits: simulation.limits(),
        noise: simulation.noise_um * Unit::Um.factor(),
        seed: simulation.seed,
    };
    let functions: Vec<FunctionId> = setup.estimated().collect();
    if functions.is_empty() {
        return Err(Refused::NothingEstimated);
    }
    let bar = ProgressBar::new(trials * estimators.len() as u64 * functions.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} machines, {eta} left") {
        bar.set_style(style);
    }
    let mut studies = Vec::new();
    for &estimator in estimators {
        for &f in &functions {
            let trials = monte_carlo(setup, plan, estimator, f, &|| bar.inc(1));
            let trials = trials.map_err(|e| Refused::fit(setup, &|r| setup.model.runs[r].name.clone(), &e))?;
            let unit = setup.quantity(f).deviation();
            let spread = |of: fn(&Trial) -> f64| Spread::of(trials.iter().map(|t| unit.from_inner(of(t))).collect());
            let all = [
                ("noise", spread(|t| t.noise)),
                ("linearisation", spread(|t| t.linearisation)),
                ("both", spread(|t| t.both)),
            ];
            if let [(a, Some(x)), (b, Some(y)), (c, Some(z))] = all {
                studies.push(Study { estimator, function: setup.function_name(f), spreads: [(a, x), (b, y), (c, z)] });
            }
        }
    }
    bar.finish_and_clear();
    Ok(studies)
}

fn object(s: &Study) -> Value {
    let spread = |x: &Spread| json!({ "mean": x.mean, "median": x.median, "p95": x.p95, "max": x.max });
    let spreads = s.spreads.iter().map(|(from, x)| ((*from).to_owned(), spread(x)));
    json!({ "function": s.function, "estimator": estimate::name(s.estimator), "largest_error": spreads.collect::<serde_json::Map<_, _>>() })
}

/// A table of the distributions.
pub fn text(trials: u64, studies: &[Study]) -> String {
    let mut out = format!("largest error over the range, {trials} machines (µrad for angles, µm for lengths)\n");
    let _ = writeln!(
        out,
        "  {:10} {:9} {:14} {:>8} {:>8} {:>8} {:>8}",
        "function", "estimator", "from", "mean", "median", "95 %", "max"
    );
    for s in studies {
        for (from, x) in &s.spreads {
            let estimator = estimate::name(s.estimator);
            let _ = writeln!(
                out,
                "  {:10} {estimator:9} {from:14} {:8.3} {:8.3} {:8.3} {:8.3}",
                s.function, x.mean, x.median, x.p95, x.max
            );
        }
    }
    out
}
