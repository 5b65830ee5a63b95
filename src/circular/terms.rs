//! What is read from a trace: a term of its linear model each, in mm at its largest.
//!
//! With u = (cos a, sin a) outward, a point displaced by Δ reads Δ·u. As seen in the plane of axes X and Y at radius R:
//!
//! ```text
//! radius        δ                           δ
//! centre        (x, y)                      x cos a + y sin a
//! scale         Δx = mx x, Δy = my y        R (mx − my)/2 · cos 2a   (their mean is radius)
//! squareness    Δx = −γ y                   −R γ/2 · sin 2a
//! servo         Δ = −(tx vx, ty vy)         ±F (tx − ty)/2 · sin 2a  (+ counterclockwise; F the feed)
//! backlash      Δx = −B/2 · sign vx         ±B/2 · cos a sign(sin a)
//!               Δy = −B/2 · sign vy         ∓B/2 · sin a sign(cos a)
//! ```

use super::direction::Direction;
use super::plane::{Axis, Plane, Reversal};
use crate::data::Radius;
use trunnion_codegen::quantity::Unit;

/// What the deviations of a trace are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// The path's radius less the nominal one: the bar's length, the mean of both axes' scales, what the feed takes off.
    Radius,
    /// The path's centre, less the instrument's, along an axis.
    Centre(Axis),
    /// The first axis' travel less the second's.
    Scale,
    /// The angle between the positive axes, less 90°.
    Squareness,
    /// How much the first axis lags behind, less how much the second one does.
    Servo,
    /// In one direction squareness and servo mismatch look alike: squareness that would be as large.
    SquarenessAndServo,
    /// What an axis stays behind when it turns round: positive where it is lost, which is a step outwards.
    Backlash(Reversal),
}

/// A way to write a term, and what it is times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// As in names of fields: `um_per_m`.
    pub key: &'static str,
    /// As people write it: `µm/m`.
    pub symbol: &'static str,
    /// One mm of the term is this much of it.
    pub factor: f64,
}

impl Term {
    /// All that there are with both directions, or with one.
    pub(super) fn all(both: bool) -> Vec<Self> {
        let mut all = vec![Self::Radius, Self::Centre(Axis::First), Self::Centre(Axis::Second), Self::Scale];
        all.extend([Self::Squareness, Self::Servo]);
        all.extend((!both).then_some(Self::SquarenessAndServo));
        all.extend(Reversal::ALL.map(Self::Backlash));
        all
    }

    /// As in names of fields.
    pub fn key(self) -> &'static str {
        match self {
            Self::Radius => "radius",
            Self::Centre(Axis::First) => "centre_first",
            Self::Centre(Axis::Second) => "centre_second",
            Self::Scale => "scale_mismatch",
            Self::Squareness => "squareness",
            Self::Servo => "servo_mismatch",
            Self::SquarenessAndServo => "squareness_and_servo_mismatch",
            Self::Backlash(_) => "backlash",
        }
    }

    /// For people.
    pub fn name(self, plane: Plane) -> String {
        let [first, second] = Axis::ALL.map(|axis| plane.axis(axis));
        match self {
            Self::Radius => "radius less nominal".to_owned(),
            Self::Centre(axis) => format!("centre along {}", plane.axis(axis)),
            Self::Scale => format!("scale mismatch, {first} less {second}"),
            Self::Squareness => format!("squareness, +{first} to +{second} less 90°"),
            Self::Servo => format!("servo mismatch, lag of {first} less {second}"),
            Self::SquarenessAndServo => "squareness and servo mismatch".to_owned(),
            Self::Backlash(reversal) => format!("backlash of {} at {}", plane.axis(reversal.axis), plane.end(reversal)),
        }
    }

    /// The ways to write it, the usual one first; `feed` in mm/s, if it is known.
    pub fn measures(self, radius: Radius, feed: Option<f64>) -> Vec<Measure> {
        let um = |times: f64| Measure { key: "um", symbol: "µm", factor: Unit::Um.from_inner(times) };
        let per_radius = Unit::Urad.from_inner(1.0 / radius.mm());
        let per_metre = Measure { key: "um_per_m", symbol: "µm/m", factor: per_radius };
        match self {
            // Travels differ by a mismatch times the diameter.
            Self::Scale => {
                vec![per_metre, Measure { key: "um_over_diameter", symbol: "µm over the diameter", ..um(2.0) }]
            }
            Self::Squareness | Self::SquarenessAndServo => {
                vec![per_metre, Measure { key: "urad", symbol: "µrad", factor: per_radius }]
            }
            Self::Servo => {
                let time = feed.map(|feed| Measure { key: "ms", symbol: "ms", factor: 1e3 / feed });
                time.into_iter().chain([um(1.0)]).collect()
            }
            Self::Radius | Self::Centre(_) | Self::Backlash(_) => vec![um(1.0)],
        }
    }

    /// What one mm of it makes of the deviation at an angle (rad), in a direction; `lone` is a backlash whose axis' other end
    /// is not passed.
    pub(super) fn at(self, angle: f64, direction: Direction, lone: bool) -> f64 {
        let way = direction.sign();
        match self {
            Self::Radius => 1.0,
            Self::Centre(axis) => axis.along(angle),
            Self::Scale => (2.0 * angle).cos() / 2.0,
            Self::Squareness | Self::SquarenessAndServo => -(2.0 * angle).sin() / 2.0,
            Self::Servo => way * (2.0 * angle).sin() / 2.0,
            Self::Backlash(Reversal { axis, positive }) => {
                let along = axis.along(angle);
                // The other axis' side tells which way this one moves.
                let behind = match axis {
                    Axis::First => way * angle.sin().signum(),
                    Axis::Second => -way * angle.cos().signum(),
                };
                // From an end to the other it goes over evenly.
                let share = if positive { (1.0 + along) / 2.0 } else { (1.0 - along) / 2.0 };
                behind * along / 2.0 * if lone { 1.0 } else { share }
            }
        }
    }
}
