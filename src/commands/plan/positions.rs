//! `trunnion plan --positions`: where the runs are best probed.

use crate::commands::output::print;
use crate::commands::predicted::Measuring;
use crate::commands::stated::INSTRUMENT;
use crate::commands::{Refused, number};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use trunnion::data::{Guard, degrees, positions_text, write_table};
use trunnion::document;
use trunnion::plot::MADE;
use trunnion::study::Setup;
use trunnion::study::plan::design::estimated;
use trunnion::study::plan::positions::{Asked, Count, Proposed, propose};
use trunnion::study::plan::{LargestValuation, Predicted, Valuation};
use trunnion_codegen::ids::FunctionId;

/// Options that have no effect on positions.
const IDLE: [&str; 6] = ["range_deg", "without", "samples", "estimator", "length_um", "angle_urad"];

/// Where runs are probed.
#[derive(Debug, Args)]
pub struct PositionArguments {
    /// Instead, propose positions at which each run stops, for all estimated functions or those of --for: so many of each run, or the
    /// fewest of all runs that are within --within.
    #[arg(id = "positions", long = "positions", value_name = "N|fewest", value_parser = wanted, conflicts_with_all = IDLE, conflicts_with_all = INSTRUMENT)]
    pub count: Option<Wanted>,
    /// So many of all runs together, of each as many at least as a fit asks for.
    #[arg(long, requires = "positions")]
    in_all: bool,
    /// Positions to choose from: the multiples of so many degrees, and the ends of the axes' ranges.
    #[arg(long, value_name = "DEG", default_value_t = 5.0, value_parser = number::between, requires = "positions", allow_negative_numbers = true)]
    step_deg: f64,
    /// A file of the positions, for `trunnion new --at`.
    #[arg(long, value_name = "FILE", requires = "positions")]
    out: Option<PathBuf>,
    /// Replaces the file even if it does not say that it is an earlier one.
    #[arg(long, requires = "out")]
    force: bool,
}

/// How many positions are wanted.
#[derive(Clone, Copy, Debug)]
pub enum Wanted {
    /// A number.
    Positions(usize),
    /// As few as suffice.
    Fewest,
}

/// `12`, or `fewest`
fn wanted(text: &str) -> Result<Wanted, String> {
    if text.trim() == "fewest" { Ok(Wanted::Fewest) } else { number::stops(text).map(Wanted::Positions) }
}

/// What is asked beside.
pub struct Asking<'a> {
    /// Names of the functions; all if there is none.
    pub functions: &'a [String],
    /// What their expanded uncertainties may be, µrad or µm: one for all, or one for each.
    pub within: &'a [f64],
    /// The noise.
    pub measuring: &'a Measuring,
}

impl PositionArguments {
    /// Proposes, writes, prints.
    pub fn run(
        &self,
        wanted: Wanted,
        setup: &Setup,
        asking: &Asking,
        inputs: &[PathBuf],
        json: bool,
    ) -> Result<(), Refused> {
        let functions: Vec<FunctionId> = match asking.functions {
            [] => setup.estimated().collect(),
            names => names.iter().map(|name| estimated(&setup.model, name)).collect::<Result<_, _>>()?,
        };
        let asked = Asked {
            count: self.counted(wanted, setup, &functions, asking.within)?,
            functions,
            step_deg: self.step_deg,
            sigma: asking.measuring.sigma(),
        };
        let found = propose(setup, &asked)?;
        if let Some(file) = &self.out {
            let comment = format!("{MADE} trunnion {}: positions for {}", env!("CARGO_PKG_VERSION"), setup.model.name);
            let text = positions_text(&comment, &found.measurements, &found.proposed.positions);
            write_table(file, &text, &Guard { inputs: inputs.to_vec(), force: self.force })?;
        }
        Ok(print(&match json {
            true => format!("{:#}\n", document::positions(setup, &asked, &found)),
            false => self.text(setup, &asked, &found, asking.measuring.noise_um),
        })?)
    }

    fn counted(
        &self,
        wanted: Wanted,
        setup: &Setup,
        functions: &[FunctionId],
        within: &[f64],
    ) -> Result<Count, Refused> {
        match (wanted, within) {
            (Wanted::Positions(count), []) if self.in_all => Ok(Count::InAll(count)),
            (Wanted::Positions(count), []) => Ok(Count::Each(count)),
            (Wanted::Positions(count), _) => {
                Err(Refused::Option("positions", count.to_string(), "no effect of --within on it\n  expected fewest"))
            }
            (Wanted::Fewest, []) => {
                let told = "no --within\n  expected what the expanded uncertainties may be, for example --within 2";
                Err(Refused::Option("positions", "fewest".to_owned(), told))
            }
            (Wanted::Fewest, within) => Count::fewest(setup, functions, within).ok_or_else(|| {
                let given = within.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
                Refused::Within(given, functions.len())
            }),
        }
    }

    fn text(&self, setup: &Setup, asked: &Asked, found: &Proposed, noise_um: f64) -> String {
        let counts: Vec<usize> = found.proposed.positions.iter().map(Vec::len).collect();
        let all: usize = counts.iter().sum();
        let mut out = format!(
            "{}: {all} positions in all, of those every {}°; valuation numbers, and what noise ±{noise_um} µm makes (95 %)\n",
            setup.model.name, asked.step_deg
        );
        let _ = writeln!(out, "  {:8}  {:>16}  {:>16}", "", "evenly spread", "proposed");
        for &function in &asked.functions {
            let of = |own: &[Predicted]| own.iter().find(|own| own.function == function).cloned();
            let [even, own] = [&found.evenly, &found.proposed].map(|own| of(&own.prediction.functions));
            let valuation =
                |own: &Option<Predicted>| valued(own.as_ref().and_then(|own| own.valuation(setup, asked.sigma)));
            let unit = setup.quantity(function).deviation();
            let u95 = own
                .as_ref()
                .and_then(|own| own.largest)
                .map_or(String::new(), |largest| format!("± {:.3} {unit}", unit.from_inner(largest.u95)));
            let name = setup.function_name(function);
            let _ = writeln!(out, "  {name:8}  {:>16}  {:>16}  {u95}", valuation(&even), valuation(&own));
        }
        out += &rotary(setup, asked, found);
        out += "\nPositions, degrees\n";
        for (at, measurement) in found.measurements.iter().enumerate() {
            for (what, chosen) in [("proposed", &found.proposed), ("evenly spread", &found.evenly)] {
                let positions: Vec<String> = chosen.positions[at]
                    .iter()
                    .map(|sweep| (degrees(*sweep) * 1e2).round() / 1e2)
                    .map(|x| x.to_string())
                    .collect();
                let _ = writeln!(out, "  {}, {what}: {}", measurement.name, positions.join(", "));
            }
        }
        out
    }
}

fn valued(valuation: Option<Valuation>) -> String {
    valuation.map_or_else(|| "-".to_owned(), |own| own.to_string())
}

/// One number for each rotary axis, and which of its location errors have none.
fn rotary(setup: &Setup, asked: &Asked, found: &Proposed) -> String {
    let [evenly, proposed] = found.axes(setup, asked);
    if proposed.is_empty() {
        return String::new();
    }
    let mut out = "\nRotary axes: the largest valuation number of their linear, and of their angular location errors\n"
        .to_owned();
    let names = |of: &[FunctionId]| of.iter().map(|f| setup.function_name(*f)).collect::<Vec<_>>().join(", ");
    for (even, own) in evenly.iter().zip(&proposed) {
        let name = setup.model.axis(own.axis).map_or("", |axis| axis.name.as_str());
        for (even, own) in [(&even.linear, &own.linear), (&even.angular, &own.angular)] {
            let Some(LargestValuation { valuation, of, .. }) = own else { continue };
            let even = valued(even.as_ref().map(|even| even.valuation));
            let _ = writeln!(out, "  {name:8}  {even:>16}  {valuation:>16}  of {}", names(of));
        }
        if !own.not_determined.is_empty() {
            let _ = writeln!(out, "  {name:8}  not determined: {}", names(&own.not_determined));
        }
        if !own.without.is_empty() {
            let without: Vec<&str> = own.without.iter().map(|e| setup.model.alphabet.error_name(*e)).collect();
            let _ = writeln!(out, "  {name:8}  without {}", without.join(", "));
        }
    }
    out
}
