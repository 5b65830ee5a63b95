//! What is read from the trace.

use super::machine::{FEED, Machine, degrees};
use super::{NM, R, both, effect, figures, near, trace, value};
use std::f64::consts::FRAC_PI_2;
use trunnion::circular::{Axis, Direction, Reversal, Spike, Term, Traces, Undetermined};

fn end(axis: Axis, positive: bool) -> Term {
    Term::Backlash(Reversal { axis, positive })
}

/// Everything at once, some µm each.
fn machine() -> Machine {
    Machine {
        scale: [30e-6, -12e-6],
        square: 25e-6,
        centre: [0.006, -0.004],
        short: -0.003,
        lost: [Some(|x| 0.004 + 0.001 * x), Some(|_| 0.002)],
        lag: [0.5e-3, 0.2e-3],
        ..Machine::default()
    }
}

#[test]
fn each_error_of_a_machine_is_found_alone() {
    let squared = Machine { square: 40e-6, ..Machine::default() };
    let [cw, ccw] = squared.both(0.0, 360.0, 360);
    let told = both(cw, ccw);
    near(value(&told, Term::Squareness), 40e-6 * R, NM);
    for other in [Term::Scale, Term::Servo, Term::Centre(Axis::First), end(Axis::First, true), end(Axis::Second, false)]
    {
        near(value(&told, other), 0.0, 2.0 * NM);
    }
    // As people write it, the two ways of each.
    let written = |term: Term, told: &super::Circular| -> Vec<(&str, f64)> {
        let value = value(told, term);
        term.measures(told.radius, told.feed).iter().map(|m| (m.symbol, value * m.factor)).collect()
    };
    let square = written(Term::Squareness, &told);
    assert_eq!(square.iter().map(|(unit, _)| *unit).collect::<Vec<_>>(), ["µm/m", "µrad"]);
    square.iter().for_each(|(_, value)| near(*value, 40.0, 0.01));

    let stretched = Machine { scale: [30e-6, 10e-6], ..Machine::default() };
    let [cw, ccw] = stretched.both(0.0, 360.0, 360);
    let told = both(cw, ccw);
    let scale = written(Term::Scale, &told);
    assert_eq!(scale.iter().map(|(unit, _)| *unit).collect::<Vec<_>>(), ["µm/m", "µm over the diameter"]);
    near(scale[0].1, 20.0, 0.01);
    // 300 mm of travel, 20 µm/m.
    near(scale[1].1, 6.0, 0.003);
    near(value(&told, Term::Radius), 20e-6 * R, NM);

    let lagging = Machine { lag: [0.8e-3, 0.2e-3], ..Machine::default() };
    let [cw, ccw] = lagging.both(0.0, 360.0, 360);
    let told = both(cw, ccw);
    near(value(&told, Term::Servo), 0.6e-3 * FEED, NM);
    near(written(Term::Servo, &told)[0].1, 0.6, 1e-4);
    near(value(&told, Term::Squareness), 0.0, NM);
}

#[test]
fn all_errors_of_a_machine_are_found_together() {
    let machine = machine();
    for samples in [72, 360, 1501] {
        let [cw, ccw] = machine.both(0.0, 360.0, samples);
        let told = both(cw, ccw);
        near(value(&told, Term::Scale), 42e-6 * R, 2.0 * NM);
        near(value(&told, Term::Squareness), 25e-6 * R, 2.0 * NM);
        near(value(&told, Term::Servo), 0.3e-3 * FEED, 2.0 * NM);
        near(value(&told, Term::Centre(Axis::First)), 0.006, 2.0 * NM);
        near(value(&told, Term::Centre(Axis::Second)), -0.004, 2.0 * NM);
        near(value(&told, Term::Radius), -0.003 + 9e-6 * R, 2.0 * NM);
        near(value(&told, end(Axis::First, true)), 0.005, 3.0 * NM);
        near(value(&told, end(Axis::First, false)), 0.003, 3.0 * NM);
        near(value(&told, end(Axis::Second, true)), 0.002, 3.0 * NM);
        near(value(&told, end(Axis::Second, false)), 0.002, 3.0 * NM);
    }
}

#[test]
fn one_direction_tells_squareness_and_servo_mismatch_together() {
    let machine = machine();
    for (direction, way) in [(Direction::Counterclockwise, 1.0), (Direction::Clockwise, -1.0)] {
        let path = trace(machine.read(direction, degrees(0.0, 360.0, 720)));
        let told = figures(match direction {
            Direction::Counterclockwise => Traces::Counterclockwise(path),
            Direction::Clockwise => Traces::Clockwise(path),
        });
        assert!(told.both.is_none());
        for term in [Term::Squareness, Term::Servo] {
            assert_eq!(effect(&told, term), Err(Undetermined::OneDirection));
        }
        // −γR/2 ± F (tx − ty)/2 of sin 2a, as squareness.
        near(value(&told, Term::SquarenessAndServo), 25e-6 * R - way * 0.3e-3 * FEED, 3.0 * NM);
        near(value(&told, Term::Scale), 42e-6 * R, 3.0 * NM);
        near(value(&told, end(Axis::First, true)), 0.005, 4.0 * NM);
        near(value(&told, end(Axis::Second, true)), 0.002, 4.0 * NM);
    }
}

#[test]
fn lost_motion_is_a_step_outwards() {
    let machine = Machine { lost: [None, Some(|_| 0.006)], ..Machine::default() };
    let path = machine.read(Direction::Counterclockwise, [89.9f64, 90.1].map(f64::to_radians));
    near(path[1].1 - path[0].1, 0.006, 1e-7);
    let [cw, ccw] = machine.both(0.0, 360.0, 360);
    near(value(&both(cw.clone(), ccw.clone()), end(Axis::Second, true)), 0.006, NM);
    // Paths with each other's names: what is lost turns into what is too much.
    near(value(&both(ccw, cw), end(Axis::Second, true)), -0.006, NM);
}

#[test]
fn a_vertical_plane_has_an_arc_of_220_degrees() {
    let machine = Machine { lost: [Some(|_| 0.004), Some(|_| 0.002)], ..machine() };
    let [cw, ccw] = machine.both(-20.0, 200.0, 440);
    let told = both(cw, ccw);
    near(value(&told, Term::Scale), 42e-6 * R, 10.0 * NM);
    near(value(&told, Term::Squareness), 25e-6 * R, 10.0 * NM);
    near(value(&told, Term::Centre(Axis::Second)), -0.004, 10.0 * NM);
    near(value(&told, end(Axis::First, true)), 0.004, 10.0 * NM);
    near(value(&told, end(Axis::Second, true)), 0.002, 10.0 * NM);
    let missed = effect(&told, end(Axis::Second, false));
    assert!(matches!(missed, Err(Undetermined::NoReversal { .. })), "{missed:?}");
    assert!(told.effects.iter().filter(|effect| effect.estimate.is_err()).count() == 1);
    assert!(told.spikes.iter().filter(|spike| spike.height.is_err()).count() == 2);
}

#[test]
fn a_short_arc_says_what_it_does_not_determine() {
    let machine = machine();
    // No reversal on it, and what is left is nearly alike.
    let [cw, ccw] = machine.both(0.5, 90.5, 360);
    let told = both(cw, ccw);
    for term in [Term::Squareness, Term::Radius, Term::Centre(Axis::First), Term::Centre(Axis::Second)] {
        let times = match effect(&told, term) {
            Err(Undetermined::Arc { times }) => times,
            other => panic!("{term:?}: {other:?}"),
        };
        assert!(times > 30.0);
    }
    // Half a circle still tells squareness, and by which part of it stands in the uncertainty.
    let noisy = Machine { noise: Some((0.0005, 1)), ..Machine::default() };
    let [[cw, ccw], [whole_cw, whole_ccw]] = [noisy.both(0.0, 180.0, 360), noisy.both(0.0, 360.0, 360)];
    let (half, whole) = (both(cw, ccw), both(whole_cw, whole_ccw));
    let u = |told: &super::Circular, term| effect(told, term).unwrap().u95;
    assert!(u(&half, Term::Squareness) > 1.5 * u(&whole, Term::Squareness));
    assert!(u(&half, Term::Radius) > 5.0 * u(&whole, Term::Radius));
}

#[test]
fn eight_readings_are_too_few_for_ten_figures() {
    let path = || degrees(0.0, 360.0, 8).into_iter().map(|a| (a, 0.001)).collect::<Vec<_>>();
    let told = figures(Traces::Clockwise(trace(path())));
    assert!(told.scatter.is_none());
    assert!(told.effects.iter().all(|effect| effect.estimate.is_err()));
    assert!(told.spikes.iter().all(|spike| spike.height == Err(Undetermined::Samples)));
}

#[test]
fn four_samples_a_turn_confound() {
    // Only at 45°, 135°, …, many times over, and four more: squareness is a lag there, but the radius is told.
    let angles = (0..12).flat_map(|_| (0..4).map(|k| (45.0 + 90.0 * f64::from(k)).to_radians()));
    let more = (0..4).map(|k| (46.0 + 90.0 * f64::from(k)).to_radians());
    let path: Vec<_> = angles.chain(more).map(|a| (a, 0.001)).collect();
    let told = both(path.clone(), path);
    assert!(told.effects.iter().any(|effect| effect.estimate.is_err()), "{:?}", told.effects);
    near(value(&told, Term::Centre(Axis::First)), 0.0, NM);
}

#[test]
fn the_interval_holds_the_truth_as_often_as_it_says() {
    for (from, to) in [(0.0, 360.0), (-20.0, 200.0)] {
        let mut held = [0; 4];
        let terms = [Term::Squareness, Term::Scale, end(Axis::First, true), Term::Centre(Axis::Second)];
        let draws = 400;
        for seed in 0..draws {
            let machine = Machine { square: 20e-6, noise: Some((0.001, seed)), ..Machine::default() };
            let [cw, ccw] = machine.both(from, to, 180);
            let told = both(cw, ccw);
            for ((term, truth), held) in terms.iter().zip([20e-6 * R, 0.0, 0.0, 0.0]).zip(&mut held) {
                let estimate = effect(&told, *term).unwrap();
                *held += u64::from((estimate.value - truth).abs() <= estimate.u95);
            }
        }
        // 380 expected, four standard deviations either way.
        held.iter().for_each(|held| assert!((362..=397).contains(held), "{held:?} of {draws}"));
    }
}

#[test]
fn what_the_model_does_not_have_widens_the_interval() {
    let wave = |a: f64| 0.002 * (5.0 * a).cos();
    let machine = Machine { square: 20e-6, noise: Some((0.0002, 3)), ..Machine::default() };
    let with = |path: Vec<(f64, f64)>| path.into_iter().map(|(a, d)| (a, d + wave(a))).collect::<Vec<_>>();
    let [cw, ccw] = machine.both(0.0, 360.0, 720);
    let (plain, waved) = (both(cw.clone(), ccw.clone()), both(with(cw), with(ccw)));
    let u = |told: &super::Circular| effect(told, Term::Squareness).unwrap().u95;
    assert!(plain.scatter.unwrap().alike == 1.0 && waved.scatter.unwrap().alike > 10.0);
    assert!(u(&waved) > 20.0 * u(&plain));
    near(value(&waved, Term::Squareness), 20e-6 * R, u(&waved));
}

#[test]
fn spikes_are_found_where_they_are_and_not_elsewhere() {
    let at = [(0.0, 0.008), (FRAC_PI_2, -0.005), (2.0 * FRAC_PI_2, 0.003)];
    let machine = Machine { spikes: at.to_vec(), noise: Some((0.0003, 9)), ..machine() };
    let [cw, ccw] = machine.both(0.0, 360.0, 1440);
    let told = both(cw, ccw);
    assert_eq!(told.spikes.len(), 8);
    for Spike { reversal, direction, height } in &told.spikes {
        let height = height.unwrap();
        match at.iter().find(|(angle, _)| (angle - reversal.angle()).abs() < 1e-9) {
            Some((angle, truth)) => {
                assert!(height.stands_out());
                // The top is 1.5° on; the next samples to it are an eighth of a degree off.
                near(height.height, truth * (1.0 - 0.125 / 1.5), 0.0005);
                let on = direction.sign() * (height.angle - angle).to_degrees();
                near((on + 180.0).rem_euclid(360.0) - 180.0, 1.5, 0.5);
            }
            None => assert!(!height.stands_out(), "{reversal:?} {height:?}"),
        }
    }
    // They take no part in the others.
    near(value(&told, end(Axis::First, true)), 0.005, 0.0002);
    near(value(&told, Term::Squareness), 25e-6 * R, 0.0002);
}
