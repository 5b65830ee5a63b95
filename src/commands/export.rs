//! `trunnion export`: a compensation table for a control from an estimated function.

use super::exported::Exported;
use super::measured::{Measured, MeasuredArguments};
use super::output::{print, say};
use super::{Refused, number, predicted};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trunnion::data::{Guard, Recorded, Unit, write_table};
use trunnion::export::{self, Facts, Format, Grid, Subject, Table};
use trunnion::study::{ByDirection, Covered, Failing, Fit, Observation, Setup, by_direction, coverage_factor};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::FunctionId;

/// Steps of a table without `--step-deg`, degrees.
const STEP_DEG: f64 = 5.0;
/// Steps of a linear axis without `--step-mm`, at least.
const STEPS: f64 = 20.0;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    #[command(flatten)]
    measured: MeasuredArguments,
    /// The function: its name in reports, or its ISO 230-1 name. Without it the model's only one.
    #[arg(long, value_name = "NAME")]
    function: Option<String>,
    /// What is written: docs/export.md says of each what the control makes of it.
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Named,
    /// What the control calls the axis, where it is not as the model does.
    #[arg(long, value_name = "NAME", value_parser = axis)]
    axis: Option<String>,
    /// First and last coordinate of the table, degrees; without it where the axis was measured.
    #[arg(long, value_name = "FROM:TO", value_parser = predicted::range, allow_hyphen_values = true, conflicts_with = "range_mm")]
    range_deg: Option<(f64, f64)>,
    /// The same of a linear axis, mm.
    #[arg(long, value_name = "FROM:TO", value_parser = range_mm, allow_hyphen_values = true)]
    range_mm: Option<(f64, f64)>,
    /// From one row to the next, degrees; 5 without it.
    #[arg(long, value_name = "DEG", value_parser = number::step, allow_negative_numbers = true, conflicts_with = "step_mm")]
    step_deg: Option<f64>,
    /// The same of a linear axis, mm.
    #[arg(long, value_name = "MM", value_parser = number::length, allow_negative_numbers = true)]
    step_mm: Option<f64>,
    /// Where the axis powers up, degrees or mm: what is not 0 there is told.
    #[arg(long, value_name = "AT", default_value_t = 0.0, value_parser = number::position, allow_negative_numbers = true)]
    home: f64,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Named {
    /// LinuxCNC: COMP_FILE of type 0.
    #[value(name = "linuxcnc")]
    LinuxCnc,
}

impl From<Named> for Format {
    fn from(named: Named) -> Self {
        match named {
            Named::LinuxCnc => Self::LinuxCnc,
        }
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

/// The directions of a function: what tells them apart, or why nothing does.
type Directions = Result<ByDirection, String>;

impl ExportArguments {
    /// Reads, fits, writes, says what was written.
    pub fn run(self) -> Result<(), Refused> {
        let measured = self.measured.measured()?;
        let function = self.function(&measured.setup)?;
        let subject = Subject::new(&measured.setup, function, self.axis.as_deref())?;
        self.effective(&subject)?;
        let recorded = measured.open()?;
        let (fit, observations) = measured.fit(&recorded)?;
        let setup = &measured.setup;
        determined(setup, &fit, function)?;
        let grid = self.grid(setup, function, &observations, &subject)?;
        let format = Format::from(self.format);
        let facts = format.facts();
        let directions = self.directions(&measured, &recorded, &fit, function, &facts)?;
        let along = subject.along;
        let error = |at: f64| {
            let x = along.to_inner(at);
            match &directions {
                Ok(own) => own.at(setup, &fit, x),
                Err(_) => [fit.function(setup, function, x).0; 2],
            }
        };
        let table = Table::new(subject, grid, directions.is_ok(), error);
        let no_place =
            || Refused::NoPlace(format.name(), table.subject.name.clone(), "a positioning error, such as EAA");
        let written = export::write(&table, format).ok_or_else(no_place)?;
        let report = measured.report(&fit, &observations)?;
        let deviation = table.subject.quantity.deviation();
        let range =
            setup.axis(function).and_then(|axis| axis.range).map(|range| range.map(|end| along.from_inner(end)));
        let u95 = report.functions.iter().filter(|c| c.function == function).flat_map(|c| &c.points).map(|p| p.u95);
        let told = Exported {
            file: self.out.display().to_string(),
            format,
            facts,
            table: &table,
            written: &written,
            u95: u95.fold(0.0, f64::max),
            hysteresis: directions.as_ref().map(|own| hysteresis(setup, &fit, own, &table)).map_err(Clone::clone),
            left: deviation.from_inner(written.left(&table, facts.between, error)),
            assumptions: setup.model.assumptions.iter().map(|a| a.text.clone()).collect(),
            warnings: export::warnings(&table, &facts, &written, self.home, range),
        };
        let of_the_fit = report.warnings.iter().map(ToString::to_string);
        for warning in of_the_fit.chain(told.warnings.iter().map(ToString::to_string)) {
            say(format_args!("warning: {warning}"));
        }
        let guard = Guard { inputs: measured.inputs().collect(), force: self.force };
        write_table(&self.out, &written.text, &guard)?;
        Ok(print(&if self.json { format!("{:#}\n", told.object()) } else { told.text() })?)
    }

    /// The function that is asked for.
    fn function(&self, setup: &Setup) -> Result<FunctionId, Refused> {
        let all: Vec<FunctionId> = setup.estimated().collect();
        let names = || all.iter().map(|f| setup.function_name(*f)).collect::<Vec<_>>().join(", ");
        let Some(wanted) = &self.function else {
            return match all.as_slice() {
                [only] => Ok(*only),
                _ => Err(Refused::NotEstimated("which".to_owned(), names())),
            };
        };
        let is = |function: &&FunctionId| {
            let error = setup.model.functions[**function].error;
            let iso = Subject::new(setup, **function, None).map(|subject| subject.iso);
            setup.function_name(**function) == *wanted
                || setup.model.alphabet.error_name(error) == wanted
                || iso.is_ok_and(|iso| iso == *wanted)
        };
        all.iter().find(is).copied().ok_or_else(|| Refused::NotEstimated(wanted.clone(), names()))
    }

    /// Refuses options of the other kind of axis.
    fn effective(&self, subject: &Subject) -> Result<(), Refused> {
        let given = match subject.along {
            Unit::Deg => [("range-mm", self.range_mm.is_some()), ("step-mm", self.step_mm.is_some())],
            _ => [("range-deg", self.range_deg.is_some()), ("step-deg", self.step_deg.is_some())],
        };
        let expected = match subject.along {
            Unit::Deg => "the axis turns\n  expected --range-deg and --step-deg",
            _ => "the axis is a linear one\n  expected --range-mm and --step-mm",
        };
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Refused::Option(option, "without effect".to_owned(), expected)),
            None => Ok(()),
        }
    }

    /// The table's coordinates: those asked for, as far as they were measured.
    fn grid(
        &self,
        setup: &Setup,
        function: FunctionId,
        observations: &[Observation],
        subject: &Subject,
    ) -> Result<Grid, Refused> {
        let unit = subject.along;
        let covered = Covered::of(setup, function, observations)
            .ok_or_else(|| Refused::NotMeasured("range-deg", 0.0, 0.0, "nothing".to_owned()))?;
        let (low, high) = (unit.from_inner(covered.low), unit.from_inner(covered.high));
        let step = self.step_deg.or(self.step_mm).unwrap_or_else(|| match unit {
            Unit::Deg => STEP_DEG,
            _ => round_down((high - low) / STEPS),
        });
        if let Some((from, to)) = self.range_deg.or(self.range_mm) {
            if !covered.has((unit.to_inner(from), unit.to_inner(to))) {
                let option = if unit == Unit::Deg { "range-deg" } else { "range-mm" };
                return Err(Refused::NotMeasured(option, from, to, format!("{low:.3} to {high:.3} {unit}")));
            }
            return Ok(Grid::new(from, to, step)?);
        }
        let within = if covered.whole_turn {
            Grid::within((low, low + 360.0 + step), step)
        } else {
            Grid::within((low, high), step)
        };
        let grid = match within {
            Some(grid) if covered.whole_turn => Grid::new(grid.from(), grid.from() + 360.0, step)?,
            Some(grid) => grid,
            None => {
                return Err(Refused::NotMeasured(
                    if unit == Unit::Deg { "step-deg" } else { "step-mm" },
                    step,
                    step,
                    format!("{low:.3} to {high:.3} {unit}"),
                ));
            }
        };
        Ok(grid)
    }

    /// Tells the directions apart, where both were measured and the format has a place for them.
    fn directions(
        &self,
        measured: &Measured,
        recorded: &[Recorded],
        fit: &Fit,
        function: FunctionId,
        facts: &Facts,
    ) -> Result<Directions, Refused> {
        let told = match facts.both {
            false => Err("the format has one table for both".to_owned()),
            true => match by_direction(&measured.setup, recorded, fit, function) {
                Ok(own) => Ok(own),
                Err(Failing::Not(why)) => Err(why.to_string()),
                Err(Failing::Recording(error)) => return Err(Measured::unreadable(error)),
            },
        };
        match told {
            Err(why) if self.both_directions => Err(Refused::NotBoth(
                why,
                "every run in which the axis moves measured there and back, balls and bar untouched",
            )),
            told => Ok(told),
        }
    }
}

/// The largest difference of the two directions at the table's rows, with its coverage.
fn hysteresis(setup: &Setup, fit: &Fit, own: &ByDirection, table: &Table) -> [f64; 3] {
    let unit = table.subject.quantity.deviation();
    let at = |at: f64| {
        let [by, std] = own.hysteresis(setup, fit, table.subject.along.to_inner(at));
        [at, unit.from_inner(by), unit.from_inner(coverage_factor(Some(own.degrees_of_freedom)) * std)]
    };
    table.grid.points().map(at).max_by(|a, b| a[1].abs().total_cmp(&b[1].abs())).unwrap_or_default()
}

/// A function's value has to be its own.
fn determined(setup: &Setup, fit: &Fit, function: FunctionId) -> Result<(), Refused> {
    let told = fit.seen(function).map(|seen| seen.told(setup)).filter(|told| told.extent != Extent::Determined);
    let Some(told) = told else { return Ok(()) };
    let example = told.up_to.first().map_or(String::new(), |first| format!(", such as {} = \"0\"", first.parameter));
    Err(Refused::NotDetermined { name: setup.function_name(function), words: told.words, example })
}

/// The largest of 1, 2, 5, 10, … that is no larger.
fn round_down(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|step| *step <= x).unwrap_or(power)
}
