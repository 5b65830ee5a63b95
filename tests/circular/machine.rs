//! A machine that goes round a circle, axis by axis: where its tool is, nothing linearised.

use super::R;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use trunnion::circular::Direction;

/// mm/s.
pub const FEED: f64 = 50.0 / 3.0;

/// A length by the share of its travel that an axis has gone.
type Lost = fn(f64) -> f64;

/// What is wrong with it; lengths in mm, angles in rad, times in s. X is the first axis of each pair.
#[derive(Clone, Default)]
pub struct Machine {
    /// Share of its travel that an axis goes too far.
    pub scale: [f64; 2],
    /// By how much the angle from +X to +Y is over a right one: +Y leans towards −X.
    pub square: f64,
    /// The instrument's centre is this far on the negative side.
    pub centre: [f64; 2],
    /// The bar is so much too short.
    pub short: f64,
    /// What an axis stays behind.
    pub lost: [Option<Lost>; 2],
    /// By how long an axis lags behind.
    pub lag: [f64; 2],
    /// At an angle (rad), outwards, after it has been passed in either direction, for three degrees.
    pub spikes: Vec<(f64, f64)>,
    /// Half width of uniform noise, with its seed.
    pub noise: Option<(f64, u64)>,
}

impl Machine {
    /// What the instrument reads at angles (rad) of a path.
    pub fn read(&self, direction: Direction, angles: impl IntoIterator<Item = f64>) -> Vec<(f64, f64)> {
        let mut random = self.noise.map(|(_, seed)| ChaCha8Rng::seed_from_u64(seed));
        angles
            .into_iter()
            .map(|a| {
                let noise = random.as_mut().map_or(0.0, |r| r.random_range(-1.0..=1.0) * self.noise.unwrap().0);
                (a, self.distance(direction, a) - R + noise)
            })
            .collect()
    }

    fn distance(&self, direction: Direction, a: f64) -> f64 {
        let way = if direction == Direction::Counterclockwise { 1.0 } else { -1.0 };
        let asked = [R * a.cos(), R * a.sin()];
        // Just past where it is, so that an axis that turns round there has done so.
        let next = a + way * 1e-9;
        let moves = [-way * next.sin(), way * next.cos()];
        let [x, y] = [0, 1].map(|k| {
            let lost = self.lost[k].map_or(0.0, |lost| lost(asked[k] / R));
            asked[k] * (1.0 + self.scale[k]) - moves[k].signum() * lost / 2.0 - self.lag[k] * FEED * moves[k]
        });
        let tool = [x - self.square * y + self.centre[0], y + self.centre[1]];
        tool[0].hypot(tool[1]) + self.short + self.spike(way, a)
    }

    fn spike(&self, way: f64, a: f64) -> f64 {
        let degrees = |at: f64| (way * (a - at).to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
        let triangle = |t: f64| if (0.0..=3.0).contains(&t) { 1.0 - (t - 1.5).abs() / 1.5 } else { 0.0 };
        self.spikes.iter().map(|(at, height)| height * triangle(degrees(*at))).sum()
    }

    /// Both paths, clockwise first.
    pub fn both(&self, from: f64, to: f64, samples: u32) -> [Vec<(f64, f64)>; 2] {
        let up = degrees(from, to, samples);
        let other = Self { noise: self.noise.map(|(size, seed)| (size, seed ^ 0xffff)), ..self.clone() };
        let down = other.read(Direction::Clockwise, up.iter().rev().copied());
        [down, self.read(Direction::Counterclockwise, up)]
    }
}

/// Evenly over a range in degrees, half a step off its ends; rad.
pub fn degrees(from: f64, to: f64, samples: u32) -> Vec<f64> {
    let share = |k: u32| (f64::from(k) + 0.5) / f64::from(samples);
    (0..samples).map(|k| (from + (to - from) * share(k)).to_radians()).collect()
}
