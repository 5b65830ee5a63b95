//! A measuring plan: where to touch a feature, from where, and how the spindle stands there (Fig. 6).

use super::{ALONG, PointError, rotation_at};
use std::f64::consts::TAU;
use trunnion_solver::exechon::Machine;

/// What is measured; mm, machine coordinates, the tool pointing as at home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// A bore or ring, touched from inside at evenly spread angles.
    Ring {
        /// Its centre, at the height of the ball's equator.
        centre: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Number of touches.
        touches: u32,
    },
    /// A plane across the tool, touched on a square grid.
    Plane {
        /// The grid's middle, on the plane.
        centre: [f64; 3],
        /// The grid's side.
        side: f64,
        /// Touches along a side.
        touches: u32,
    },
    /// The half of a ball that looks at the spindle: a touch at its top and rings of touches down to its equator.
    Sphere {
        /// Its centre.
        centre: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Touches on a ring.
        touches: u32,
        /// Rings, the lowest one the equator.
        rings: u32,
    },
}

/// One touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedTouch {
    /// Where the ball's centre stands before, mm.
    pub from: [f64; 3],
    /// Where it is at the touch of a perfect feature, mm.
    pub at: [f64; 3],
    /// The spindle angle that keeps the probe's orientation there, rad.
    pub spindle: f64,
}

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A number that cannot be.
    #[error("{0} is out of range\n  expected {1}")]
    Number(&'static str, &'static str),
    /// The machine does not reach a touch.
    #[error("touch {0}: {1}\n  {remedy}", remedy = .1.remedy())]
    Point(usize, #[source] PointError),
}

/// The touches of a feature with a ball of radius `ball`, mm, from `clearance`, mm, before the surface.
///
/// # Errors
/// [`PlanError`].
pub fn plan(
    machine: &Machine<f64>,
    feature: &Feature,
    ball: f64,
    clearance: f64,
) -> Result<Vec<PlannedTouch>, PlanError> {
    check(feature, ball, clearance)?;
    let mut touches = Vec::new();
    for (at, (point, outward)) in surface(feature).into_iter().enumerate() {
        let off = |way: f64| [0, 1, 2].map(|k| point[k] + way * outward[k]);
        let [from, at_touch] = [off(ball + clearance), off(ball)];
        let failed = |e| PlanError::Point(at + 1, e);
        rotation_at(machine, from, ALONG).map_err(failed)?;
        let spindle = rotation_at(machine, at_touch, ALONG).map_err(failed)?;
        touches.push(PlannedTouch { from, at: at_touch, spindle });
    }
    Ok(touches)
}

/// Touches of a feature: a day's work of a machine.
const MOST_TOUCHES: u64 = 10_000;

fn check(feature: &Feature, ball: f64, clearance: f64) -> Result<(), PlanError> {
    let positive = |value: f64, name| match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(PlanError::Number(name, "a positive number of mm")),
    };
    positive(ball, "the stylus diameter")?;
    positive(clearance, "the clearance")?;
    let (size, touches, least) = match *feature {
        Feature::Ring { radius, touches, .. } => {
            positive(radius - ball - clearance, "the ring's radius less the ball's and the clearance")?;
            (radius, touches, 3)
        }
        Feature::Plane { side, touches, .. } => (side, touches, 2),
        Feature::Sphere { radius, touches, rings, .. } => {
            if rings == 0 {
                return Err(PlanError::Number("the number of rings", "at least 1"));
            }
            (radius, touches, 3)
        }
    };
    positive(size, "the feature's size")?;
    let all = match *feature {
        Feature::Ring { touches, .. } => u64::from(touches),
        Feature::Plane { touches, .. } => u64::from(touches).pow(2),
        Feature::Sphere { touches, rings, .. } => u64::from(touches) * u64::from(rings),
    };
    match touches {
        _ if touches < least => Err(PlanError::Number("the number of touches", "at least 3 on a circle, 2 on a side")),
        _ if all > MOST_TOUCHES => Err(PlanError::Number("the number of touches", "at most 10000 in all")),
        _ => Ok(()),
    }
}

/// Points of a feature and the directions out of the material.
fn surface(feature: &Feature) -> Vec<([f64; 3], [f64; 3])> {
    let turn = |k: u32, n: u32| (TAU * f64::from(k) / f64::from(n)).sin_cos();
    let moved = |c: [f64; 3], r: f64, u: [f64; 3]| [0, 1, 2].map(|k| c[k] + r * u[k]);
    match *feature {
        Feature::Ring { centre, radius, touches } => {
            let touch = |k| {
                let (s, c) = turn(k, touches);
                (moved(centre, radius, [c, s, 0.0]), [-c, -s, 0.0])
            };
            (0..touches).map(touch).collect()
        }
        Feature::Plane { centre, side, touches } => {
            let place = |k: u32| side * (f64::from(k) / f64::from(touches - 1) - 0.5);
            // To and fro, so that the ways between touches are short.
            let column = |i: u32| (0..touches).map(move |k| (i, if i.is_multiple_of(2) { k } else { touches - 1 - k }));
            let point = |(i, k)| ([centre[0] + place(i), centre[1] + place(k), centre[2]], TOWARDS_SPINDLE);
            (0..touches).flat_map(column).map(point).collect()
        }
        Feature::Sphere { centre, radius, touches, rings } => {
            let ring = |i: u32| {
                let (down, across) = (TAU / 4.0 * f64::from(i) / f64::from(rings)).sin_cos();
                (0..touches).map(move |k| {
                    let (s, c) = turn(k, touches);
                    let outward = [down * c, down * s, -across];
                    (moved(centre, radius, outward), outward)
                })
            };
            let top = (moved(centre, radius, TOWARDS_SPINDLE), TOWARDS_SPINDLE);
            std::iter::once(top).chain((1..=rings).flat_map(ring)).collect()
        }
    }
}

/// Machine z points from the spindle to the work.
const TOWARDS_SPINDLE: [f64; 3] = [0.0, 0.0, -1.0];
