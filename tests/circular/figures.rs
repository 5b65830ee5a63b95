//! G, G(b), F, H and D.

use super::machine::{Machine, degrees};
use super::{NM, R, both, circular, figures, near, test, trace};
use std::f64::consts::TAU;
use trunnion::circular::{CircularError, Direction, Trace, TraceError, Traces, Undetermined, Warning};
use trunnion_solver::circle::CircleError;

/// Turns of an eighth: degrees, µm.
fn eighths(deviations: [f64; 8]) -> Vec<(f64, f64)> {
    deviations.iter().enumerate().map(|(k, d)| ((45.0 * k as f64).to_radians(), d * 1e-3)).collect()
}

#[test]
fn an_ellipse_has_the_difference_of_its_half_axes() {
    // X goes 20 µm/m too far, Y 10 µm/m too short: half axes of 150.003 and 149.9985 mm.
    let machine = Machine { scale: [20e-6, -10e-6], ..Machine::default() };
    let [cw, ccw] = machine.both(0.0, 360.0, 720);
    let told = both(cw, ccw);
    for path in &told.paths {
        assert!(path.whole);
        near(path.circles.zone.width(), 0.0045, NM);
        near(path.circles.least_squares.roundness(), 0.0045, NM);
        near(path.radial.max.deviation, 0.003, NM);
        near(path.radial.min.deviation, -0.0015, NM);
        let [max, min] = told.centred(path).unwrap();
        near(max, 0.003, NM);
        near(min, -0.0015, NM);
    }
    let together = told.both.unwrap();
    near(together.circles.zone.width(), 0.0045, NM);
    near(together.mean_radial.unwrap(), (0.003 - 0.0015) / 2.0, NM);
    near(together.hysteresis.unwrap().deviation, 0.0, 1e-12);
}

#[test]
fn small_paths_by_hand() {
    // An oval and a circle that is 2 µm larger at 225° alone.
    let oval = eighths([1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0]);
    let bump = eighths([0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let told = both(bump.clone(), oval.clone());
    let [of_bump, of_oval] = [&told.paths[0], &told.paths[1]];
    near(of_oval.circles.zone.width(), 0.002, NM);
    near(of_oval.circles.least_squares.roundness(), 0.002, NM);
    near(of_oval.radial.max.deviation, 0.001, 1e-15);
    near(of_oval.radial.min.deviation, -0.001, 1e-15);
    // Eight directions u, the fifth with 2: the centre goes by 2·2/8·u, the radius by 2/8. The bump is left with
    // 2 − 1/4 − 1/2, opposite of it −1/4 + 1/2, and least are its neighbours: −1/4 − √½/2.
    near(of_bump.circles.least_squares.roundness(), (1.25 + 0.25 + 0.5 * 0.5f64.sqrt()) * 1e-3, NM);
    near(of_bump.radial.max.angle.to_degrees(), 225.0, 1e-9);
    // Moved by t towards the bump, it is left with 2 − t, its neighbours with −√½ t, opposite of it is t: the narrowest zone
    // has the bump as far out as that, 2 − t = t.
    near(of_bump.circles.zone.width(), (1.0 + 0.5f64.sqrt()) * 1e-3, NM);
    let together = told.both.as_ref().unwrap();
    near(together.hysteresis.unwrap().deviation, 0.002, NM);
    near(together.hysteresis.unwrap().angle.to_degrees(), 225.0, 1e-3);
    near(together.mean_radial.unwrap(), 0.002 / 16.0, NM);
    near(together.radial.max.deviation, 0.002, 1e-15);
    near(together.radial.min.deviation, -0.001, 1e-15);
    assert!(together.circles.zone.width() > of_oval.circles.zone.width());
}

#[test]
fn between_its_samples_a_path_is_straight() {
    // One sample of the other path in the middle of a step from 0 to 4 µm.
    let ramp = eighths([0.0, 4.0, 4.0, 0.0, 0.0, 4.0, 4.0, 0.0]);
    let turned: Vec<_> = ramp.iter().map(|(a, _)| (a + 22.5f64.to_radians(), 0.003)).collect();
    let told = both(ramp, turned);
    // The level of 3 is 3 off at 0, 135°, 180° and 315°.
    near(told.both.as_ref().unwrap().hysteresis.unwrap().deviation, 0.003, 2.0 * NM);
    let step = eighths([0.0, 4.0, 0.0, 4.0, 0.0, 4.0, 0.0, 4.0]);
    let middle: Vec<_> = step.iter().map(|(a, _)| (a + 22.5f64.to_radians(), 0.002)).collect();
    near(both(step, middle).both.unwrap().hysteresis.unwrap().deviation, 0.002, NM);
}

#[test]
fn what_is_off_centre_is_in_f_alone() {
    let machine = Machine { centre: [0.05, -0.03], scale: [5e-6, 0.0], short: 0.002, ..Machine::default() };
    let still = Machine { centre: [0.0; 2], ..machine.clone() };
    let [cw, ccw] = machine.both(0.0, 360.0, 360);
    let [cw_still, ccw_still] = still.both(0.0, 360.0, 360);
    let (told, at_rest) = (both(cw, ccw), both(cw_still, ccw_still));
    for (path, rest) in told.paths.iter().zip(&at_rest.paths) {
        // The deviations' angles are about the instrument: a circle off it by e is e²/R less known.
        let within = 2.0 * 0.0034 / R;
        near(path.circles.zone.width(), rest.circles.zone.width(), within);
        near(path.circles.least_squares.roundness(), rest.circles.least_squares.roundness(), within);
        let [x, y] = path.circles.least_squares.circle.centre;
        near(x, 0.05, 1e-5);
        near(y, -0.03, 1e-5);
        near(path.radial.max.deviation - rest.radial.max.deviation, 0.05f64.hypot(0.03), 0.001);
        near(told.centred(path).unwrap()[0], at_rest.centred(rest).unwrap()[0], within);
    }
    let (one, other) = (told.both.unwrap(), at_rest.both.unwrap());
    near(one.mean_radial.unwrap(), other.mean_radial.unwrap(), 2e-5);
    near(one.circles.zone.width(), other.circles.zone.width(), 1e-4);
}

#[test]
fn hysteresis_and_the_zone_of_both_are_those_of_lost_motion() {
    // X stays behind by 8 µm: counterclockwise the path is 4 µm farther out where x and y have one sign, clockwise elsewhere.
    let machine = Machine { lost: [Some(|_| 0.008), None], ..Machine::default() };
    let [cw, ccw] = machine.both(0.0, 360.0, 720);
    let told = both(cw.clone(), ccw.clone());
    let together = told.both.unwrap();
    let h = together.hysteresis.unwrap();
    near(h.deviation, 0.008 * 0.25f64.to_radians().cos(), NM);
    assert!([0.25, 179.75, 180.25, 359.75].iter().any(|a| (h.angle.to_degrees() - a).abs() < 0.01), "{h:?}");
    // Both about one centre, which symmetry puts in the middle.
    near(together.circles.zone.width(), 0.008 * 0.25f64.to_radians().cos(), NM);
    // H does not mind which path is which; nor whether one has an offset that the other has too.
    near(both(ccw, cw).both.unwrap().hysteresis.unwrap().deviation, h.deviation, 1e-12);
}

#[test]
fn an_arc_has_its_figures_and_those_it_lacks_are_named() {
    let machine = Machine { scale: [20e-6, -10e-6], centre: [0.004, 0.0], ..Machine::default() };
    let [cw, ccw] = machine.both(-20.0, 200.0, 440);
    let told = both(cw, ccw);
    for path in &told.paths {
        assert!(!path.whole);
        near(path.arc.to_degrees(), 219.5, 1e-9);
        assert_eq!(told.centred(path), Err(Undetermined::PartialCircle));
    }
    let together = told.both.as_ref().unwrap();
    assert_eq!(together.mean_radial, Err(Undetermined::PartialCircle));
    near(together.hysteresis.unwrap().deviation, 0.0, 1e-12);
    // Two halves of a circle that meet nowhere.
    let [_, upper] = machine.both(20.0, 160.0, 200);
    let [lower, _] = machine.both(200.0, 340.0, 200);
    assert_eq!(both(lower, upper).both.unwrap().hysteresis, Err(Undetermined::Apart));
}

#[test]
fn neither_order_nor_repeats_nor_whole_turns_matter() {
    let machine = Machine { scale: [20e-6, 0.0], noise: Some((0.001, 5)), ..Machine::default() };
    let [cw, ccw] = machine.both(0.0, 360.0, 360);
    let told = both(cw.clone(), ccw.clone());
    let mixed = |path: &[(f64, f64)]| {
        let turned = |(a, d): &(f64, f64)| (a + TAU * f64::from((a * 1e3) as u32 % 3), *d);
        let mut path: Vec<_> = path.iter().map(turned).collect();
        path.sort_by_key(|(a, _)| (a * 1e6) as u64 * 7919 % 1009);
        path
    };
    let again = both(mixed(&cw), mixed(&ccw));
    assert!(again.paths.iter().all(|path| path.start.is_none() && path.whole));
    for (a, b) in told.paths.iter().zip(&again.paths) {
        near(a.circles.zone.width(), b.circles.zone.width(), 1e-9);
        near(a.circles.least_squares.roundness(), b.circles.least_squares.roundness(), 1e-9);
    }
    let h = |told: &super::Circular| told.both.as_ref().unwrap().hysteresis.unwrap().deviation;
    near(h(&told), h(&again), 1e-9);
    // A second time, off by 1 µm the other way: the mean is as it was, the range is not.
    let twice = |path: &[(f64, f64)], by: f64| path.iter().flat_map(|(a, d)| [(*a, d - by), (*a, d + by)]).collect();
    let repeated = both(twice(&cw, 0.001), twice(&ccw, -0.001));
    near(h(&repeated), h(&told), 1e-9);
    assert!(repeated.paths[0].circles.zone.width() > told.paths[0].circles.zone.width() + 0.0015);
}

#[test]
fn a_path_that_goes_the_other_way_is_told() {
    let [cw, ccw] = Machine::default().both(0.0, 360.0, 90);
    assert_eq!(both(cw.clone(), ccw.clone()).warnings().count(), 0);
    let swapped = both(ccw.clone(), cw);
    let warnings: Vec<_> = swapped.warnings().collect();
    assert_eq!(warnings, [Direction::Clockwise, Direction::Counterclockwise].map(Warning::Against));
    let told = figures(Traces::Counterclockwise(trace(ccw)));
    near(told.paths[0].start.unwrap().to_degrees(), 2.0, 1e-9);
}

#[test]
fn what_is_no_path_is_refused_by_name() {
    let whole = degrees(0.0, 360.0, 90);
    let path = |deviation: fn(usize) -> f64| whole.iter().enumerate().map(move |(k, a)| (*a, deviation(k)));
    let nan = Trace::new(path(|k| if k == 7 { f64::NAN } else { 0.0 }));
    assert_eq!(nan, Err(TraceError::NotFinite { sample: 7 }));
    let seven = (0..70).map(|k| (f64::from(k % 7), 0.0));
    assert_eq!(Trace::new(seven), Err(TraceError::TooFew { angles: 7 }));
    let short = degrees(10.0, 98.0, 88).into_iter().map(|a| (a, 0.0));
    assert!(matches!(Trace::new(short), Err(TraceError::ShortArc { arc }) if (arc.to_degrees() - 87.0).abs() < 1e-9));
    assert!(Trace::new(degrees(10.0, 100.0, 90).into_iter().map(|a| (a, 0.0))).is_ok());
    let far = circular(&test(Traces::Clockwise(trace(path(|k| if k == 3 { 80.0 } else { 0.0 }).collect()))));
    assert!(matches!(far, Err(CircularError::Deviation { direction: Direction::Clockwise, .. })));
    assert_eq!(Traces::of(None, None), None);
    let told = CircularError::Circle { which: trunnion::circular::Which::Both, problem: CircleError::InLine };
    assert!(told.to_string().contains("both paths together"));
}
