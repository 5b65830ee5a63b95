//! `trunnion plan --for`: runs for a function, ready for the model file.

use crate::commands::Refused;
use crate::commands::model::lengths;
use crate::commands::output::print;
use crate::commands::predicted::{Measuring, function};
use indicatif::{ProgressBar, ProgressStyle};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::time::Duration;
use trunnion::data::Radius;
use trunnion::document;
use trunnion::study::plan::design::{
    Asked, Budgeted, Design, DesignError, Measured, Proposal, Reachable, design, estimated,
};
use trunnion::study::{ErrorLimits, Instrument, Setup};
use trunnion_codegen::model::{Draft, DraftRun, Model};
use trunnion_codegen::quantity::Unit;

/// What is asked on the command line.
pub struct Wanted<'a> {
    /// The functions.
    pub functions: &'a [String],
    /// What their expanded uncertainties may be, µrad or µm: one for all, or one for each.
    pub within: &'a [f64],
    /// The bar.
    pub radius: Option<Radius>,
    /// Other lengths.
    pub lengths: &'a [String],
    /// Limits of the errors.
    pub limits: ErrorLimits,
    /// What is known of the instrument.
    pub instrument: Instrument,
    /// Samples and noise.
    pub measuring: &'a Measuring,
    /// One object instead of text.
    pub json: bool,
}

impl Wanted<'_> {
    /// Searches, with a progress bar, and prints.
    pub fn run(&self, draft: &Draft, model: &Model) -> Result<(), Refused> {
        let unit = |name: &String| {
            let function = estimated(model, name)?;
            Ok(model.alphabet.error_quantity(model.functions[function].error).deviation())
        };
        let units = self.functions.iter().map(unit).collect::<Result<Vec<Unit>, DesignError>>()?;
        if !matches!(self.within.len(), 0 | 1) && self.within.len() != self.functions.len() {
            let given = self.within.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            return Err(Refused::Within(given, self.functions.len()));
        }
        let within = |(i, name): (usize, &String)| {
            let own = self.within.get(i).or(self.within.first());
            (name.clone(), own.map(|within| units[i].to_inner(*within)))
        };
        let measured = Measured {
            lengths: lengths(model, self.radius, self.lengths)?,
            samples: self.measuring.samples as usize,
            range: (0.0, TAU),
            sigma: self.measuring.sigma(),
            limits: self.limits,
            instrument: self.instrument,
        };
        let asked = Asked { functions: self.functions.iter().enumerate().map(within).collect(), measured };
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} trying {pos} placings of the balls, {elapsed}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(100));
        let found = design(draft, model, &asked, &|placings| bar.set_position(placings as u64));
        bar.finish_and_clear();
        let found = found?;
        Ok(print(&if self.json {
            format!("{:#}\n", document::design(model, &found))
        } else {
            self.text(model, &found, &units)
        })?)
    }

    fn text(&self, model: &Model, found: &Design, units: &[Unit]) -> String {
        let mut out = format!("{}: runs for {}\n", model.name, self.functions.join(", "));
        let setup = found.proposals.first().map(|p| &p.setup);
        let _ = writeln!(
            out,
            "{}{} samples a run, noise ±{} µm, {} runs to choose from; ± is expanded to 95 %",
            setup.map_or_else(String::new, lengths_of),
            self.measuring.samples,
            self.measuring.noise_um,
            found.choices.len()
        );
        for (reachable, unit) in found.functions.iter().zip(units) {
            let [within, best] = [reachable.within, reachable.best].map(|x| unit.from_inner(x));
            let _ = writeln!(
                out,
                "  {}: the least of all sets tried is ± {best:.3} {unit} from all sources; looked for ± {within:.3} {unit}",
                reachable.name
            );
            if let Some(asked) = reachable.asked.map(|x| unit.from_inner(x)).filter(|asked| *asked < within) {
                let _ = writeln!(out, "    ± {asked} {unit} cannot be reached with these runs");
            }
        }
        let over = |(asked, own): (&Reachable, &Budgeted)| asked.asked.is_some_and(|asked| own.measured > asked);
        if found.proposals.first().is_some_and(|p| found.functions.iter().zip(&p.budgets).any(over)) {
            out += "  no set of these runs gives what is asked from all sources of uncertainty; these are the nearest to it\n";
        }
        let Some((first, others)) = found.proposals.split_first() else {
            out += "\nno set of these runs gives that\n";
            return out;
        };
        let _ = writeln!(out, "\n{}", summary(first));
        for run in &first.draft.runs {
            let _ = write!(out, "\n{run}");
        }
        for other in others {
            let names: Vec<&str> = other.draft.runs.iter().map(|run| run.name.value.as_str()).collect();
            let _ = writeln!(out, "\nInstead: {}\n{}", names.join(", "), summary(other));
        }
        let mut more: Vec<&DraftRun> = Vec::new();
        for run in others.iter().flat_map(|other| &other.draft.runs) {
            if !first.draft.runs.iter().chain(more.iter().copied()).any(|own| own.name.value == run.name.value) {
                more.push(run);
            }
        }
        if !more.is_empty() {
            out += "\nRuns of the alternatives\n";
        }
        more.iter().for_each(|run| out += &format!("\n{run}"));
        out
    }
}

fn lengths_of(setup: &Setup) -> String {
    let each = setup.model.alphabet.constants().map(|name| format!("{name} = {} mm, ", setup.constant(name)));
    each.collect()
}

/// `3 placings of the balls, 5 runs, condition 22`, and each function.
fn summary(proposal: &Proposal) -> String {
    let plural = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let (placings, runs) = (plural(proposal.placings, "placing"), plural(proposal.draft.runs.len(), "run"));
    let mut out = format!("{placings} of the balls, {runs}, condition {:.0}", proposal.prediction.condition);
    for predicted in &proposal.prediction.functions {
        let _ = write!(out, "\n  {}", function(&proposal.setup, predicted));
        if let Some(own) = proposal.budgets.iter().find(|own| own.function == predicted.function) {
            let unit = proposal.setup.quantity(own.function).deviation();
            let [measured, whole] = [own.measured, own.whole].map(|u95| unit.from_inner(u95));
            let _ = write!(out, "; ± {measured:.3} {unit} from all sources");
            if whole > 1.01 * measured {
                let _ = write!(out, ", ± {whole:.3} {unit} with what the model takes as exact");
            }
        }
    }
    out
}
