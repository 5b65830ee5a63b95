//! `trunnion export`: compensation tables for controls from estimated functions.

use super::exported::{Exported, OneExported};
use super::measured::{Measured, MeasuredArguments};
use super::output::{print, say};
use super::tabled::{Asked, Location, Tabled};
use super::{Refused, number, predicted};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trunnion::data::{Guard, write_table};
use trunnion::export::{Constant, Format, Kept, OneFormat, Table, Told, write, write_all};
use trunnion::plot::MADE;
use trunnion::study::Report;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    #[command(flatten)]
    measured: MeasuredArguments,
    /// The function: its name in reports, or its ISO 230-1 name. Without it the model's only one; of volcomp and etalon all that are
    /// determined.
    #[arg(long, value_name = "NAME")]
    function: Option<String>,
    /// What is written: docs/export.md says of each what the control makes of it.
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Named,
    /// What the control calls the axis, where it is not as the model does.
    #[arg(long, value_name = "NAME", value_parser = axis)]
    axis: Option<String>,
    /// cec: what the control calls the axis that takes the error off, where it is not as the model does.
    #[arg(long, value_name = "NAME", value_parser = axis)]
    output_axis: Option<String>,
    /// First and last coordinate of the table, degrees; without it where the axis was measured.
    #[arg(long, value_name = "FROM:TO", value_parser = predicted::range, allow_hyphen_values = true)]
    range_deg: Option<(f64, f64)>,
    /// The same of a linear axis, mm.
    #[arg(long, value_name = "FROM:TO", value_parser = range_mm, allow_hyphen_values = true)]
    range_mm: Option<(f64, f64)>,
    /// From one row to the next, degrees; 5 without it.
    #[arg(long, value_name = "DEG", value_parser = number::step, allow_negative_numbers = true)]
    step_deg: Option<f64>,
    /// The same of a linear axis, mm.
    #[arg(long, value_name = "MM", value_parser = number::length, allow_negative_numbers = true)]
    step_mm: Option<f64>,
    /// Where the axis powers up, its reference position, degrees or mm: what is not 0 there is told.
    #[arg(long, value_name = "AT", default_value_t = 0.0, value_parser = number::position, allow_negative_numbers = true)]
    home: f64,
    /// Takes the error at --home, the mean of both directions, off all: the axis' zero stays where it is.
    #[arg(long)]
    zero_at_home: bool,
    /// fanuc: the detection unit, degrees or mm; 0.001 without it.
    #[arg(long, value_name = "UNIT", value_parser = number::length, allow_negative_numbers = true)]
    detection_unit: Option<f64>,
    /// Refuses where the two directions are not told apart, instead of writing the same for both.
    #[arg(long)]
    both_directions: bool,
    /// The file.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Replaces the file even if it does not say that it is an earlier table.
    #[arg(long)]
    force: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// A format's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Named(Format);

impl ValueEnum for Named {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Named; Format::ALL.len()] = {
            let mut all = [Named(Format::ALL[0]); Format::ALL.len()];
            let mut at = 0;
            while at < all.len() {
                all[at] = Named(Format::ALL[at]);
                at += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.name()).help(self.0.facts().what))
    }
}

/// A word that a control's file can have as an axis' name.
fn axis(text: &str) -> Result<String, &'static str> {
    let plain = !text.is_empty() && text.len() <= 32 && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if plain { Ok(text.to_owned()) } else { Err("not an axis' name\n  expected letters, digits and _, such as AX4") }
}

/// `A:B` in mm.
fn range_mm(text: &str) -> Result<(f64, f64), &'static str> {
    let pair = text.split_once(':').and_then(|(a, b)| Some((number::position(a).ok()?, number::position(b).ok()?)));
    pair.filter(|(a, b)| a < b).ok_or("not a range\n  expected for example -200:600, in mm")
}

impl ExportArguments {
    /// Reads, fits, writes, says what was written.
    pub fn run(self) -> Result<(), Refused> {
        let Named(format) = self.format;
        self.effective(format)?;
        let measured = self.measured.measured()?;
        let asked = self.asked(format);
        let functions = asked.functions(&measured.setup)?;
        let recorded = measured.open()?;
        let (fit, observations) = measured.fit(&recorded)?;
        let report = measured.report(&fit, &observations)?;
        let (tables, left_out) = asked.tables(&measured, &recorded, (&fit, &observations), &functions)?;
        let constants = match format {
            Format::One(_) => Vec::new(),
            Format::All(_) => asked.constants(&measured.setup, &fit, &report),
        };
        let plain: Vec<Constant> = constants.iter().map(Location::constant).collect();
        let mut told = Told {
            home: self.home,
            detection_unit: self.detection_unit.unwrap_or(Told::default().detection_unit),
            output: self.output_axis.clone(),
            notes: Vec::new(),
        };
        let (_, kept) = written(format, &tables, &plain, &told)?;
        let facts = format.facts();
        let one = |(own, kept)| OneExported::new(&measured.setup, (&fit, &report), own, kept, format, self.home);
        let exported = Exported {
            file: self.out.display().to_string(),
            format,
            facts,
            tables: tables.iter().zip(kept).map(one).collect(),
            constants,
            left_out,
            assumptions: measured.setup.model.assumptions.iter().map(|a| a.text.clone()).collect(),
        };
        // What is known of a table only once it is written stands in its file, too.
        told.notes = notes(&measured, &exported);
        let (text, _) = written(format, &tables, &plain, &told)?;
        self.warn(&report, &exported);
        let guard = Guard { inputs: measured.inputs().collect(), force: self.force };
        write_table(&self.out, &text, &guard)?;
        Ok(print(&if self.json { format!("{:#}\n", exported.object()) } else { exported.text() })?)
    }

    fn warn(&self, report: &Report, exported: &Exported) {
        let of_the_fit = report.warnings.iter().map(ToString::to_string);
        let of_tables = exported.tables.iter().flat_map(|own| own.warnings.iter().map(ToString::to_string));
        for warning in of_the_fit.chain(of_tables) {
            say(format_args!("warning: {warning}"));
        }
    }

    fn asked(&self, format: Format) -> Asked<'_> {
        Asked {
            function: self.function.as_deref(),
            all: matches!(format, Format::All(_)),
            axis: self.axis.as_deref(),
            range_deg: self.range_deg,
            range_mm: self.range_mm,
            step_deg: self.step_deg,
            step_mm: self.step_mm,
            zero: self.zero_at_home.then_some(self.home),
            both: format.facts().both,
            modulo: format.facts().ends.repeats(),
            demanded: self.both_directions,
        }
    }

    /// Refuses an option that the format has no use for.
    fn effective(&self, format: Format) -> Result<(), Refused> {
        let idle = [
            (
                "axis",
                self.axis.is_some() && matches!(format, Format::All(_)),
                "their errors have the axis in their ISO names",
            ),
            ("output-axis", self.output_axis.is_some() && format != Format::One(OneFormat::Cec), "it is for cec"),
            (
                "detection-unit",
                self.detection_unit.is_some() && format != Format::One(OneFormat::Fanuc),
                "it is for fanuc",
            ),
        ];
        match idle.into_iter().find(|(_, idle, _)| *idle) {
            Some((option, _, why)) => Err(Refused::Idle(option, format.name(), why)),
            None => Ok(()),
        }
    }
}

/// A file, and what of each table is kept.
fn written(
    format: Format,
    tables: &[Tabled],
    constants: &[Constant],
    told: &Told,
) -> Result<(String, Vec<Kept>), Refused> {
    match (format, tables) {
        (Format::All(all), _) => {
            let plain: Vec<Table> = tables.iter().map(|own| own.table.clone()).collect();
            Ok(write_all(&plain, constants, all, &told.notes))
        }
        (Format::One(one), [own, ..]) => {
            let named = || own.table.subject.name.clone();
            let written = write(&own.table, one, told).map_err(|why| Refused::NoPlace(format.name(), named(), why))?;
            Ok((written.text, vec![written.kept]))
        }
        (Format::One(_), []) => Err(Refused::NothingDetermined(String::new())),
    }
}

/// The comments of a file: what it is, then what is told of it.
fn notes(measured: &Measured, exported: &Exported) -> Vec<String> {
    let (model, version) = (&measured.setup.model.name, env!("CARGO_PKG_VERSION"));
    let first = format!("{MADE} trunnion {version}, model {model}: {}", exported.facts.what);
    let told = exported.lines().into_iter().map(|(what, words)| format!("{what}: {words}"));
    std::iter::once(first).chain(told).collect()
}
