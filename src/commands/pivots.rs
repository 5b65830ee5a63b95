//! `trunnion pivots`: where the rotary axes are, for a control's kinematics.

use super::measured::MeasuredArguments;
use super::output::{print, say};
use super::pair::pair;
use super::tabled::estimates_locations;
use super::{Refused, number};
use clap::{Args, ValueEnum};
use std::fmt::Write;
use std::path::PathBuf;
use trunnion::data::{Guard, write_table};
use trunnion::document;
use trunnion::export::{Chained, Located, Pins, chain, chain_text, named, pins};
use trunnion::plot::MADE;

/// Arguments of `pivots`.
#[derive(Debug, Args)]
pub struct PivotArguments {
    #[command(flatten)]
    measured: MeasuredArguments,
    /// What takes them: docs/pivots.md says how.
    #[arg(long, value_enum)]
    format: Takes,
    /// linuxcnc: what a pin of the kinematics is now, mm; of each that is not given, what is to be added to it is a comment.
    #[arg(long = "pin", value_name = "NAME=MM", allow_hyphen_values = true)]
    pins: Vec<String>,
    /// The file.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Replaces the file even if it does not say that it is an earlier one.
    #[arg(long)]
    force: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// What takes pivots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Takes {
    /// HAL commands for the pins of xyzac-trt-kins or xyzbc-trt-kins.
    Linuxcnc,
    /// Offsets and directions for a kinematic chain, to be entered by a person. Not verified.
    Sinumerik,
    /// A table (CSV) of the location errors under the names of ISO 230-1, with their uncertainty.
    Csv,
}

impl PivotArguments {
    /// Reads, fits, writes, says what was found.
    pub fn run(self) -> Result<(), Refused> {
        if let Some(pin) = self.pins.first().filter(|_| self.format != Takes::Linuxcnc) {
            return Err(Refused::Option(
                "pin",
                pin.clone(),
                "no effect on this format\n  expected it with linuxcnc alone",
            ));
        }
        let pinned = self.pins.iter().map(|given| pin(given)).collect::<Result<Vec<_>, _>>()?;
        let measured = self.measured.measured()?;
        let recorded = measured.open()?;
        let (fit, observations) = measured.fit(&recorded)?;
        let report = measured.report(&fit, &observations)?;
        let model = &measured.setup.model;
        let sources = measured.sources(&fit, &observations);
        let located = Located::new(&measured.setup, &fit, &sources);
        if located.is_empty() {
            return Err(if estimates_locations(&measured.setup) {
                Refused::NothingDetermined(String::from("location errors"))
            } else {
                Refused::NoLocations(model.name.clone())
            });
        }
        let taken = match self.format {
            Takes::Linuxcnc => Taken::Linuxcnc(pins(model, &located, &pinned)?),
            Takes::Sinumerik => Taken::Sinumerik(chain(model, &located)),
            Takes::Csv => Taken::Csv,
        };
        let mut notes =
            vec![format!("{MADE} trunnion {}, model {}: where its axes are", env!("CARGO_PKG_VERSION"), model.name)];
        notes.extend(located.each().map(|(name, own)| format!("{name} = {} (95 %)", own.words())));
        let text = match &taken {
            Taken::Linuxcnc(pins) => pins.text(&notes),
            Taken::Sinumerik(chain) => chain_text(chain, &notes),
            // The rows say what the notes behind the first would.
            Taken::Csv => named(&located, &notes[..1]),
        };
        for warning in &report.warnings {
            say(format_args!("warning: {warning}"));
        }
        write_table(&self.out, &text, &Guard { inputs: measured.inputs().collect(), force: self.force })?;
        Ok(print(&match self.json {
            true => format!(
                "{:#}\n",
                document::pivots(&self.out.display().to_string(), &located, taken.pins(), taken.chain())
            ),
            false => self.text(&located, &taken),
        })?)
    }

    fn text(&self, located: &Located, taken: &Taken) -> String {
        let mut out = format!("{}\n", self.out.display());
        for (name, own) in located.each() {
            let _ = writeln!(out, "  {name} = {} (95 %)", own.words());
        }
        for pin in taken.pins().iter().flat_map(|own| &own.pins) {
            let value = pin.value().map_or_else(|| String::from("to be added"), |value| format!("{value:.6}"));
            let _ = writeln!(out, "  {} {value}: {} (95 %)", pin.name, pin.words());
        }
        for own in taken.chain() {
            let unknown = own.unknown();
            if !unknown.is_empty() {
                let _ = writeln!(out, "  axis {}: {} not determined", own.axis, unknown.join(", "));
            }
        }
        out
    }
}

/// What a control takes.
enum Taken {
    Linuxcnc(Pins),
    Sinumerik(Vec<Chained>),
    Csv,
}

impl Taken {
    fn pins(&self) -> Option<&Pins> {
        if let Self::Linuxcnc(pins) = self { Some(pins) } else { None }
    }

    fn chain(&self) -> &[Chained] {
        if let Self::Sinumerik(chain) = self { chain } else { &[] }
    }
}

/// `x-rot-point=20.5`
fn pin(given: &str) -> Result<(String, f64), Refused> {
    let parsed = pair(given).and_then(|(name, mm)| Some((name.to_owned(), number::position(mm).ok()?)));
    parsed.ok_or_else(|| Refused::NotAPair {
        option: "pin",
        pair: "NAME=MM",
        given: given.to_owned(),
        range: "",
        example: "x-rot-point=20.5",
    })
}
