//! Inputs that once came out wrong, each the smallest of its kind, with the values of an independent exact model.

use trunnion::study::{ErrorLimits, Simulation, fit};
use trunnion::{Estimator, Setup};

/// Two runs of the second step, of which one does not see what the first step gives: the standard deviation was 8.319e-7. That
/// any such runs are right is held to brute force in the solver's `tests/two_step.rs`.
#[test]
fn a_second_step_run_that_does_not_see_a_given_coefficient() {
    let model = include_str!("faults/two-step-gain/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0)]).unwrap();
    let simulation =
        Simulation { seed: 3, samples: 72, noise_um: 0.2, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) };
    let observations = simulation.measure(&setup).observations.raw;
    let fitted = fit(&setup, &observations, Estimator::TwoStep).unwrap();
    let place = fitted.base.iter().position(|&b| setup.derivation.base[b].name == "EAA_cos1").unwrap();
    let std = fitted.covariance[(place, place)].sqrt();
    assert!((std / 5.534e-7 - 1.0).abs() < 2e-4, "{std:e}");
}
