//! `trunnion exechon offset`: a probe's offset from touches in a ring.

use super::ExechonRefused;
use super::arguments::Which;
use crate::commands::number;
use crate::commands::output::print;
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use trunnion::exechon::{Gauge, OffsetReport, ReversalReport, offset_report};
use trunnion_solver::probe::OffsetFit;

/// Arguments of `offset`.
#[derive(Debug, Args)]
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
        let OffsetReport { with_rotation, spindle_alone, reversal } = offset_report(&machine, &self.file, &gauge)?;
        let fit = |fit: &OffsetFit<f64>| {
            json!({
                "offset_mm": fit.offset,
                "standard_uncertainty_mm": [fit.covariance[(0, 0)].sqrt(), fit.covariance[(1, 1)].sqrt()],
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
            })
        };
        let report = json!({
            "with_dependent_rotation": fit(&with_rotation),
            "spindle_angle_taken_as_it_is": fit(&spindle_alone),
            "reversal": reversal.map(formulas),
        });
        Ok(print(&format!("{report:#}\n"))?)
    }
}
