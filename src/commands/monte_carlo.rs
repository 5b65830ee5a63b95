//! `trunnion monte-carlo`: how large the error of an estimated function gets.

use super::fit::Combine;
use super::model::ModelArguments;
use super::output::print;
use super::simulated::SimulationArguments;
use super::{Refused, document};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::fmt::Write;
use trunnion::study::{Draws, Estimator, Setup, Study, design_warning, studies};

/// Arguments of `monte-carlo`.
#[derive(Debug, Args)]
pub struct MonteCarloArguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    simulation: SimulationArguments,
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

impl MonteCarloArguments {
    /// Draws, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        let draws = self.simulation.simulation()?.draws(self.trials);
        let (setup, _) = self.model.setup()?;
        let estimators = self.estimator.map_or(vec![Estimator::TwoStep, Estimator::Joint], |e| vec![e.into()]);
        for &estimator in &estimators {
            if let Some(warning) = design_warning(&setup, draws, estimator)? {
                eprintln!("warning: {estimator}: {warning}");
            }
        }
        let studies = watched(&setup, draws, &estimators)?;
        print(&match self.json {
            true => {
                let studies: Vec<_> = studies.iter().map(document::study).collect();
                format!("{:#}\n", json!({ "model": setup.model.name, "trials": self.trials, "studies": studies }))
            }
            false => text(self.trials, &studies),
        })
    }
}

/// The studies, with a progress bar on standard error.
pub fn watched(setup: &Setup, draws: Draws, estimators: &[Estimator]) -> Result<Vec<Study>, Refused> {
    let bar = ProgressBar::new(draws.trials * (estimators.len() * setup.estimated().count()) as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} machines, {eta} left") {
        bar.set_style(style);
    }
    let studies = studies(setup, draws, estimators, &|| bar.inc(1));
    bar.finish_and_clear();
    Ok(studies?)
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
        for (from, x) in [("noise", &s.noise), ("linearisation", &s.linearisation), ("both", &s.both)] {
            let _ = writeln!(
                out,
                "  {:10} {:9} {from:14} {:8.3} {:8.3} {:8.3} {:8.3}",
                s.function, s.estimator, x.mean, x.median, x.p95, x.max
            );
        }
    }
    out
}
