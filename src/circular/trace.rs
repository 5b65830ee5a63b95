//! What is measured: one path of a circular test, or one in each direction.

use super::direction::Direction;
use super::profile::Profile;
use crate::data::Radius;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use thiserror::Error;

/// The shortest arc that is tested, rad: a quarter of the circle (ISO 230-4, nominal path).
const SHORTEST: f64 = FRAC_PI_2;
/// The fewest angles of a path.
const FEWEST: usize = 8;
/// This share of a path's steps has to go one way, or its samples are in no order.
const ORDERED: f64 = 0.75;

/// Why samples are no path.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TraceError {
    /// An angle or a deviation is NaN or infinite.
    #[error("sample {} is not finite\n  expected an angle and a deviation", .sample + 1)]
    NotFinite {
        /// The sample, counted from 0.
        sample: usize,
    },
    /// Fewer different angles than a circle with its usual errors needs.
    #[error("{angles} different angle(s)\n  expected at least {FEWEST}")]
    TooFew {
        /// How many there are.
        angles: usize,
    },
    /// A part of the circle that tells nothing of it.
    #[error(
        "an arc of {:.1}°\n  expected at least {}° of the circle, which ISO 230-4 asks for",
        .arc.to_degrees(),
        SHORTEST.to_degrees()
    )]
    ShortArc {
        /// Angles covered, rad.
        arc: f64,
    },
}

/// One path: radial deviations over angles, in any order, over the whole circle or an arc of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    samples: Vec<(f64, f64)>,
    profile: Profile,
}

impl Trace {
    /// A path of pairs of angle (rad, from the first axis to the second) and radial deviation (mm, outward from the nominal
    /// circle about the instrument's centre).
    ///
    /// # Errors
    /// [`TraceError`]
    pub fn new(samples: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, TraceError> {
        let samples: Vec<_> = samples.into_iter().collect();
        if let Some(sample) = samples.iter().position(|(a, d)| !(a.is_finite() && d.is_finite())) {
            return Err(TraceError::NotFinite { sample });
        }
        let profile = Profile::new(samples.iter().copied());
        if profile.angles() < FEWEST {
            return Err(TraceError::TooFew { angles: profile.angles() });
        }
        let arc = profile.arc();
        // Samples stand for half a step on either side.
        if arc + profile.step() < SHORTEST * (1.0 - 1e-9) {
            return Err(TraceError::ShortArc { arc });
        }
        Ok(Self { samples, profile })
    }

    /// Angle (rad) and deviation (mm) of each sample, in the order given.
    pub fn samples(&self) -> &[(f64, f64)] {
        &self.samples
    }

    /// The deviation as a function of the angle.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Where the samples are in the plane, mm.
    pub fn points(&self, radius: Radius) -> Vec<[f64; 2]> {
        self.samples.iter().map(|sample| point(sample, radius)).collect()
    }

    /// Which way the samples' angles go, in the order given; none if they are in no order.
    pub fn order(&self) -> Option<Direction> {
        let ahead = |((a, _), (b, _)): (&(f64, f64), &(f64, f64))| (b - a + PI).rem_euclid(TAU) - PI;
        let steps: Vec<f64> = self.samples.iter().zip(self.samples.iter().skip(1)).map(ahead).collect();
        let share = |way: f64| steps.iter().filter(|step| **step * way > 0.0).count() as f64 / steps.len() as f64;
        [Direction::Clockwise, Direction::Counterclockwise].into_iter().find(|d| share(d.sign()) >= ORDERED)
    }

    /// The samples as they are passed in a direction: in the order given or its reverse; by their angles, if they are in none.
    pub fn path(&self, direction: Direction) -> Vec<(f64, f64)> {
        let (mut path, order) = match self.order() {
            Some(order) => (self.samples.clone(), order),
            None => (self.profile.points().to_vec(), Direction::Counterclockwise),
        };
        if order != direction {
            path.reverse();
        }
        path
    }
}

/// The paths of a test: one, or one in each direction.
#[derive(Clone, Debug, PartialEq)]
pub enum Traces {
    /// Clockwise alone.
    Clockwise(Trace),
    /// Counterclockwise alone.
    Counterclockwise(Trace),
    /// Both.
    Both {
        /// Clockwise.
        clockwise: Trace,
        /// Counterclockwise.
        counterclockwise: Trace,
    },
}

impl Traces {
    /// Of those that there are; none without any.
    pub fn of(clockwise: Option<Trace>, counterclockwise: Option<Trace>) -> Option<Self> {
        match (clockwise, counterclockwise) {
            (None, None) => None,
            (Some(trace), None) => Some(Self::Clockwise(trace)),
            (None, Some(trace)) => Some(Self::Counterclockwise(trace)),
            (Some(clockwise), Some(counterclockwise)) => Some(Self::Both { clockwise, counterclockwise }),
        }
    }

    /// Each with its direction, clockwise first.
    pub fn each(&self) -> impl Iterator<Item = (Direction, &Trace)> {
        let (clockwise, counterclockwise) = match self {
            Self::Clockwise(trace) => (Some(trace), None),
            Self::Counterclockwise(trace) => (None, Some(trace)),
            Self::Both { clockwise, counterclockwise } => (Some(clockwise), Some(counterclockwise)),
        };
        let clockwise = clockwise.map(|trace| (Direction::Clockwise, trace));
        clockwise.into_iter().chain(counterclockwise.map(|trace| (Direction::Counterclockwise, trace)))
    }

    /// Whether there are both directions.
    pub fn both(&self) -> bool {
        matches!(self, Self::Both { .. })
    }
}

/// Where a sample is in the plane, mm.
pub(super) fn point((angle, deviation): &(f64, f64), radius: Radius) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    let r = radius.mm() + deviation;
    [r * c, r * s]
}
