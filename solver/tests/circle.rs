//! Circles against NIST's reference fits, and the minimum zone against its own condition and against search.

use proptest::prelude::*;
use serde_json::Value;
use std::fs;
use trunnion_solver::circle::*;

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// Name, points, centre and diameter.
type Set = (String, Vec<[f64; 2]>, [f64; 2], f64);

fn sets() -> Vec<Set> {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference/circle");
    let files = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let sets = files.map(|file| {
        let set: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
        let pair = |value: &Value| [number(&value[0]), number(&value[1])];
        let points = set["points"].as_array().unwrap().iter().map(pair).collect();
        let best = &set["mp40"];
        (set["name"].as_str().unwrap().to_owned(), points, pair(&best["center"]), 2.0 * number(&best["radius"]))
    });
    sets.collect()
}

#[test]
fn reference_circles_agree() {
    let sets = sets();
    assert_eq!(sets.len(), 16);
    let mut worst = [0f64; 2];
    for (name, points, centre, diameter) in sets {
        let fit = least_squares(&points).unwrap();
        let off = |at: usize| (fit.circle.centre[at] - centre[at]).abs() / centre[at].abs();
        let (place, size) = (off(0).max(off(1)), (2.0 * fit.circle.radius - diameter).abs() / diameter);
        println!("{name}: centre {place:e}, diameter {size:e}");
        worst = [worst[0].max(place), worst[1].max(size)];
    }
    println!("worst: centre {:e}, diameter {:e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-10 && worst[1] < 1e-10);
}

#[test]
fn minimum_zones_of_the_reference_sets_are_minimal() {
    for (name, points, ..) in sets() {
        let fit = least_squares(&points).unwrap();
        let zone = minimum_zone(&points).unwrap_or_else(|e| panic!("{name}: {e}"));
        println!(
            "{name}: least squares {:.3e}, minimum zone {:.3e} {:?}",
            fit.roundness(),
            zone.width(),
            zone.contacts
        );
        assert!(zone.width() <= fit.roundness() && zone.is_minimal(&points, 1e-10));
        let moved = Zone { centre: [zone.centre[0] + 1e-3 * zone.outer, zone.centre[1]], ..zone };
        assert!(!moved.is_minimal(&points, 1e-10));
    }
}

#[test]
fn what_has_no_circle() {
    let both = |points: &[[f64; 2]]| {
        assert_eq!(minimum_zone(points).unwrap_err(), least_squares(points).unwrap_err());
        least_squares(points).unwrap_err()
    };
    assert_eq!(both(&[]), CircleError::TooFewPoints { points: 0 });
    assert_eq!(both(&[[1.0, 2.0], [3.0, 4.0]]), CircleError::TooFewPoints { points: 2 });
    assert_eq!(both(&[[1.0, 2.0]; 7]), CircleError::AllEqual);
    assert_eq!(both(&[[0.0, 0.0], [1.0, f64::NAN], [2.0, 2.0]]), CircleError::NotFinite { point: 1 });
    let line: Vec<_> = (0..20).map(|k| [0.1 * f64::from(k) - 300.0, 0.3 * f64::from(k) + 7.0]).collect();
    assert_eq!(both(&line), CircleError::InLine);
    assert_eq!(both(&[[1.0, 5.0], [2.0, 5.0], [9.0, 5.0]]), CircleError::InLine);
    assert_eq!(both(&[[1.0, 5.0], [2.0, 7.0], [1.0, 5.0], [2.0, 7.0]]), CircleError::InLine);
}

/// A thin ellipse and a strip are on no line, but every circle is farther from them than one.
#[test]
fn what_a_line_fits_better_than_any_circle() {
    let place = |k: u32| f64::from(k) / 40.0 * std::f64::consts::TAU;
    for thin in [1e-2, 1e-6, 1e-9] {
        let ellipse: Vec<_> = (0..40).map(|k| [7.0 + 20.0 * place(k).cos(), 20.0 * thin * place(k).sin()]).collect();
        let strip: Vec<_> = (0..40).map(|k| [f64::from(k), 40.0 * thin * f64::from(k % 2)]).collect();
        for points in [ellipse, strip] {
            assert_eq!(least_squares(&points).map(|fit| fit.circle), Err(CircleError::AlongLine), "{thin}");
        }
    }
    // A thick one has its circle.
    let ellipse: Vec<_> = (0..40).map(|k| [20.0 * place(k).cos(), 19.0 * place(k).sin()]).collect();
    assert!(least_squares(&ellipse).is_ok());
}

#[test]
fn three_points_say_nothing_of_their_scatter() {
    let points = [[17.8, 200.0], [-8.7, 215.2], [-8.8, 184.8], [2.0, 182.6]];
    assert_eq!(least_squares(&points[..3]).unwrap().scatter, None);
    assert!(least_squares(&points).unwrap().scatter.unwrap().residual_std > 0.0);
}

/// Points near a circle, all along an arc that need not be whole.
fn ring() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let points = prop::collection::vec((0.0..1.0, -1.0..1.0), 5..60);
    let sizes = [90.0..360.0, -900.0..900.0, 1.0..200.0, 1e-6..1e-3];
    (points, sizes).prop_map(|(points, sizes): (Vec<(f64, f64)>, [f64; 4])| {
        let [arc, at, radius, form] = sizes;
        let n = points.len() as f64;
        let place = |(k, (jitter, deviation)): (usize, &(f64, f64))| {
            let (angle, r) = (((k as f64 + jitter) / n * arc).to_radians(), radius * (1.0 + form * deviation));
            [at + r * angle.cos(), 0.3 * at + r * angle.sin()]
        };
        points.iter().enumerate().map(place).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_centre_nearby_has_a_narrower_zone(points in ring(), away in prop::collection::vec((-1.0..1.0, -1.0..1.0), 40)) {
        let zone = minimum_zone(&points);
        prop_assert!(zone.is_ok(), "{}", zone.unwrap_err());
        let zone = zone.unwrap();
        let width = |centre: [f64; 2]| {
            let radii = points.iter().map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]));
            let (low, high) = radii.fold((f64::INFINITY, 0f64), |(l, h), r| (l.min(r), h.max(r)));
            high - low
        };
        for (dx, dy) in away {
            for size in [1e-2, 1.0, 30.0] {
                let step = size * zone.width();
                let other = width([zone.centre[0] + step * dx, zone.centre[1] + step * dy]);
                prop_assert!(other >= zone.width() - 1e-10, "{other} < {}", zone.width());
            }
        }
    }

    #[test]
    fn the_least_squares_circle_has_no_gradient(points in ring()) {
        let fit = least_squares(&points).unwrap();
        let mut gradient = [0f64; 3];
        for p in &points {
            let (x, y) = (p[0] - fit.circle.centre[0], p[1] - fit.circle.centre[1]);
            let (r, d) = (x.hypot(y), fit.circle.deviation(p));
            gradient = [gradient[0] + d * x / r, gradient[1] + d * y / r, gradient[2] + d];
        }
        prop_assert!(gradient.iter().all(|g| g.abs() < 1e-9), "{gradient:?}");
    }
}

/// Widths at all centres where circles through points meet: each bisector of a pair with each other, by the definition.
fn brute_force(points: &[[f64; 2]]) -> f64 {
    let pairs: Vec<_> = (0..points.len()).flat_map(|i| (0..i).map(move |j| (points[i], points[j]))).collect();
    let mut narrowest = f64::INFINITY;
    for (k, (a, b)) in pairs.iter().enumerate() {
        for (c, d) in &pairs[..k] {
            // |x − a|² = |x − b|² and |x − c|² = |x − d|² about a: two linear equations.
            let row = |p: [f64; 2], q: [f64; 2]| {
                let (p, q) = ([p[0] - a[0], p[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
                let right = (q[0] * q[0] + q[1] * q[1] - p[0] * p[0] - p[1] * p[1]) / 2.0;
                (q[0] - p[0], q[1] - p[1], right)
            };
            let ((m, n, e), (r, s, f)) = (row(*a, *b), row(*c, *d));
            let determinant = m * s - n * r;
            if determinant.abs() > 1e-13 * (m.hypot(n) * r.hypot(s)) {
                let centre = [a[0] + (e * s - f * n) / determinant, a[1] + (m * f - r * e) / determinant];
                let (width, rounding) = width(points, centre);
                narrowest = narrowest.min(width + rounding);
            }
        }
    }
    narrowest
}

/// A width and what rounding may have taken off it.
fn width(points: &[[f64; 2]], centre: [f64; 2]) -> (f64, f64) {
    let radii = points.iter().map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]));
    let (low, high) = radii.fold((f64::INFINITY, 0f64), |(l, h), r| (l.min(r), h.max(r)));
    (high - low, 4.0 * f64::EPSILON * high)
}

/// Points of all kinds: rings and arcs, blobs, grids with points alike, clusters, far from the origin.
fn any_points() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let points = prop::collection::vec((0.0..1.0, -1.0..1.0), 3..16);
    (points, 0..5, [1.0..360.0, 0.0..1.0, -5.0..0.0]).prop_map(|(points, kind, [arc, far, form])| {
        let form = 10f64.powf(form);
        let place = |(k, (u, v)): (usize, &(f64, f64))| {
            let on = |turn: f64, r: f64| [50.0 * r * turn.to_radians().cos(), 50.0 * r * turn.to_radians().sin()];
            match kind {
                0 => on(u * 360.0, 1.0 + form * v),
                1 => on(u * arc, 1.0 + 0.01 * form * v),
                2 => [20.0 * u, 20.0 * v],
                3 => [(6.0 * u).floor(), (2.0 * v).floor()],
                _ => on(120.0 * (k % 3) as f64 + 2.0 * u, 1.0 + form * v),
            }
        };
        let offset = if far > 0.5 { 1e5 * (far - 0.5) } else { 0.0 };
        points.iter().enumerate().map(place).map(|[x, y]| [x + offset, y - offset]).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_other_zone_is_narrower(points in any_points()) {
        let best = brute_force(&points);
        match minimum_zone(&points) {
            Ok(zone) => {
                let far = zone.outer + points[0][0].abs() + points[0][1].abs();
                prop_assert!(zone.is_minimal(&points, 1e-12 * far), "{zone:?}");
                let slack = 1e-13 * far;
                prop_assert!((zone.width() - width(&points, zone.centre).0).abs() <= slack);
                prop_assert!(zone.width() <= best + slack, "{} > {best}", zone.width());
            }
            Err(CircleError::InLine | CircleError::AllEqual) => {}
            Err(error) => {
                // All directions of parallel lines, a thousandth of a degree apart.
                prop_assert_eq!(error, CircleError::BetweenLines);
                let towards = |k: u32| (f64::from(k) * 1e-3).to_radians().sin_cos();
                let strips = (0..180_000).map(|k| {
                    let (s, c) = towards(k);
                    let aside = points.iter().map(|p| c * (p[0] - points[0][0]) + s * (p[1] - points[0][1]));
                    let (low, high) = aside.fold((0f64, 0f64), |(l, h), r| (l.min(r), h.max(r)));
                    high - low
                });
                let strip = strips.fold(f64::INFINITY, f64::min);
                prop_assert!(strip <= best * (1.0 + 1e-3) + 1e-9, "{strip} > {best}");
            }
        }
    }
}

/// Found by the test above: three outer and three inner points in the same directions; sides of a trapezoid that are parallel
/// but for rounding, and so a centre 10¹⁶ away.
#[test]
fn contacts_in_one_direction_and_centres_beyond_all_digits() {
    let same = [[3.0, 0.0], [1.0, 1.0], [4.0, 1.0], [3.0, -1.0], [4.0, -2.0], [2.0, 0.0]];
    let zone = minimum_zone(&same).unwrap();
    assert!(zone.is_minimal(&same, 1e-12) && (zone.width() - 2f64.sqrt()).abs() < 1e-12, "{zone:?}");
    let parallel = [[0.0, -1.0], [4.0, 0.0], [2.0, 1.0], [5.0, 1.0]];
    let zone = minimum_zone(&parallel).unwrap();
    assert!(zone.is_minimal(&parallel, 1e-12) && zone.outer < 10.0, "{zone:?}");
}

/// The exchange of contacts from the least-squares circle ended at 1373.25 µm here.
#[test]
fn the_narrowest_of_several_zones() {
    let points = [[0.0_f64, 2.0], [1.0, 1.0], [2.0, 3.0], [1.0, 2.0], [1.0, 3.0], [2.0, 1.0], [-1.0, 2.0]];
    let zone = minimum_zone(&points.map(|[x, y]| [x, y + 200.0])).unwrap();
    // Two points on √13/2 + … from outside and two from inside: (√13 − 1)/2.
    assert!((zone.width() - (13f64.sqrt() - 1.0) / 2.0).abs() < 1e-12, "{}", zone.width());
    let copies: Vec<_> = points.into_iter().chain(points).chain(points).collect();
    assert!((minimum_zone(&copies).unwrap().width() - zone.width()).abs() < 1e-12);
}

/// Found by fuzzing: far points, whose zone has its centre beyond all numbers.
#[test]
fn zones_beyond_numbers_are_refused() {
    let near = 2.417_370_5e35_f32;
    let points = [[0.0, 0.0], [near, near], [2.415_342_3e35, 3.094_234_3e37], [near, 2.406_012_4e35]];
    let zone = minimum_zone(&points);
    assert_eq!(zone, Err(CircleError::BetweenLines));
}
