//! `trunnion monte-carlo`: how large the error of an estimated function gets.

use super::Refused;
use super::measured::Combine;
use super::model::ModelArguments;
use super::number;
use super::output::{print, say};
use super::simulated::SimulationArguments;
use super::stated::{INSTRUMENT, InstrumentArguments};
use clap::{ArgGroup, Args};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::fmt::Write;
use trunnion::document;
use trunnion::study::{
    Drawn, Draws, EstimateError, Estimator, MachineErrors, Setup, Study, design_warning, studies, supplement,
};
use trunnion_codegen::identify::Extent;

/// Arguments of `monte-carlo`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("measured_with").args(INSTRUMENT).multiple(true).requires("budget"))]
pub struct MonteCarloArguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    simulation: SimulationArguments,
    /// Number of machines.
    #[arg(long, default_value_t = 2000, value_parser = number::count::<1, 100_000>, allow_negative_numbers = true)]
    trials: u32,
    /// Only this estimator.
    #[arg(long, value_enum)]
    estimator: Option<Combine>,
    /// Instead, check the uncertainty budget: the whole measurement drawn many times over, every line of it (GUM, Supplement 1).
    #[arg(long)]
    budget: bool,
    #[command(flatten)]
    instrument: InstrumentArguments,
    /// Instead, draw noise alone: what it does is the same on every machine.
    #[arg(long, conflicts_with_all = ["budget", "length_um", "angle_urad"])]
    noise_alone: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl MonteCarloArguments {
    /// Draws, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        let (setup, simulation) = self.simulation.kept(&self.model, &self.model.source()?)?;
        let draws = simulation.draws(self.trials.into());
        let asked = self.estimator.map_or(vec![Estimator::TwoStep, Estimator::Joint], |e| vec![e.into()]);
        let (mut estimators, mut notes) = (Vec::new(), Vec::new());
        for estimator in asked {
            match design_warning(&setup, draws, estimator) {
                // Not asked for by name: what these runs do not allow is said and left out.
                Err(EstimateError::NoFirstStep) if self.estimator.is_none() => {
                    notes.push("note: no two-step estimate: every run sees an estimated function".to_owned());
                    continue;
                }
                Err(EstimateError::Confounded { .. })
                    if self.estimator.is_none() && estimator == Estimator::TwoStep =>
                {
                    notes.push(
                        "note: no two-step estimate: a step by itself does not tell apart what it sees".to_owned(),
                    );
                    continue;
                }
                other => notes.extend(other?.map(|warning| format!("warning: {estimator}: {warning}"))),
            }
            estimators.push(estimator);
        }
        notes.iter().for_each(say);
        if self.budget {
            return self.check(&setup, draws, &estimators);
        }
        let drawn = if self.noise_alone { Drawn::NoiseAlone } else { Drawn::Machines };
        let studies = watched(&setup, draws, drawn, &estimators)?;
        Ok(print(&match self.json {
            true => {
                let studies: Vec<_> = studies.iter().map(document::study).collect();
                format!("{:#}\n", json!({ "model": setup.model.name, "trials": self.trials, "studies": studies }))
            }
            false => text(&setup, self.trials.into(), drawn, &studies),
        })?)
    }

    /// The budget's intervals beside those of drawn measurements.
    fn check(&self, setup: &Setup, draws: Draws, estimators: &[Estimator]) -> Result<(), Refused> {
        let instrument = self.instrument.instrument(&setup.model)?;
        let mut text = format!(
            "half of each 95 % interval, {} measurements: the budget's, the measurements' (good to {:.0} %)\n",
            draws.trials,
            100.0 * 1.5 / (draws.trials as f64).sqrt()
        );
        let mut objects = Vec::new();
        for &estimator in estimators {
            for c in supplement(setup, draws, estimator, &instrument)? {
                let _ = writeln!(
                    text,
                    "  {:10} {estimator:9} at {:8.1}: {:>10.3} {:>10.3} {}{}",
                    c.function,
                    c.at,
                    c.sum[0],
                    c.sum[1],
                    c.unit,
                    match c.told.extent {
                        Extent::Determined => String::new(),
                        _ => format!(" (its sum); as {}: {:.3}, at most {:.3}", c.function, c.whole[1], c.whole[0]),
                    }
                );
                let object = json!({
                    "function": c.function,
                    "estimator": estimator.to_string(),
                    "unit": c.unit.suffix(),
                    "at": c.at,
                    "sum_u95": { "budget": c.sum[0], "drawn": c.sum[1] },
                    "u95": { "budget": c.whole[0], "drawn": c.whole[1] },
                });
                objects.push(document::with_told(object, &c.told));
            }
        }
        Ok(print(&match self.json {
            true => {
                format!("{:#}\n", json!({ "model": setup.model.name, "trials": draws.trials, "budget": objects }))
            }
            false => text,
        })?)
    }
}

/// The studies, with a progress bar on standard error.
pub fn watched(setup: &Setup, draws: Draws, drawn: Drawn, estimators: &[Estimator]) -> Result<Vec<Study>, Refused> {
    let bar = ProgressBar::new(draws.trials);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} trials, {eta} left") {
        bar.set_style(style);
    }
    let studies = studies(setup, draws, drawn, estimators, &|| bar.inc(1));
    bar.finish_and_clear();
    Ok(studies?)
}

/// A table of the distributions.
pub fn text(setup: &Setup, trials: u64, drawn: Drawn, studies: &[Study]) -> String {
    // Without noise an estimate is also wrong by what is assumed of the machine and is not so.
    let assumed = drawn == Drawn::Machines && !setup.model.assumptions.is_empty();
    let model = if assumed { "model" } else { "linearisation" };
    let what = match drawn {
        Drawn::Machines => "machines",
        Drawn::NoiseAlone => "draws of the noise",
    };
    let mut out = format!("largest error over the range, {trials} {what} (µrad for angles, µm for lengths)\n");
    let _ = writeln!(
        out,
        "  {:10} {:9} {:14} {:>8} {:>8} {:>8} {:>8}",
        "function", "estimator", "from", "mean", "median", "95 %", "max"
    );
    for s in studies {
        let Some(errors) = &s.errors else {
            let _ = writeln!(out, "  {:10} {:9} {}", s.function, s.estimator, s.told.words);
            continue;
        };
        if s.told.extent == Extent::UpTo {
            let _ = writeln!(out, "  {} {}", s.function, s.told.words);
        }
        let mut rows = vec![("noise", &errors.noise)];
        if let Some(MachineErrors { linearisation, both }) = &errors.machines {
            rows.extend([(model, linearisation), ("both", both)]);
        }
        for (from, x) in rows {
            let _ = writeln!(
                out,
                "  {:10} {:9} {from:14} {:8.3} {:8.3} {:8.3} {:8.3}",
                s.function, s.estimator, x.mean, x.median, x.p95, x.max
            );
        }
    }
    if assumed {
        out += "  model: linearisation, and what is assumed where the drawn machines are not so\n";
    }
    out
}
