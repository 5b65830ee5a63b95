//! Inputs that once came out wrong, each the smallest of its kind, with the values of an independent exact model.

use trunnion::data::{observations, write_simulation};
use trunnion::study::{ErrorLimits, Simulation, fit, studies};
use trunnion::{Estimator, Setup};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::kinematics::ErrorValues;

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

fn simulation(seed: u64, samples: usize, noise_um: f64) -> Simulation {
    Simulation { seed, samples, noise_um, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) }
}

/// A coefficient lumped with one that another run finds was printed as the sum of both: EXX(−170) = 8.046 µm for 5.554.
#[test]
fn a_later_runs_base_parameters_are_put_in() {
    let model = include_str!("faults/estimate-lumped/exx1.toml");
    let setup = Setup::from_description(model, &[("R", 150.0), ("L", 80.0)]).unwrap();
    let simulated = simulation(1, 90, 0.0).measure(&setup);
    let fitted = fit(&setup, &simulated.observations.raw, Estimator::Joint).unwrap();
    let function = setup.estimated().next().unwrap();
    assert_eq!(fitted.seen(function).unwrap().extent(), Extent::Determined);
    let error = setup.model.functions[function].error;
    for x in [-170.0, -50.0, 120.0] {
        let (value, truth) = (fitted.function(&setup, function, x).0, simulated.machine.value(error, x));
        assert!((value - truth).abs() < 2e-5, "{x}: {value} {truth}");
    }
}

/// Two coaxial tables turned together: of each nothing is determined, and 0.000 ± 0.000 was printed of the second.
#[test]
fn coaxial_tables_are_told_as_a_sum() {
    let model = include_str!("faults/unseen-zero/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0)]).unwrap();
    let simulated = simulation(1, 90, 0.0).measure(&setup);
    let fitted = fit(&setup, &simulated.observations.raw, Estimator::Joint).unwrap();
    let base = simulated.machine.base(&setup);
    assert_eq!(fitted.functions().len(), 2);
    for seen in fitted.functions() {
        let told = seen.told(&setup);
        assert_eq!(told.extent, Extent::UpTo);
        assert!(told.up_to.len() >= 4 && told.sum.unwrap().contains("EC"), "{}", told.words);
        for x in [0.3, 2.0, 5.0] {
            let (value, sum) = (fitted.function(&setup, seen.function(), x).0, seen.truth(&setup, &base, x));
            assert!(sum.abs() > 1e-6 && (value - sum).abs() < 2e-6, "{value} {sum}");
        }
    }
}

/// A table at rest that shares its location with runs in which it moves: EAA was 88.6 µrad off.
#[test]
fn a_resting_axis_that_shares_its_location_keeps_it() {
    let truth = |name: &str, a: f64| match name {
        "ECC" => 40e-6 * a.cos() - 25e-6 * (2.0 * a).sin(),
        _ => 10e-6 * a - 1e-6 * a * a,
    };
    for model in
        [include_str!("faults/rest-shared-location/model.toml"), include_str!("faults/rest-shared-location/zero.toml")]
    {
        let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0), ("H", 80.0)]).unwrap();
        let runs = ["c-axial", "cone-z", "cone-x", "cone-y"];
        let file =
            |run: &str| format!("{}/tests/faults/rest-shared-location/data/{run}.csv", env!("CARGO_MANIFEST_DIR"));
        let files = runs.map(|run| (run, file(run)));
        let observations = observations(&setup, &files.each_ref().map(|(run, file)| (*run, file)), None).unwrap();
        let fitted = fit(&setup, &observations, Estimator::Joint).unwrap();
        for function in setup.estimated() {
            let name = setup.function_name(function);
            for a in [0.5, 2.0, 4.0, 6.0] {
                let off = fitted.function(&setup, function, a).0 - truth(&name, a);
                assert!(off.abs() < 0.3e-6, "{name} at {a}: {off:e}");
            }
        }
    }
}

/// A geared axis' function was compared with the truth at the sweep: the noise had a mean of 391.9 µrad for 14.3.
#[test]
fn a_function_is_compared_where_its_axis_goes() {
    let model = include_str!("faults/monte-carlo-coordinate/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("G", 50.0)]).unwrap();
    let draws = simulation(1, 90, 0.1).draws(400);
    let studies = studies(&setup, draws, &[Estimator::Joint], &|| ()).unwrap();
    let noise = studies[0].errors.unwrap().noise.mean;
    assert!((noise / 14.3 - 1.0).abs() < 0.1, "{noise}");
}

/// The files of a simulation: a linear axis over mm, a geared one over its own angle, all known functions, no run overwritten.
#[test]
fn simulated_files_say_what_they_hold() {
    let written = |model: &str, lengths: &[(&str, f64)]| {
        let setup = Setup::from_description(model, lengths).unwrap();
        let simulation = simulation(1, 36, 0.1);
        let directory = tempfile::tempdir().unwrap();
        let result = write_simulation(&setup, &simulation, &simulation.measure(&setup), directory.path());
        (result, directory)
    };
    let truth = |directory: &tempfile::TempDir| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(directory.path().join("truth.json")).unwrap()).unwrap()
    };
    let (_, linear) = written(include_str!("faults/truth-linear/exx1.toml"), &[("R", 150.0), ("L", 80.0)]);
    let points = truth(&linear)["EXX"].as_array().unwrap().clone();
    assert!(points.len() == 21 && (points[0]["x_mm"].as_f64().unwrap() + 170.0).abs() < 0.2);
    let (_, geared) = written(include_str!("faults/truth-coordinate/model.toml"), &[("L", 150.0)]);
    let truth = truth(&geared);
    assert!(truth["EXX"][0]["x_mm"].is_f64());
    assert_eq!(truth["ECC"][0]["c_deg"].as_f64().unwrap(), -360.0);
    let (_, two) = written(include_str!("faults/two-known/model.toml"), &[("R", 100.0), ("L", 150.0)]);
    let table = std::fs::read_to_string(two.path().join("table.csv")).unwrap();
    assert!(["EYA_um", "EZA_um", "EXC_um", "EYC_um"].iter().all(|c| table.lines().next().unwrap().contains(c)));
    let (result, kept) = written(include_str!("faults/run-named-table/table.toml"), &[("R", 100.0), ("L", 150.0)]);
    assert!(result.unwrap_err().to_string().contains("holds the known functions"));
    assert!(!kept.path().join("table.csv").exists());
}
