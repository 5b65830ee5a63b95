//! A ring test: corrected points, circles, roundness, spread.

use super::budget::{ProbedBudget, ProbedPart, Tried, normal};
use super::input::{InputError, touches};
use super::{ALONG, PointError, rotation_at};
use crate::data::Stamp;
use crate::roundness::zone;
use crate::study::Histogram;
use chacha20::ChaCha8Rng;
use nalgebra::Vector3;
use std::path::Path;
use trunnion_solver::circle::{CircleError, CircleFit, Zone, least_squares};
use trunnion_solver::exechon::Machine;
use trunnion_solver::lstsq::Factor;
use trunnion_solver::probe::ball;

/// What a ring test shows.
#[derive(Clone, Debug, PartialEq)]
pub struct RingReport {
    /// Angle (rad) about the least-squares centre and radial deviation (mm) of each point, in the order given.
    pub deviations: Vec<(f64, f64)>,
    /// How far the probe was turned at each from its orientation at home, rad; none where no offset is taken off.
    pub turned: Option<Vec<f64>>,
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

/// How well what a ring is probed with is known: two standard deviations, mm; 0 of what is taken as exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeKnown {
    /// Of each coordinate of the probe's offset.
    pub offset: f64,
    /// Of the stylus ball's diameter.
    pub stylus: f64,
}

/// Results: by how much each changes with its own of the circle's centre and radius, and with the stylus ball's diameter.
const RESULTS: [(&str, f64, f64); 3] = [("centre x", 1.0, 0.0), ("centre y", 1.0, 0.0), ("diameter", 2.0, 1.0)];

impl RingReport {
    /// Degrees of freedom of the scatter: three touches make a circle.
    pub fn degrees_of_freedom(&self) -> usize {
        self.deviations.len().saturating_sub(3)
    }

    /// Uncertainties of the circle's centre and of the ring's diameter; none where the touches leave no scatter.
    pub fn budgets(&self, known: &ProbeKnown) -> Option<[ProbedBudget; 3]> {
        let scatter = self.fit.scatter?;
        let of_offset = self.per_offset();
        let degrees_of_freedom = u32::try_from(self.degrees_of_freedom()).ok();
        let budget = |k: usize| {
            let (result, times, of_stylus) = RESULTS[k];
            let own = times * scatter.covariance[(k, k)].sqrt();
            let sensitivity = if scatter.residual_std > 0.0 { own / scatter.residual_std } else { 0.0 };
            let (std, stated) = (scatter.residual_std, None);
            let touch =
                ProbedPart { source: "probe", quantity: "a touch", stated, std, sensitivity, degrees_of_freedom };
            let of = |name, of: usize| {
                let sensitivity = times * of_offset.map_or(0.0, |columns| columns[of][k]);
                ProbedPart::stated("offset", name, known.offset, sensitivity)
            };
            let stylus = ProbedPart::stated("stylus ball", "its diameter", known.stylus, of_stylus);
            let stated = [of("its x", 0), of("its y", 1), stylus];
            let known = stated.into_iter().filter(|part| part.std > 0.0);
            ProbedBudget::new(result, std::iter::once(touch).chain(known).collect())
        };
        Some([0, 1, 2].map(budget))
    }

    /// The same by trials: each touch, the offset and the stylus ball as they may have been, and circles fitted to them.
    pub fn tried(&self, known: &ProbeKnown) -> Option<Tried<3>> {
        let scatter = self.fit.scatter?;
        let (free, circle) = (self.degrees_of_freedom(), &self.fit.circle);
        let trial = |random: &mut ChaCha8Rng| {
            // A scatter known from few touches: Student's t of several results together.
            let squares: f64 = (0..free).map(|_| normal(random).powi(2)).sum();
            let std = scatter.residual_std * (free as f64 / squares).sqrt();
            let offset = [0, 1].map(|_| known.offset / 2.0 * normal(random));
            let balls = self.deviations.iter().enumerate().map(|(at, (angle, _))| {
                let (s, c) = angle.sin_cos();
                let out = circle.radius + std * normal(random);
                let place = [circle.centre[0] + out * c, circle.centre[1] + out * s];
                self.turned.as_ref().map_or(place, |turned| ball(place, turned[at], offset))
            });
            let found = least_squares(&balls.collect::<Vec<_>>()).ok()?.circle;
            let [x, y] = [0, 1].map(|k| found.centre[k] - circle.centre[k]);
            let stylus = known.stylus / 2.0 * normal(random);
            Some([x, y, 2.0 * (found.radius - circle.radius) + stylus])
        };
        Tried::new(self.deviations.len(), trial)
    }

    /// By how much the circle's centre and radius change with each coordinate of the offset.
    fn per_offset(&self) -> Option<[Vector3<f64>; 2]> {
        let turned = self.turned.as_ref()?;
        let of = |unit: [f64; 2]| {
            let mut factor = Factor::<f64, 3>::new();
            for ((angle, _), turned) in self.deviations.iter().zip(turned) {
                let ((s, c), [x, y]) = (angle.sin_cos(), ball([0.0; 2], *turned, unit));
                factor.push(&Vector3::new(c, s, 1.0), x * c + y * s).ok()?;
            }
            factor.coefficients().ok()
        };
        Some([of([1.0, 0.0])?, of([0.0, 1.0])?])
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
    let turn = |(index, (at, spindle)): (usize, &([f64; 3], f64))| {
        let phi = rotation_at(machine, *at, ALONG).map_err(|e| RingError::Point(index, e))?;
        Ok(spindle - phi)
    };
    let turned = |_| points.iter().enumerate().map(turn).collect::<Result<Vec<_>, RingError>>();
    let turned = offset.map(turned).transpose()?;
    let positions = points.iter().map(|([x, y, _], _)| [*x, *y]);
    let balls: Vec<[f64; 2]> = match turned.as_deref().zip(offset) {
        None => positions.collect(),
        Some((turned, offset)) => positions.zip(turned).map(|(at, turned)| ball(at, *turned, offset)).collect(),
    };
    let (fit, zone) = (least_squares(&balls)?, zone(&balls)?);
    let [a, b] = fit.circle.centre;
    let polar = |p: &[f64; 2]| ((p[1] - b).atan2(p[0] - a).rem_euclid(std::f64::consts::TAU), fit.circle.deviation(p));
    let deviations: Vec<_> = balls.iter().map(polar).collect();
    let spread = spread(&deviations, step);
    Ok(RingReport { deviations, turned, fit, zone, spread })
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
