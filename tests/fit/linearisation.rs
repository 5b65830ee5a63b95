//! What linearisation leaves stays within its bound.

use super::{ESTIMATORS, Set, number, relative};
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use trunnion::study::{ErrorLimits, Population, grid, neglected};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::measurement::ExactReading;
use typed_index_collections::TiVec;

#[test]
fn without_noise_what_is_left_is_linearisations_and_within_its_bound() {
    let set = Set::read("exact");
    let truth = set.truth["eps_xa"].as_array().unwrap();
    for (estimator, key) in ESTIMATORS {
        let (report, curve) = set.report(estimator);
        let left = |p: &trunnion::study::CurvePoint| {
            // It has the multiples of 5°, not where the last sample is.
            let truth = truth.iter().find(|t| (number(&t["a_deg"]) - p.at).abs() < 1e-9)?;
            Some((p.value - number(&truth["urad"])).abs())
        };
        let largest = curve.points.iter().filter_map(left).fold(0.0, f64::max);
        println!("{key}: {largest:.3} µrad left, at most {:.3} by the bound", curve.neglected);
        assert!(largest > 1e-3, "linearisation leaves something");
        assert!(largest <= curve.neglected, "{key}: {largest} > {}", curve.neglected);
        for ((run, _, rms), bound) in report.runs.iter().zip(&report.neglected) {
            println!("{key}, {run}: rms {rms:.6} µm, at most {bound:.3} µm");
            assert!(rms <= bound);
        }
    }
}

#[test]
fn no_drawn_machine_is_further_from_linear_than_the_bound() {
    let set = Set::read("full");
    let sweeps = grid(90, (0.0, std::f64::consts::TAU));
    let exact: TiVec<RunId, ExactReading> =
        set.setup.model.runs.keys().map(|run| set.setup.exact(run, &sweeps)).collect();
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut closest = 0.0f64;
    let machines = Population::new(&set.setup, &exact, ErrorLimits::PAPER);
    for _ in 0..100 {
        let machine = machines.draw(&mut random);
        let base = machine.base(&set.setup);
        for (run, exact) in exact.iter_enumerated() {
            let bound = neglected(&set.setup, run, &sweeps, ErrorLimits::PAPER).unwrap().bound;
            let known = set.setup.true_known(run, exact, &machine);
            let clean: Vec<f64> = exact.values(&machine).collect();
            let mut row = set.setup.row(run);
            for (i, &a) in sweeps.iter().enumerate() {
                let (regressors, factors) = row.at(a, 1.0);
                let names = &set.setup.derivation.runs[run].regressors;
                let linear: f64 = regressors.iter().zip(names).map(|(x, (b, _))| x * base[*b]).sum();
                let given: f64 = factors.iter().zip(known.get(i).into_iter().flatten()).map(|(f, k)| f * k).sum();
                closest = closest.max((clean[i] - linear - given).abs() / bound[i]);
            }
        }
    }
    println!("at most {closest:.3} of the bound");
    // Third-order terms are a ten-thousandth of these; something must come near, or the bound says nothing.
    assert!((0.05..1.0).contains(&closest), "{closest}");
}

#[test]
fn the_bound_is_of_second_order() {
    let set = Set::read("exact");
    for o in &set.observations {
        let sweeps: Vec<f64> = o.samples.iter().map(|s| s.sweep).collect();
        let largest =
            |length, angle| neglected(&set.setup, o.run, &sweeps, ErrorLimits { length, angle }).unwrap().largest();
        assert_eq!(largest(0.0, 0.0), 0.0);
        assert!(relative(largest(0.015, 5e-5) * 4.0, largest(0.03, 1e-4)) < 1e-12);
    }
}
