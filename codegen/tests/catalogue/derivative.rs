//! The linear reading is the derivative of the exact one at zero errors, for every error of the machine.

use super::numbers::{derived, millimetres, moving_with_the_feed, uniform, value_at};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::kinematics::{ErrorValues, directions};
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::model::Model;

/// One error at a size, all others zero.
struct Only(ErrorId, f64);

impl ErrorValues for Only {
    fn value(&self, error: ErrorId, _: f64) -> f64 {
        if error == self.0 { self.1 } else { 0.0 }
    }
}

/// Fourth-order central difference of every sample's reading; the step suits mm and rad alike.
fn derivative(reading: &ExactReading, error: ErrorId) -> Vec<f64> {
    let h = 1e-3;
    let at = |size: f64| reading.values(&Only(error, size)).collect::<Vec<f64>>();
    let (near, far) = ([at(h), at(-h)], [at(2.0 * h), at(-2.0 * h)]);
    let four = |i: usize| (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * h);
    (0..near[0].len()).map(four).collect()
}

#[test]
fn linear_readings_are_the_derivatives_of_the_exact_ones() {
    for (name, _) in MODELS {
        for (model, derivation) in [derived(name), moving_with_the_feed(name)] {
            check(name, &model, &derivation);
        }
    }
}

/// At sweeps that go up and down again.
fn check(name: &str, model: &Model, derivation: &Derivation) {
    for (i, run) in model.runs.iter_enumerated() {
        let mut sweeps = uniform(usize::from(i) as u64 + 1, -3.2, 3.2, 40);
        sweeps[..20].sort_by(f64::total_cmp);
        sweeps[20..].sort_by(|a, b| b.total_cmp(a));
        let directions = directions(&sweeps);
        let exact = ExactReading::new(model, run, &sweeps, &millimetres);
        let linear = derivation.runs[i].reading.by_errors();
        for (error, symbol, _) in model.alphabet.errors() {
            let coefficient = linear.iter().find(|(m, _)| m.errors().next() == Some(error)).map(|(_, p)| p);
            for ((numeric, &sweep), direction) in derivative(&exact, error).into_iter().zip(&sweeps).zip(&directions) {
                let nominal = |id| value_at(model, id, sweep, *direction);
                let value = coefficient.map_or(0.0, |p| p.evaluate(nominal, |_| 0.0));
                let difference = (value - numeric).abs();
                assert!(
                    difference < 1e-9 * value.abs().max(1.0),
                    "{name}, {}, {symbol} at {sweep}: {value} is not {numeric}",
                    run.name
                );
            }
        }
    }
}
