//! The minimum zone of long paths, against search by brute force and against the solver's own of all points.

use super::machine::{Machine, degrees};
use super::{R, figures, trace};
use trunnion::circular::{Direction, Traces};
use trunnion_solver::circle::minimum_zone;

fn noisy(samples: u32, seed: u64) -> Vec<(f64, f64)> {
    let machine =
        Machine { scale: [10e-6, -5e-6], centre: [0.01, 0.02], noise: Some((0.002, seed)), ..Machine::default() };
    machine.read(Direction::Counterclockwise, degrees(0.0, 360.0, samples))
}

fn points(path: &[(f64, f64)]) -> Vec<[f64; 2]> {
    path.iter().map(|(a, d)| [(R + d) * a.cos(), (R + d) * a.sin()]).collect()
}

/// Width of the zone about a centre.
fn width(points: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let radii = points.iter().map(|p| (p[0] - x).hypot(p[1] - y));
    let (low, high) = radii.fold((f64::INFINITY, 0.0f64), |(low, high), r| (low.min(r), high.max(r)));
    high - low
}

/// The least width over a grid of centres, made finer about the best one again and again. Near a circle the width is convex.
fn brute_force(points: &[[f64; 2]]) -> f64 {
    let (mut best, mut centre, mut step) = (f64::INFINITY, [0.0, 0.0], 0.02);
    while step > 1e-9 {
        let about = centre;
        for k in 0..441 {
            let tried = [about[0] + f64::from(k % 21 - 10) * step, about[1] + f64::from(k / 21 - 10) * step];
            let own = width(points, tried);
            if own < best {
                (best, centre) = (own, tried);
            }
        }
        step *= 0.3;
    }
    best
}

#[test]
fn no_centre_has_a_narrower_zone() {
    for seed in 0..20 {
        for samples in [12, 90, 400] {
            let path = noisy(samples, seed);
            let zone = figures(Traces::Counterclockwise(trace(path.clone()))).paths[0].circles.zone;
            let points = points(&path);
            super::near(zone.width(), brute_force(&points), 2e-8);
            super::near(zone.width(), minimum_zone(&points).unwrap().width(), 1e-11);
            assert!(zone.is_minimal(&points, 1e-10), "{zone:?}");
        }
    }
}

#[test]
fn an_arc_has_the_zone_of_all_its_points() {
    for seed in 0..20 {
        let machine = Machine { centre: [0.01, 0.02], noise: Some((0.002, seed)), ..Machine::default() };
        let path = machine.read(Direction::Counterclockwise, degrees(-20.0, 200.0, 300));
        let zone = figures(Traces::Counterclockwise(trace(path.clone()))).paths[0].circles.zone;
        super::near(zone.width(), minimum_zone(&points(&path)).unwrap().width(), 1e-11);
    }
}

#[test]
fn a_hundred_thousand_samples_take_no_time() {
    let path = noisy(100_000, 3);
    let start = std::time::Instant::now();
    let zone = figures(Traces::Counterclockwise(trace(path.clone()))).paths[0].circles.zone;
    assert!(zone.is_minimal(&points(&path), 1e-10));
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}
