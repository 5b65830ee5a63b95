//! `trunnion exechon offset`: a probe's offset from touches in a ring.

use super::ExechonRefused;
use super::arguments::{Which, read_files};
use crate::commands::number;
use crate::commands::output::{print, say};
use crate::commands::reported::ReportArguments;
use clap::{ArgGroup, Args};
use serde_json::json;
use std::path::PathBuf;
use trunnion::data::Unit;
use trunnion::document;
use trunnion::exechon::{Gauge, Met, OffsetReport, ReversalReport, offset_report};
use trunnion::report as page;
use trunnion::study::{COVERAGE, coverage_factor};
use trunnion_solver::probe::OffsetFit;

/// Arguments of `offset`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("written").args(["report"]))]
pub struct OffsetArguments {
    /// Touches: CSV with the columns x_mm,y_mm,z_mm,spindle_deg, the spindle axis at each touch in machine coordinates.
    ///
    /// Four directions, and again with the spindle reversed; the spindle may or may not have followed the dependent
    /// rotation.
    file: PathBuf,
    /// The ring's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 40.001, value_parser = number::length, allow_negative_numbers = true)]
    diameter: f64,
    /// The stylus ball's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 6.0, value_parser = number::size, allow_negative_numbers = true)]
    stylus: f64,
    /// The probe's repeatability, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.25, value_parser = number::spread, allow_negative_numbers = true)]
    repeatability: f64,
    /// Accuracy of the ring's diameter, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 1.0, value_parser = number::noise, allow_negative_numbers = true)]
    accuracy: f64,
    /// One JSON document, which is what is printed without it too.
    #[arg(long = "json")]
    _json: bool,
    #[command(flatten)]
    report: ReportArguments,
    #[command(flatten)]
    which: Which,
}

impl OffsetArguments {
    /// Computes and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        let gauge = Gauge::new(self.diameter, self.stylus, self.repeatability, self.accuracy);
        if gauge.radius <= 0.0 {
            return Err(ExechonRefused::Option(
                "stylus",
                "as large as the ring\n  expected a ball smaller than --diameter",
            ));
        }
        let machine = self.which.read()?;
        let (found, stamp) = offset_report(&machine, &self.file, &gauge)?;
        let OffsetReport { with_rotation, spindle_alone, reversal, touches } = &found;
        let factor = coverage_factor(None);
        let fit = |fit: &OffsetFit<f64>| {
            let std = [fit.covariance[(0, 0)].sqrt(), fit.covariance[(1, 1)].sqrt()];
            json!({
                "offset_mm": fit.offset,
                "standard_uncertainty_mm": std,
                "expanded_uncertainty_mm": std.map(|std| factor * std),
                "centre_mm": fit.centre,
                "effective_radius_mm": fit.radius,
                "residual_std_mm": fit.residual_std,
            })
        };
        let formulas = |reversal: ReversalReport| {
            json!({
                "exact_mm": reversal.exact,
                "small_angle_mm": reversal.small_angle,
                "standard_uncertainty_mm": reversal.uncertainty,
                "expanded_uncertainty_mm": reversal.uncertainty.map(|std| factor * std),
                "correlation": reversal.correlation,
            })
        };
        let um = |mm: f64| Unit::Um.from_inner(mm);
        let warnings: Vec<String> = found.scattered(&gauge).iter().map(ToString::to_string).collect();
        for warning in &warnings {
            say(format_args!("warning: {warning}"));
        }
        let touch = |met: &Met| {
            json!({
                "turned_deg": met.turned.to_degrees(),
                "angle_deg": met.angle.to_degrees(),
                "deviation_um": um(met.deviation[0]),
                "spindle_alone_um": um(met.deviation[1]),
            })
        };
        let report = json!({
            "with_dependent_rotation": fit(with_rotation),
            "spindle_angle_taken_as_it_is": fit(spindle_alone),
            "reversal": reversal.map(formulas),
            "warnings": warnings,
            "stated": {
                "diameter_mm": self.diameter,
                "accuracy_um": self.accuracy,
                "stylus_mm": self.stylus,
                "repeatability_um": self.repeatability,
            },
            "touches": touches.iter().map(touch).collect::<Vec<_>>(),
            "coverage": COVERAGE,
            "coverage_factor": factor,
            "budgets": document::probed(&found.budgets(&gauge), found.tried(&gauge).as_ref()),
            "made": self.report.made(&read_files(&self.which, &self.file, stamp)),
        });
        let html = self.report.is_wanted().then(|| page::offset(&report, &found)).transpose()?;
        self.report.write(&self.report.guard(self.which.inputs().chain([self.file.as_path()])), html)?;
        Ok(print(&format!("{report:#}\n"))?)
    }
}
