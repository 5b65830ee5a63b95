//! The minimum zone of any number of points.

use trunnion_solver::circle::{CircleError, Point, Zone, minimum_zone};

/// Points that the search begins with, evenly along the path.
const FIRST: usize = 24;
/// Roundings of a radius by which a point may lie outside.
const ROUNDINGS: f64 = 64.0;

/// As [`minimum_zone`], whose time grows with the points' number's square or cube.
///
/// A few points have a zone that is no wider than that of all. The points that are farthest outside of it are joined to them,
/// again and again: once it encloses all points, it is that of all. The same goes for the two lines where those are nearer.
pub(crate) fn zone(points: &[Point<f64>]) -> Result<Zone<f64>, CircleError> {
    if points.len() <= FIRST || !points.iter().flatten().all(|x| x.is_finite()) {
        return minimum_zone(points);
    }
    let mut chosen: Vec<usize> = (0..points.len()).step_by(points.len().div_ceil(FIRST)).collect();
    loop {
        let few: Vec<_> = chosen.iter().filter_map(|at| points.get(*at).copied()).collect();
        let found = minimum_zone(&few);
        let (across, [low, high]) = match &found {
            Ok(zone) => (Across::Circles(zone.centre), [zone.inner, zone.outer]),
            Err(_) => strip(&few),
        };
        let [(nearest, inner), (farthest, outer)] = across.extremes(points);
        let slack = ROUNDINGS * f64::EPSILON * across.size(outer.abs().max(inner.abs()));
        let outside = [(nearest, inner < low - slack), (farthest, outer > high + slack)];
        let before = chosen.len();
        for (at, is) in outside {
            if is && !chosen.contains(&at) {
                chosen.push(at);
            }
        }
        if chosen.len() == before {
            return found.map(|zone| {
                let contacts = zone.contacts.and_then(|held| {
                    let [a, b, c, d] = held.map(|at| chosen.get(at).copied());
                    Some([a?, b?, c?, d?])
                });
                Zone { inner, outer, contacts, ..zone }
            });
        }
    }
}

/// What encloses points, between two values.
#[derive(Clone, Copy)]
enum Across {
    /// Circles about a centre, by their radii.
    Circles(Point<f64>),
    /// Lines square to a direction, by how far along it they are.
    Lines(Point<f64>),
}

impl Across {
    fn at(self, [x, y]: &Point<f64>) -> f64 {
        match self {
            Self::Circles([a, b]) => (x - a).hypot(y - b),
            Self::Lines([c, s]) => c * x + s * y,
        }
    }

    /// The first and the last point across, each with its value.
    fn extremes(self, points: &[Point<f64>]) -> [(usize, f64); 2] {
        let first = (0, f64::INFINITY);
        points.iter().map(|p| self.at(p)).enumerate().fold([first, (0, -first.1)], |[low, high], (at, value)| {
            [if value < low.1 { (at, value) } else { low }, if value > high.1 { (at, value) } else { high }]
        })
    }

    /// What a value has its rounding from.
    fn size(self, value: f64) -> f64 {
        match self {
            Self::Circles([a, b]) => value + a.abs() + b.abs(),
            Self::Lines(_) => value,
        }
    }
}

/// The narrowest strip between parallel lines around points: one of the lines goes through two of them.
fn strip(points: &[Point<f64>]) -> (Across, [f64; 2]) {
    let square = |[p, q]: [&Point<f64>; 2]| {
        let (x, y) = (q[0] - p[0], q[1] - p[1]);
        let length = x.hypot(y);
        (length > 0.0).then(|| Across::Lines([-y / length, x / length]))
    };
    let pairs = points.iter().enumerate().flat_map(|(at, p)| points[..at].iter().map(move |q| [p, q]));
    let strips = pairs.filter_map(square).map(|across| (across, across.extremes(points).map(|(_, value)| value)));
    let any = (Across::Lines([1.0, 0.0]), Across::Lines([1.0, 0.0]).extremes(points).map(|(_, value)| value));
    strips.fold(any, |best, next| if next.1[1] - next.1[0] < best.1[1] - best.1[0] { next } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;
    use chacha20::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};
    use std::f64::consts::TAU;

    /// Points of several kinds: rings, arcs, discs, strips, thin ellipses, lattices, places touched again and again, lines.
    fn drawn(kind: usize, n: usize, random: &mut ChaCha8Rng) -> Vec<Point<f64>> {
        let mut u = || random.random_range(-1.0..=1.0);
        let on = |turn: f64, r: f64| [300.0 + r * (TAU * turn).cos(), r * (TAU * turn).sin()];
        let place = |k: usize| {
            let turn = k as f64 / n as f64;
            match kind {
                0 => on(turn, 20.0 + 1e-3 * u()),
                1 => on(0.1 * turn, 20.0 + 0.05 * u()),
                2 => on(u(), u()),
                3 => [u(), 0.01 * u()],
                4 => [(TAU * turn).cos(), 0.01 * (TAU * turn).sin()],
                5 => [(k % 7) as f64, (k / 7) as f64],
                6 => on((k % 3) as f64 / 3.0, 20.0 + 0.01 * u()),
                7 => on(turn, 20.0),
                _ => [k as f64, if k + 2 < n { 0.0 } else { 3.0 }],
            }
        };
        (0..n).map(place).collect()
    }

    #[test]
    fn a_few_points_stand_for_all() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for case in 0..900 {
            let points = drawn(case % 9, 3 + case / 9, &mut random);
            match (zone(&points), minimum_zone(&points)) {
                (Ok(few), Ok(all)) => {
                    let size = all.outer + all.centre[0].abs() + all.centre[1].abs();
                    assert!((few.width() - all.width()).abs() <= 1e-13 * size, "{case}: {few:?} {all:?}");
                    assert!(few.is_minimal(&points, 1e-12 * size), "{case}: {few:?}");
                }
                (few, all) => assert_eq!(few.map(|_| ()), all.map(|_| ()), "{case}"),
            }
        }
    }

    #[test]
    fn a_scan_takes_no_time() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        for kind in 0..9 {
            let points = drawn(kind, 100_000, &mut random);
            match zone(&points) {
                Ok(zone) => assert!(zone.is_minimal(&points, 1e-12 * (1e3 + zone.outer)), "{kind}: {zone:?}"),
                Err(error) => {
                    assert!([CircleError::BetweenLines, CircleError::InLine].contains(&error), "{kind}: {error}")
                }
            }
        }
    }
}
