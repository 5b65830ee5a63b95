//! `trunnion pivots`: where the rotary axes are, for a control's kinematics.

use super::measured::MeasuredArguments;
use super::output::{print, say};
use super::pair::pair;
use super::{Refused, number};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;
use trunnion::data::{Guard, write_table};
use trunnion::export::{Located, linuxcnc_pivots, located, pivot_words, sinumerik_pivots};
use trunnion::plot::MADE;

/// Arguments of `pivots`.
#[derive(Debug, Args)]
pub struct PivotArguments {
    #[command(flatten)]
    measured: MeasuredArguments,
    /// What takes them: docs/pivots.md says how.
    #[arg(long, value_enum)]
    format: Takes,
    /// linuxcnc: what a pin of the kinematics is now, mm; 0 of each that is not given.
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
}

impl PivotArguments {
    /// Reads, fits, writes, says what was found.
    pub fn run(self) -> Result<(), Refused> {
        if let Some(pin) = self.pins.first().filter(|_| self.format != Takes::Linuxcnc) {
            return Err(Refused::Option("pin", pin.clone(), "no effect on sinumerik\n  expected it left out"));
        }
        let pins = self.pins.iter().map(|given| pin(given)).collect::<Result<Vec<_>, _>>()?;
        let measured = self.measured.measured()?;
        let recorded = measured.open()?;
        let (fit, observations) = measured.fit(&recorded)?;
        let report = measured.report(&fit, &observations)?;
        let model = &measured.setup.model;
        let located = located(&measured.setup, &report.functions);
        if located.is_empty() {
            return Err(Refused::NothingDetermined(String::from("location errors")));
        }
        let mut notes =
            vec![format!("{MADE} trunnion {}, model {}: where its axes are", env!("CARGO_PKG_VERSION"), model.name)];
        notes.extend(located.iter().map(|own| format!("{} (95 %)", pivot_words(own))));
        let text = match self.format {
            Takes::Linuxcnc => linuxcnc_pivots(model, &located, &pins, &notes)?,
            Takes::Sinumerik => sinumerik_pivots(model, &located, &notes),
        };
        for warning in &report.warnings {
            say(format_args!("warning: {warning}"));
        }
        write_table(&self.out, &text, &Guard { inputs: measured.inputs().collect(), force: self.force })?;
        Ok(print(&if self.json { format!("{:#}\n", self.object(&located)) } else { self.text(&located) })?)
    }

    fn text(&self, located: &[Located]) -> String {
        let mut out = format!("{}\n", self.out.display());
        located.iter().for_each(|own| {
            let _ = writeln!(out, "  {} (95 %)", pivot_words(own));
        });
        out
    }

    fn object(&self, located: &[Located]) -> serde_json::Value {
        let one = |own: &Located| {
            let unit = own.quantity.deviation();
            let [value, u95] = [own.value, own.u95].map(|x| unit.from_inner(x));
            json!({ "name": own.iso, "unit": unit.suffix(), "value": value, "u95": u95 })
        };
        json!({ "file": self.out.display().to_string(), "location_errors": located.iter().map(one).collect::<Vec<_>>() })
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
