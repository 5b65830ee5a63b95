//! Sums of estimated functions, such as a pin of a control's kinematics: as uncertain as all of it is together.

use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;
use trunnion::study::{
    ErrorLimits, Estimator, Fit, Instrument, Observation, Seen, Setup, Sources, Term, Variance, fit_with,
};

const SIGMA: f64 = 5e-4;
/// Standard uncertainty of what stays from reading to reading, mm.
const CONSTANT: f64 = 4e-4;
/// What the kinematics of a cradle take.
const PINS: [&[(&str, f64)]; 4] =
    [&[("EX0C", 1.0)], &[("EY0A", 1.0), ("EY0C", 1.0)], &[("EZ0A", 1.0)], &[("EY0C", -1.0)]];

fn unread(setup: &Setup) -> Vec<Observation> {
    setup.unread(12, (0.0, TAU))
}

fn sources<'a>(setup: &'a Setup, observations: &'a [Observation], fit: &'a Fit, limits: ErrorLimits) -> Sources<'a> {
    let instrument = Instrument { constant: CONSTANT, ..Instrument::default() };
    Sources::new(setup, observations, fit, limits, &instrument, false)
}

fn seen<'a>(setup: &Setup, fit: &'a Fit, name: &str) -> &'a Seen {
    fit.functions().iter().find(|seen| setup.function_name(seen.function()) == name).unwrap()
}

fn terms<'a>(setup: &Setup, fit: &'a Fit, sum: &[(&str, f64)]) -> Vec<Term<'a>> {
    sum.iter().map(|(name, factor)| Term { factor: *factor, seen: seen(setup, fit, name), at: 0.0 }).collect()
}

/// A normal number: the sum of twelve uniform ones.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| random.random_range(-0.5..0.5)).sum()
}

/// The measurement over and over: every reading with noise of its own, all of one with an error of the instrument that is a constant and
/// four harmonics of the sweep, each with an equal share (docs/model-file.md).
#[test]
fn a_pin_is_as_uncertain_as_its_errors_are_together() {
    let setup = Setup::from_catalogue("ac-trunnion-probe", &[]).unwrap();
    let observations = unread(&setup);
    let fitted = |observations: &[Observation]| {
        fit_with(&setup, observations, Estimator::Joint, Variance::Known(SIGMA)).unwrap()
    };
    let fit = fitted(&observations);
    let nothing = ErrorLimits { length: 1e-9, angle: 1e-9 };
    let sources = sources(&setup, &observations, &fit, nothing);
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let mut squares = [0.0; PINS.len()];
    let trials = 3000;
    for _ in 0..trials {
        let waves: [f64; 9] = std::array::from_fn(|_| CONSTANT / 5f64.sqrt() * normal(&mut random));
        let mut measured = observations.clone();
        for sample in measured.iter_mut().flat_map(|own| &mut own.samples) {
            let harmonic = |k: usize| {
                let (sin, cos) = (k as f64 * sample.sweep).sin_cos();
                waves[2 * k - 1] * cos + waves[2 * k] * sin
            };
            sample.reading = SIGMA * normal(&mut random) + waves[0] + (1..=4).map(harmonic).sum::<f64>();
        }
        let fit = fitted(&measured);
        for (square, sum) in squares.iter_mut().zip(PINS) {
            let value = |(name, factor): &(&str, f64)| {
                factor * fit.function(&setup, seen(&setup, &fit, name).function(), 0.0).0
            };
            *square += sum.iter().map(value).sum::<f64>().powi(2);
        }
    }
    for (square, sum) in squares.iter().zip(PINS) {
        let drawn = (square / f64::from(trials)).sqrt();
        let said = sources.sum(&terms(&setup, &fit, sum)).combined.std;
        let alone = |own: &(&str, f64)| sources.sum(&terms(&setup, &fit, &[*own])).combined.std.powi(2);
        let apart = sum.iter().map(alone).sum::<f64>().sqrt();
        println!("{sum:?}: {said:.3e} mm, drawn {drawn:.3e}, as if nothing were common {apart:.3e}");
        assert!((said / drawn - 1.0).abs() < 0.05, "{sum:?}: {said:e} and not {drawn:e}");
        assert!(sum.len() == 1 || (apart / said - 1.0).abs() > 0.2, "{sum:?}: nothing in common");
    }
}

/// Of every source whose parts add up by squares, u(f + g)² + u(f − g)² = 2 u(f)² + 2 u(g)².
#[test]
fn sums_and_differences_have_the_same_parts() {
    let setup = Setup::from_catalogue("ac-trunnion-probe", &[]).unwrap();
    let observations = unread(&setup);
    let fit = fit_with(&setup, &observations, Estimator::Joint, Variance::Known(SIGMA)).unwrap();
    let sources = sources(&setup, &observations, &fit, ErrorLimits::PAPER);
    let lines = |sum: &[(&str, f64)]| {
        let budget = sources.sum(&terms(&setup, &fit, sum));
        budget.lines.iter().map(|line| line.contribution.std.powi(2)).collect::<Vec<f64>>()
    };
    let (f, g) = (("EY0A", 1.0), ("EY0C", 1.0));
    let [plus, minus, own, other] = [&[f, g][..], &[f, ("EY0C", -1.0)], &[f], &[g]].map(lines);
    assert!(plus.iter().filter(|square| **square > 0.0).count() >= 3, "{plus:?}");
    for (i, plus) in plus.iter().enumerate() {
        let (left, right) = (plus + minus[i], 2.0 * (own[i] + other[i]));
        assert!((left - right).abs() <= 1e-9 * right, "{i}: {left:e} and not {right:e}");
    }
    assert!(lines(&[f, ("EY0A", -1.0)]).iter().all(|square| *square < 1e-24));
}
