//! `trunnion fit`: errors and their uncertainty from measurement files.

use super::Refused;
use super::measured::MeasuredArguments;
use super::output::{print, say};
use super::reported::ReportArguments;
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use trunnion::data::curve_files;
use trunnion::document;
use trunnion::report::{self as page, ReportError};
use trunnion::study::StudyError;

/// Arguments of `fit`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("written").args(["report", "csv", "pictures"]).multiple(true))]
pub struct FitArguments {
    #[command(flatten)]
    measured: MeasuredArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Writes each estimated function into this directory: a CSV file with its uncertainty.
    #[arg(long, value_name = "DIR")]
    csv: Option<PathBuf>,
    /// Draws the readings and residuals of each run and each estimated function (SVG) into this directory.
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArguments,
}

impl FitArguments {
    /// Reads, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        let measured = self.measured.measured()?;
        let recorded = measured.open()?;
        let (fitted, observations) = measured.fit(&recorded)?;
        let report = measured.report(&fitted, &observations)?;
        for warning in &report.warnings {
            say(format_args!("warning: {warning}"));
        }
        let guard = self.report.guard(measured.inputs());
        let mut out = if self.json { String::new() } else { report.to_string() };
        let mut html = None;
        if self.json || self.report.is_wanted() {
            let mut document = document::report(&measured.setup, &report);
            document["instrument"]["name"] = measured.instrument().into();
            if let Some(machine) = measured.machine() {
                document::at_hand(&mut document, machine);
            }
            document["made"] = self.report.made(&measured.files_read(&recorded));
            html = self.report.is_wanted().then(|| page::fit(&document, &measured.setup, &report)).transpose()?;
            if self.json {
                out = format!("{document:#}\n");
            }
        }
        let curves = self.csv.as_deref().map(|at| Ok::<_, Refused>((at, curve_files(&report, at)?))).transpose()?;
        if curves.as_ref().is_some_and(|(_, files)| files.is_empty()) {
            return Err(StudyError::NothingEstimated.into());
        }
        let pictures = self.pictures.as_deref();
        let drawn = |at| Ok::<_, Refused>((at, page::picture_files(&report).map_err(ReportError::from)?));
        let sets: Vec<_> = curves.into_iter().chain(pictures.map(drawn).transpose()?).collect();
        // All of them or none.
        sets.iter().try_for_each(|(at, files)| files.admit(at, &guard))?;
        self.report.admit(&guard)?;
        sets.iter().try_for_each(|(at, files)| files.write(at, &guard))?;
        self.report.write(&guard, html)?;
        Ok(print(&out)?)
    }
}
