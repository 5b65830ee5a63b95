//! A probe's offset from touches in a ring, with and without the dependent rotation.

use super::budget::{ProbedBudget, ProbedPart, Tried, normal};
use super::input::{InputError, TouchLine, touches};
use super::{ALONG, rotation_at};
use crate::data::Stamp;
use chacha20::ChaCha8Rng;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::f64::consts::PI;
use std::path::Path;
use thiserror::Error;
use trunnion_codegen::quantity::Unit;
use trunnion_solver::exechon::Machine;
use trunnion_solver::probe::{OffsetFit, Reversal, Touch, ball, offset};

/// The ring and how well it and a touch are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauge {
    /// The ring's radius less the stylus ball's, mm.
    pub radius: f64,
    /// Standard deviation of a touch, mm.
    pub touch: f64,
    /// Standard uncertainty of the ring's radius, mm.
    pub ring: f64,
}

impl Gauge {
    /// From what is written on a ring and a probe: diameters of the ring and of the stylus ball in mm, the probe's repeatability
    /// and the accuracy of the ring's diameter as two sigma in µm.
    pub fn new(diameter: f64, stylus: f64, repeatability_um: f64, accuracy_um: f64) -> Self {
        Self { radius: (diameter - stylus) / 2.0, touch: repeatability_um / 2e3, ring: accuracy_um / 4e3 }
    }
}

/// What the touches say.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetReport {
    /// The probe turned by the spindle less the dependent rotation.
    pub with_rotation: OffsetFit<f64>,
    /// The probe turned by the spindle alone.
    pub spindle_alone: OffsetFit<f64>,
    /// E(8) and E(9), where the touches are the paper's.
    pub reversal: Option<ReversalReport>,
    /// Each touch as it was met.
    pub touches: Vec<Met>,
}

/// A touch beside the ring that fits all of them best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// The spindle axis, mm.
    pub position: [f64; 2],
    /// How far the probe was turned from its orientation at home, s − φ, rad.
    pub turned: f64,
    /// Where the ball touched, from the ring's centre, rad.
    pub angle: f64,
    /// By how much the ball is farther out than the ring allows, mm: with the rotation, and with the spindle angle alone.
    pub deviation: [f64; 2],
}

/// Touches scatter more than what is stated of the probe.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "the touches scatter by {:.2} µm about the ring, where a touch is stated to be good to {:.3} µm (one standard deviation): the ± of \
     what is stated is too small here; look for a wrong touch, a spindle angle in the other sense, or a ring that is not round or clean",
    um(*residual_std),
    um(*touch)
)]
pub struct Scattered {
    /// Standard deviation of the residuals, mm.
    pub residual_std: f64,
    /// What is stated of a touch, mm.
    pub touch: f64,
}

/// How often touches as good as stated scatter so much.
const RARELY: f64 = 0.01;

impl OffsetReport {
    /// Standard uncertainty of both coordinates, mm: by reversal, where there is one, else of all touches together.
    pub fn uncertainty(&self) -> [f64; 2] {
        let covariance = &self.with_rotation.covariance;
        self.reversal.map_or_else(|| [0, 1].map(|k| covariance[(k, k)].sqrt()), |own| own.uncertainty)
    }

    /// Whether the touches scatter more, about the ring and with the rotation, than what is stated of one.
    pub fn scattered(&self, gauge: &Gauge) -> Option<Scattered> {
        let residual_std = self.with_rotation.residual_std?;
        let unknowns = self.with_rotation.covariance.nrows();
        let free = self.touches.len().checked_sub(unknowns).filter(|free| *free > 0)? as f64;
        let squares = free * (residual_std / gauge.touch).powi(2);
        let by_chance = ChiSquared::new(free).ok()?.sf(squares);
        (by_chance < RARELY).then_some(Scattered { residual_std, touch: gauge.touch })
    }

    /// Uncertainties of both coordinates: by reversal, where there is one, else of all touches together, which find the radius
    /// themselves.
    pub fn budgets(&self, gauge: &Gauge) -> [ProbedBudget; 2] {
        let all = self.uncertainty();
        let parts = self.reversal.map_or([all, [0.0; 2]], |own| own.parts);
        let part = |source, quantity, std: f64, contribution: f64| {
            ProbedPart::stated(source, quantity, 2.0 * std, if std > 0.0 { contribution / std } else { 0.0 })
        };
        [("x", 0), ("y", 1)].map(|(result, k)| {
            let touch = part("probe", "a touch", gauge.touch, parts[0][k]);
            ProbedBudget::new(result, vec![touch, part("ring", "its diameter", 2.0 * gauge.ring, parts[1][k])])
        })
    }

    /// The same by trials: each touch and the ring's radius as they may have been.
    pub fn tried(&self, gauge: &Gauge) -> Option<Tried<2>> {
        let found = self.reversal.map_or(self.with_rotation.offset, |own| own.exact);
        let trial = |random: &mut ChaCha8Rng| {
            let off = gauge.ring * normal(random);
            let touch = |met: &Met| {
                let ((s, c), by) = (met.angle.sin_cos(), gauge.touch * normal(random));
                Touch { position: [met.position[0] + by * c, met.position[1] + by * s], turned: met.turned }
            };
            let touches: Vec<Touch<f64>> = self.touches.iter().map(touch).collect();
            let offset = match self.reversal {
                Some(_) => reversed(&touches, gauge.radius + off)?.exact().ok()?,
                None => offset(&touches, gauge.touch).ok()?.offset,
            };
            Some([offset[0] - found[0], offset[1] - found[1]])
        };
        Tried::new(self.touches.len(), trial)
    }
}

/// The paper's formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReversalReport {
    /// The offset, mm.
    pub exact: [f64; 2],
    /// The same for small angles, mm.
    pub small_angle: [f64; 2],
    /// Standard uncertainty, mm.
    pub uncertainty: [f64; 2],
    /// What the touches and what the ring's radius put into it, mm.
    pub parts: [[f64; 2]; 2],
    /// Correlation of both coordinates: they have the radius in common.
    pub correlation: f64,
}

/// The offset from a file of touches (`x_mm,y_mm,z_mm,spindle_deg`), with what was read.
///
/// # Errors
/// [`InputError`].
pub fn offset_report(machine: &Machine<f64>, file: &Path, gauge: &Gauge) -> Result<(OffsetReport, Stamp), InputError> {
    let turned = |&TouchLine { line, position, spindle }: &TouchLine| {
        let rotation = rotation_at(machine, position, ALONG).map_err(|problem| InputError::Point {
            file: file.to_owned(),
            line,
            problem,
        })?;
        Ok(([position[0], position[1]], spindle, spindle - rotation))
    };
    let (touched, stamp) = touches(file, None, 1)?;
    let touched = touched.iter().map(turned).collect::<Result<Vec<_>, InputError>>()?;
    let fit = |touches: Vec<Touch<f64>>| {
        offset(&touches, gauge.touch).map_err(|problem| InputError::Offset { file: file.to_owned(), problem })
    };
    let with = |&(position, _, turned): &([f64; 2], f64, f64)| Touch { position, turned };
    let alone = |&(position, turned, _): &([f64; 2], f64, f64)| Touch { position, turned };
    let with_rotation: Vec<Touch<f64>> = touched.iter().map(with).collect();
    let spindle_alone: Vec<Touch<f64>> = touched.iter().map(alone).collect();
    let reversal = reversal(&with_rotation, gauge);
    let fits = [fit(with_rotation.clone())?, fit(spindle_alone.clone())?];
    let met = |(with, alone): (&Touch<f64>, &Touch<f64>)| {
        let [(angle, deviation), (_, of_alone)] = [(with, &fits[0]), (alone, &fits[1])].map(|(t, fit)| beside(t, fit));
        Met { position: with.position, turned: with.turned, angle, deviation: [deviation, of_alone] }
    };
    let touches = with_rotation.iter().zip(&spindle_alone).map(met).collect();
    let [with_rotation, spindle_alone] = fits;
    Ok((OffsetReport { with_rotation, spindle_alone, reversal, touches }, stamp))
}

/// Where the ball touched, rad about the fitted centre, and how much farther out than the fitted circle, mm.
fn beside(touch: &Touch<f64>, fit: &OffsetFit<f64>) -> (f64, f64) {
    let [x, y] = ball(touch.position, touch.turned, fit.offset);
    let (x, y) = (x - fit.centre[0], y - fit.centre[1]);
    (y.atan2(x), x.hypot(y) - fit.radius)
}

fn um(mm: f64) -> f64 {
    Unit::Um.from_inner(mm)
}

/// The paper's touches where these are they: both ways along x and y, then +x and +y with the spindle reversed.
fn reversed(touches: &[Touch<f64>], radius: f64) -> Option<Reversal<f64>> {
    let near = |angle: f64, to: f64| ((angle - to) / 2.0).sin().abs() < 0.02;
    let at = |to: f64| touches.iter().filter(move |touch| near(touch.turned, to)).map(|touch| touch.position);
    let range = |k: usize, to: f64| {
        at(to).map(|p| p[k]).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    if at(0.0).count() != 4 || at(PI).count() < 2 {
        return None;
    }
    let middle = |(low, high): (f64, f64)| (low + high) / 2.0;
    let centre = [middle(range(0, 0.0)), middle(range(1, 0.0))];
    let farthest = |k: usize| at(PI).max_by(|a, b| a[k].total_cmp(&b[k]));
    Some(Reversal { centre, x: farthest(0)?, y: farthest(1)?, radius })
}

/// E(8) and E(9) where the touches are the paper's.
fn reversal(touches: &[Touch<f64>], gauge: &Gauge) -> Option<ReversalReport> {
    let touches = reversed(touches, gauge.radius)?;
    let covariance = |touch, ring| touches.covariance(touch, ring).ok();
    let stds = |covariance: [[f64; 2]; 2]| [covariance[0][0].sqrt(), covariance[1][1].sqrt()];
    let all = covariance(gauge.touch, gauge.ring)?;
    let [x, y] = stds(all);
    Some(ReversalReport {
        exact: touches.exact().ok()?,
        small_angle: touches.small_angle(),
        uncertainty: [x, y],
        parts: [stds(covariance(gauge.touch, 0.0)?), stds(covariance(0.0, gauge.ring)?)],
        correlation: if x * y > 0.0 { all[0][1] / (x * y) } else { 0.0 },
    })
}
