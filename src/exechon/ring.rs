//! A ring test: corrected points, circles, roundness, spread.

use super::input::{InputError, touches};
use super::{ALONG, PointError, rotation_at};
use crate::data::Stamp;
use crate::roundness::zone;
use crate::study::{Histogram, coverage_factor};
use std::path::Path;
use trunnion_solver::circle::{CircleError, CircleFit, Zone, least_squares};
use trunnion_solver::exechon::Machine;
use trunnion_solver::probe::ball;

/// What a ring test shows.
#[derive(Clone, Debug, PartialEq)]
pub struct RingReport {
    /// Angle (rad) about the least-squares centre and radial deviation (mm) of each point, in the order given.
    pub deviations: Vec<(f64, f64)>,
    /// The least-squares circle of the ball's centres.
    pub fit: CircleFit<f64>,
    /// The minimum zone.
    pub zone: Zone<f64>,
    /// Angle (rad), number of touches, mean deviation and its standard deviation (mm) at each place touched more than
    /// once.
    pub spread: Vec<(f64, usize, f64, f64)>,
}

/// Why there is no report.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RingError {
    /// A point that the machine does not reach.
    #[error("{1}\n  {remedy}", remedy = .1.remedy())]
    Point(usize, #[source] PointError),
    /// Points without a circle.
    #[error("{0}\n  expected points all around a ring, at least three of them different and not in line")]
    Circle(#[from] CircleError),
}

/// Expanded uncertainties of a least-squares circle, 95 %, mm: from the scatter of the touches alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpandedCircle {
    /// Coverage factor: Student's t.
    pub factor: f64,
    /// Of the centre's coordinates.
    pub centre: [f64; 2],
    /// Of the diameter.
    pub diameter: f64,
}

impl RingReport {
    /// Degrees of freedom of the scatter: three touches make a circle.
    pub fn degrees_of_freedom(&self) -> usize {
        self.deviations.len().saturating_sub(3)
    }

    /// How well the touches determine the circle; none where they leave no scatter.
    pub fn expanded(&self) -> Option<ExpandedCircle> {
        let covariance = self.fit.scatter?.covariance;
        let factor = coverage_factor(u32::try_from(self.degrees_of_freedom()).ok());
        let half = |k: usize| factor * covariance[(k, k)].sqrt();
        Some(ExpandedCircle { factor, centre: [half(0), half(1)], diameter: 2.0 * half(2) })
    }

    /// The radial deviations counted; none where they leave no scatter.
    pub fn histogram(&self) -> Option<Histogram> {
        let std = self.fit.scatter?.residual_std;
        Some(Histogram::of(self.deviations.iter().map(|(_, mm)| *mm), std))
    }

    /// Root mean square of the radial deviations, mm.
    pub fn rms(&self) -> f64 {
        let squares: f64 = self.deviations.iter().map(|(_, mm)| mm * mm).sum();
        (squares / self.deviations.len().max(1) as f64).sqrt()
    }

    /// Diameter of the ring that was touched from inside with a ball of this diameter, mm.
    pub fn diameter(&self, stylus: f64) -> f64 {
        2.0 * self.fit.circle.radius + stylus
    }

    /// Inner and outer diameter of its minimum zone, mm.
    pub fn zone_diameters(&self, stylus: f64) -> [f64; 2] {
        [self.zone.inner, self.zone.outer].map(|radius| 2.0 * radius + stylus)
    }

    /// The largest standard deviation over repeats, mm; none without repeats.
    pub fn largest_std(&self) -> Option<f64> {
        self.spread.iter().map(|(.., std)| *std).reduce(f64::max)
    }
}

/// Fits circles to probed points: the spindle axis' positions (mm) and spindle angles (rad). With an `offset` (mm) each
/// point is first moved to the ball's centre, whatever the spindle angle and the dependent rotation there. Touches whose
/// angles agree within half of `step` (rad) are repeats.
///
/// # Errors
/// [`RingError`].
pub fn ring_report(
    machine: &Machine<f64>,
    points: &[([f64; 3], f64)],
    offset: Option<[f64; 2]>,
    step: f64,
) -> Result<RingReport, RingError> {
    let centre = |(index, (at, spindle)): (usize, &([f64; 3], f64))| match offset {
        None => Ok([at[0], at[1]]),
        Some(offset) => {
            let phi = rotation_at(machine, *at, ALONG).map_err(|e| RingError::Point(index, e))?;
            Ok(ball([at[0], at[1]], spindle - phi, offset))
        }
    };
    let balls = points.iter().enumerate().map(centre).collect::<Result<Vec<_>, RingError>>()?;
    let (fit, zone) = (least_squares(&balls)?, zone(&balls)?);
    let [a, b] = fit.circle.centre;
    let polar = |p: &[f64; 2]| ((p[1] - b).atan2(p[0] - a).rem_euclid(std::f64::consts::TAU), fit.circle.deviation(p));
    let deviations: Vec<_> = balls.iter().map(polar).collect();
    let spread = spread(&deviations, step);
    Ok(RingReport { deviations, fit, zone, spread })
}

/// As [`ring_report`] from a file of touches (`x_mm,y_mm,z_mm` and perhaps `spindle_deg`, else 0), with what was read.
///
/// # Errors
/// [`InputError`].
pub fn ring_report_of(
    machine: &Machine<f64>,
    file: &Path,
    offset: Option<[f64; 2]>,
    step: f64,
) -> Result<(RingReport, Stamp), InputError> {
    let (touches, stamp) = touches(file, Some(0.0), 1)?;
    let points: Vec<_> = touches.iter().map(|touch| (touch.position, touch.spindle)).collect();
    let report = ring_report(machine, &points, offset, step).map_err(|error| {
        let file = file.to_owned();
        match error {
            RingError::Circle(problem) => InputError::Circle { file, problem },
            RingError::Point(at, problem) => InputError::Point { file, line: touches[at].line, problem },
        }
    })?;
    Ok((report, stamp))
}

/// Repeats at each place.
fn spread(deviations: &[(f64, f64)], step: f64) -> Vec<(f64, usize, f64, f64)> {
    let places = (std::f64::consts::TAU / step).round().max(1.0);
    let mut at_place: std::collections::BTreeMap<u64, Vec<f64>> = std::collections::BTreeMap::new();
    for (angle, deviation) in deviations {
        let place = (angle / step).round() % places;
        at_place.entry(place as u64).or_default().push(*deviation);
    }
    let repeated = at_place.into_iter().filter(|(_, values)| values.len() > 1);
    let of = |(place, values): (u64, Vec<f64>)| {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        (place as f64 * step, values.len(), mean, (square / (n - 1.0)).sqrt())
    };
    repeated.map(of).collect()
}
