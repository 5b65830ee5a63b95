//! The linear reading is the derivative of the exact one at zero errors, for every error of the machine.

use super::numbers::{derived, millimetres, uniform};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::algebra::nominal_value;
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;

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
        let (model, derivation) = derived(name);
        for (i, run) in model.runs.iter_enumerated() {
            let sweeps = uniform(usize::from(i) as u64 + 1, -3.2, 3.2, 25);
            let exact = ExactReading::new(&model, run, &sweeps, &millimetres);
            let linear = derivation.runs[i].reading.by_errors();
            for (error, symbol, _) in model.alphabet.errors() {
                let coefficient = linear.iter().find(|(m, _)| m.errors().next() == Some(error)).map(|(_, p)| p);
                for (numeric, &sweep) in derivative(&exact, error).into_iter().zip(&sweeps) {
                    let nominal = |id| nominal_value(id, &model.alphabet, sweep, millimetres);
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
}
