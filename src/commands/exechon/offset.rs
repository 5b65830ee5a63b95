//! `trunnion exechon offset`: a probe's offset from touches in a ring.

use super::spool::print;
use super::{Failed, Which};
use clap::Args;
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::path::PathBuf;
use trunnion::exechon::{ALONG, read_rows, rotation_at};
use trunnion_solver::probe::{Reversal, Touch, offset};

/// Arguments of `offset`.
#[derive(Debug, Args)]
pub struct Offset {
    /// Touches: CSV with the columns x_mm,y_mm,z_mm,spindle_deg, the spindle axis at each touch in machine coordinates.
    ///
    /// Four directions, and again with the spindle reversed; the spindle may or may not have followed the dependent
    /// rotation.
    file: PathBuf,
    /// The ring's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 40.001)]
    diameter: f64,
    /// The stylus ball's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 6.0)]
    stylus: f64,
    /// The probe's repeatability, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.25)]
    repeatability: f64,
    /// Accuracy of the ring's diameter, two sigma, µm.
    #[arg(long, value_name = "UM", default_value_t = 1.0)]
    accuracy: f64,
    #[command(flatten)]
    which: Which,
}

impl Offset {
    /// Computes and shows.
    pub fn run(self) -> Result<(), Failed> {
        let radius = (self.diameter - self.stylus) / 2.0;
        for (name, value) in [("stylus", radius), ("repeatability", self.repeatability)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Failed::Option(name, "expected a positive number, and a ball smaller than the ring"));
            }
        }
        let machine = self.which.read()?;
        let rows = read_rows(&self.file, ["x_mm", "y_mm", "z_mm", "spindle_deg"], [], 5)?;
        let refuse = |line: u64, what: String, remedy| {
            Failed::Points(self.file.clone(), format!("line {line}: {what}\n  {remedy}"))
        };
        let mut touches = Vec::new();
        for row in &rows {
            let [x, y, z, spindle] = row.values;
            let phi = rotation_at(&machine, [x, y, z], ALONG);
            let phi = phi.map_err(|e| refuse(row.line, e.to_string(), e.remedy()))?;
            touches.push(([x, y], spindle.to_radians(), phi));
        }
        let sigma = self.repeatability / 2e3;
        let fit = |turned: &dyn Fn(f64, f64) -> f64| {
            let taken = touches.iter().map(|&(position, s, phi)| Touch { position, turned: turned(s, phi) });
            offset(&taken.collect::<Vec<_>>(), sigma)
        };
        let failed = |e: trunnion_solver::probe::ProbeError| {
            Failed::Points(
                self.file.clone(),
                format!("{e}\n  expected touches in four directions, and four more with the spindle reversed"),
            )
        };
        let with = fit(&|s, phi| s - phi).map_err(failed)?;
        let without = fit(&|s, _| s).map_err(failed)?;
        let shown = |fit: &trunnion_solver::probe::OffsetFit<f64>| {
            json!({
                "offset_mm": fit.offset,
                "standard_uncertainty_mm": [fit.covariance[(0, 0)].sqrt(), fit.covariance[(1, 1)].sqrt()],
                "centre_mm": fit.centre,
                "effective_radius_mm": fit.radius,
                "residual_std_mm": fit.residual_std,
            })
        };
        let turned: Vec<_> = touches.iter().map(|&(position, s, phi)| (position, s - phi)).collect();
        let report = json!({
            "with_dependent_rotation": shown(&with),
            "spindle_angle_taken_as_it_is": shown(&without),
            "reversal": reversal(&turned, radius, sigma, self.accuracy / 4e3),
        });
        print(&format!("{report:#}\n"))
    }
}

/// (8) and (9) where the touches are the paper's: both ways along x and y, then +x and +y with the spindle reversed.
fn reversal(touches: &[([f64; 2], f64)], radius: f64, touch: f64, ring: f64) -> Value {
    let near = |angle: f64, to: f64| ((angle - to) / 2.0).sin().abs() < 0.02;
    let at = |to: f64| touches.iter().filter(move |(_, turned)| near(*turned, to)).map(|(position, _)| *position);
    let range = |k: usize, to: f64| {
        at(to).map(|p| p[k]).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    if at(0.0).count() != 4 || at(PI).count() < 2 {
        return Value::Null;
    }
    let middle = |(low, high): (f64, f64)| (low + high) / 2.0;
    let centre = [middle(range(0, 0.0)), middle(range(1, 0.0))];
    let farthest = |k: usize| at(PI).max_by(|a, b| a[k].total_cmp(&b[k]));
    let (Some(x), Some(y)) = (farthest(0), farthest(1)) else {
        return Value::Null;
    };
    let touches = Reversal { centre, x, y, radius };
    let (Ok(exact), Ok(covariance)) = (touches.exact(), touches.covariance(touch, ring)) else {
        return Value::Null;
    };
    json!({
        "exact_mm": exact,
        "small_angle_mm": touches.small_angle(),
        "standard_uncertainty_mm": [covariance[0][0].sqrt(), covariance[1][1].sqrt()],
    })
}
