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
        if let Some(directory) = &self.csv {
            let files = curve_files(&report, directory)?;
            if files.is_empty() {
                return Err(StudyError::NothingEstimated.into());
            }
            files.write(directory, &guard)?;
        }
        if let Some(directory) = &self.pictures {
            page::picture_files(&report).map_err(ReportError::from)?.write(directory, &guard)?;
        }
        self.report.write(&guard, html)?;
        Ok(print(&out)?)
    }
}
