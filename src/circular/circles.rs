//! ISO 230-4: circular deviation, radial deviation, circular hysteresis.

use super::profile::Profile;
use super::trace::{Trace, point};
use crate::data::Radius;
use crate::roundness::zone;
use std::f64::consts::TAU;
use trunnion_solver::circle::{CircleError, CircleFit, Point, Zone, least_squares};

/// The circles about one path, or about both.
#[derive(Clone, Debug, PartialEq)]
pub struct Circles {
    /// The least-squares circle of the samples; its `roundness` is G (or G(b)) about its centre.
    pub least_squares: CircleFit<f64>,
    /// The minimum zone; its `width` is G (or G(b)) as the standard defines it.
    pub zone: Zone<f64>,
}

impl Circles {
    /// About points in the plane, mm.
    pub(super) fn about(points: &[Point<f64>]) -> Result<Self, CircleError> {
        Ok(Self { least_squares: least_squares(points)?, zone: zone(points)? })
    }

    /// F about the least-squares centre, mm: the largest and the smallest deviation from the nominal radius.
    pub fn radial(&self, radius: Radius) -> [f64; 2] {
        let (low, high) = self.least_squares.radii;
        [high, low].map(|r| r - radius.mm())
    }

    /// The least-squares circle's radius less the nominal one, mm.
    pub fn radius(&self, radius: Radius) -> f64 {
        self.least_squares.circle.radius - radius.mm()
    }
}

/// A deviation and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// mm.
    pub deviation: f64,
    /// rad, from 0 to a turn.
    pub angle: f64,
}

/// F: the largest and the smallest radial deviation from the nominal circle, about the centre that the instrument was set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radial {
    /// Fmax.
    pub max: At,
    /// Fmin.
    pub min: At,
}

/// F of the samples of a path, or of both.
pub(super) fn radial<'a>(samples: impl Iterator<Item = &'a (f64, f64)> + Clone) -> Radial {
    let at = |sample: Option<&(f64, f64)>| {
        let (angle, deviation) = sample.copied().unwrap_or_default();
        At { deviation, angle: angle.rem_euclid(TAU) }
    };
    let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    Radial { max: at(samples.clone().max_by(by)), min: at(samples.min_by(by)) }
}

/// H: the largest radial difference of two paths at one angle about a centre, whichever is the outer one; none where they
/// have no angle in common. Samples at one angle are averaged.
pub(super) fn hysteresis(paths: [&Trace; 2], radius: Radius, centre: Point<f64>) -> Option<At> {
    let seen = |trace: &Trace| Profile::new(trace.profile().points().iter().map(|p| about(centre, &point(p, radius))));
    let [one, other] = paths.map(seen);
    let angles = one.points().iter().chain(other.points()).map(|(angle, _)| *angle);
    let apart = angles.filter_map(|angle| {
        let deviation = (one.at(angle)? - other.at(angle)?).abs();
        Some(At { deviation, angle: angle.rem_euclid(TAU) })
    });
    apart.max_by(|a, b| a.deviation.total_cmp(&b.deviation))
}

/// A point's direction (rad) and distance (mm) from a centre.
fn about([x, y]: Point<f64>, p: &Point<f64>) -> (f64, f64) {
    let (u, v) = (p[0] - x, p[1] - y);
    (v.atan2(u), u.hypot(v))
}
