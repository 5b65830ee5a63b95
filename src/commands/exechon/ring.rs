//! `trunnion exechon ring`: what a probed ring shows.

use super::ExechonRefused;
use super::arguments::{Which, read_files};
use crate::commands::number;
use crate::commands::output::{Picture, print};
use crate::commands::reported::ReportArguments;
use clap::{ArgGroup, Args};
use serde_json::{Value, json};
use std::path::PathBuf;
use trunnion::data::{Stamp, Unit};
use trunnion::document;
use trunnion::exechon::{ProbeKnown, RingReport, ring_picture, ring_report_of};
use trunnion::report as page;
use trunnion::study::{COVERAGE, Combined};

/// Arguments of `ring`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("written").args(["svg", "report"]).multiple(true))]
pub struct RingArguments {
    /// Touches: CSV with the columns x_mm,y_mm,z_mm and perhaps spindle_deg, the spindle axis in machine coordinates.
    file: PathBuf,
    /// The probe's offset, mm: each touch is moved to the ball's centre, by its spindle angle (0 without the column) and
    /// the dependent rotation there.
    #[arg(long, value_name = "OX,OY", value_parser = number::positions::<2>, allow_hyphen_values = true)]
    offset: Option<[f64; 2]>,
    /// The stylus ball's diameter, mm, added to the circle's: the ring is touched from inside.
    #[arg(long, value_name = "MM", default_value_t = 6.0, value_parser = number::size, allow_negative_numbers = true)]
    stylus: f64,
    /// Accuracy of each coordinate of the probe's offset, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.0, value_parser = number::noise, allow_negative_numbers = true, requires = "offset")]
    offset_accuracy: f64,
    /// Accuracy of the stylus ball's diameter, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.0, value_parser = number::noise, allow_negative_numbers = true)]
    stylus_accuracy: f64,
    /// Touches nearer than half of this are repeats of one place, degrees.
    #[arg(long, alias = "step", value_name = "DEG", default_value_t = 10.0, value_parser = number::step, allow_negative_numbers = true)]
    step_deg: f64,
    /// One JSON document instead of text.
    #[arg(long)]
    json: bool,
    /// Draws it (SVG) into this file, in place of an earlier picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArguments,
    #[command(flatten)]
    which: Which,
}

impl RingArguments {
    /// Fits and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        if self.offset.is_none() && self.which.inputs().next().is_some() {
            return Err(ExechonRefused::Option(
                "machine",
                "of no use here\n  expected it with --offset, or not at all",
            ));
        }
        let machine = self.which.read()?;
        let (report, stamp) = ring_report_of(&machine, &self.file, self.offset, self.step_deg.to_radians())?;
        // Its trials take a while, and the text has none of them.
        let document = (self.json || self.report.is_wanted()).then(|| self.document(&report, stamp));
        let wanted = document.as_ref().filter(|_| self.report.is_wanted());
        let html = wanted.map(|document| page::ring(document, &report)).transpose()?;
        let inputs = || self.which.inputs().chain([self.file.as_path()]);
        let picture = Picture::new(self.svg.clone(), self.report.force);
        picture.draw(inputs(), || Ok::<_, ExechonRefused>(ring_picture(&[("", &report)], "Circular deviation")?))?;
        self.report.write(&self.report.guard(inputs()), html)?;
        let shown = document.filter(|_| self.json).map_or_else(|| self.text(&report), |own| format!("{own:#}\n"));
        Ok(print(&shown)?)
    }

    fn document(&self, report: &RingReport, stamp: Stamp) -> Value {
        let (fit, zone, [inner, outer]) = (&report.fit, &report.zone, report.zone_diameters(self.stylus));
        let places = report.spread.iter().map(|(angle, n, mean, std)| {
            json!({ "angle_deg": angle.to_degrees(), "touches": n, "mean_mm": mean, "std_mm": std })
        });
        let known = ProbeKnown {
            offset: Unit::Um.to_inner(self.offset_accuracy),
            stylus: Unit::Um.to_inner(self.stylus_accuracy),
        };
        let budgets = report.budgets(&known);
        let tried = report.tried(&known);
        let uncertainty = |of: fn(&Combined) -> f64| {
            budgets.as_ref().map(|[x, y, diameter]| {
                json!({ "centre": [of(&x.combined), of(&y.combined)], "diameter": of(&diameter.combined) })
            })
        };
        let deviations = report.deviations.iter();
        let deviations = deviations.map(|(at, mm)| json!({ "angle_deg": at.to_degrees(), "deviation_mm": mm }));
        json!({
            "stated": { "stylus_mm": self.stylus, "offset_mm": self.offset, "repeats_within_deg": self.step_deg / 2.0, "offset_accuracy_um": self.offset_accuracy, "stylus_accuracy_um": self.stylus_accuracy },
            "touches": report.deviations.len(),
            "least_squares": {
                "centre_mm": fit.circle.centre,
                "path_diameter_mm": 2.0 * fit.circle.radius,
                "diameter_mm": report.diameter(self.stylus),
                "roundness_mm": fit.roundness(),
                "residual_std_mm": fit.scatter.map(|scatter| scatter.residual_std),
                "standard_uncertainty_mm": uncertainty(|own| own.std),
                "expanded_uncertainty_mm": uncertainty(|own| own.expanded),
                "degrees_of_freedom": report.degrees_of_freedom(),
            },
            "coverage": COVERAGE,
            "budgets": budgets.as_ref().map(|budgets| document::probed(budgets, tried.as_ref())),
            "rms_um": Unit::Um.from_inner(report.rms()),
            "histogram": report.histogram().as_ref().map(document::counted),
            "deviations": deviations.collect::<Vec<_>>(),
            "minimum_zone": {
                "centre_mm": zone.centre,
                "inner_diameter_mm": inner,
                "outer_diameter_mm": outer,
                "roundness_mm": zone.width(),
            },
            "places": places.collect::<Vec<_>>(),
            "largest_std_mm": report.largest_std(),
            "made": self.report.made(&read_files(&self.which, &self.file, stamp)),
        })
    }

    fn text(&self, report: &RingReport) -> String {
        let (fit, zone) = (&report.fit, &report.zone);
        let [x, y] = fit.circle.centre;
        let repeats = match report.largest_std() {
            Some(std) => format!("largest standard deviation over repeats {:.2} µm\n", Unit::Um.from_inner(std)),
            None => String::new(),
        };
        format!(
            "{} touches\nleast squares: centre ({x:.4}, {y:.4}) mm, diameter {:.4} mm, roundness {:.2} µm\n\
             minimum zone:  centre ({:.4}, {:.4}) mm, roundness {:.2} µm\n{repeats}",
            report.deviations.len(),
            report.diameter(self.stylus),
            Unit::Um.from_inner(fit.roundness()),
            zone.centre[0],
            zone.centre[1],
            Unit::Um.from_inner(zone.width()),
        )
    }
}
