//! Every model of the catalogue recovers what was put into its exact simulation; predictions are what happens.

use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;
use trunnion::study::plan::{Intended, additions, predict, subset};
use trunnion::study::{
    ErrorLimits, Estimator, Fit, Observation, Population, Setup, SimulatedMachine, Variance, Weights, fit, fit_with,
    grid, neglected, systematic,
};
use trunnion_codegen::catalogue::{self, MODELS};
use trunnion_codegen::identify::{Extent, derive};
use trunnion_codegen::ids::{FunctionId, ParameterId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::model::{Draft, read_draft};
use trunnion_solver::lstsq::student_t_95;
use typed_index_collections::TiVec;

/// A model whose zero functions are zero: none has a limit of its own.
fn setup(name: &str) -> Setup {
    let draft = Draft { limits: Vec::new(), ..read_draft(catalogue::source(name).unwrap()).unwrap() };
    let model = draft.build().unwrap();
    let all = [("R", 150.0), ("L", 200.0), ("H", 120.0)];
    let own: Vec<(&str, f64)> = all.into_iter().filter(|(n, _)| model.alphabet.find_constant(n).is_some()).collect();
    Setup::new(model, &own).unwrap()
}

/// The paper's limits made smaller: what linearisation leaves shrinks with the square.
fn limits(factor: f64) -> ErrorLimits {
    ErrorLimits { length: ErrorLimits::PAPER.length * factor, angle: ErrorLimits::PAPER.angle * factor }
}

struct Simulated {
    machine: SimulatedMachine,
    observations: Vec<Observation>,
}

fn simulate(setup: &Setup, samples: usize, limits: ErrorLimits, random: &mut ChaCha8Rng) -> Simulated {
    let sweeps = grid(samples, (0.0, TAU));
    let exact: TiVec<RunId, ExactReading> = setup.model.runs.keys().map(|r| setup.exact(r, &sweeps)).collect();
    let machine = Population::new(setup, &exact, limits).draw(random);
    let observe = |(run, exact)| setup.observe(run, exact, &sweeps, &machine, || 0.0);
    let observations = exact.iter_enumerated().map(observe).collect();
    Simulated { machine, observations }
}

/// What an estimated function is as the runs see it, and whether that is the function itself.
fn seen(setup: &Setup, machine: &SimulatedMachine, estimate: &Fit, function: FunctionId, x: f64) -> (f64, bool) {
    let seen = estimate.seen(function).unwrap();
    (seen.truth(setup, &machine.base(setup), x), seen.extent() == Extent::Determined)
}

#[test]
fn every_model_recovers_its_exact_simulation() {
    let small = limits(1e-4);
    for (name, source) in MODELS {
        // What is taken as exact is none of that on a drawn machine; what is zero is, without a limit of its own.
        let draft = Draft { assume: Vec::new(), limits: Vec::new(), ..read_draft(source).unwrap() };
        let setup = Setup::new(draft.build().unwrap(), &[]).unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let Simulated { machine, observations } = simulate(&setup, 180, small, &mut random);
        let estimate = fit(&setup, &observations, Estimator::Joint).unwrap();
        let bounds: Vec<Vec<f64>> = observations
            .iter()
            .map(|o| {
                let sweeps: Vec<f64> = o.samples.iter().map(|s| s.sweep).collect();
                neglected(&setup, o.run, &sweeps, small).unwrap().bound
            })
            .collect();
        // A reading is the difference of two lengths of some 300 mm.
        let rounding = 2e-13;
        let left = |sensitivity: Weights| -> f64 {
            let pairs = sensitivity.observations().flatten().zip(bounds.iter().flatten());
            pairs.map(|(w, b)| w.abs() * (b + rounding)).sum()
        };
        let truth = machine.base(&setup);
        let mut closest = 0.0f64;
        for (i, &b) in estimate.base.iter().enumerate() {
            let off = (estimate.values[i] - truth[b]).abs();
            let bound = left(estimate.coefficient_sensitivity(&setup, &observations, b));
            closest = closest.max(off / bound);
            assert!(off <= bound, "{name}, {}: {off:e} > {bound:e}", setup.derivation.base[b].name);
        }
        for f in setup.estimated() {
            let error = setup.model.functions[f].error;
            let size = small.of(setup.model.alphabet.error_quantity(error));
            let mut largest = 0.0f64;
            for x in grid(36, (0.0, TAU)) {
                let (value, _) = estimate.function(&setup, f, x);
                let (truth, alone) = seen(&setup, &machine, &estimate, f, x);
                if alone {
                    assert!(
                        (truth - machine.value(error, x)).abs() < 1e-9 * size,
                        "{name}: the function itself is seen"
                    );
                }
                largest = largest.max((value - truth).abs() / size);
            }
            println!("{name}, {}: {largest:.1e} of its limit", setup.function_name(f));
            // Found: 3e-5 at most.
            assert!(largest < 1e-3, "{name}, {}: {largest}", setup.function_name(f));
        }
        println!("{name}: at most {closest:.3} of what linearisation leaves");
    }
}

#[test]
fn bands_hold_the_truth_as_often_as_they_say() {
    let small = limits(1e-4);
    for (name, _) in MODELS {
        let setup = setup(name);
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let clean = simulate(&setup, 90, small, &mut random);
        let truth = clean.machine.base(&setup);
        let (mut inside, mut all) = (0u32, 0u32);
        for _ in 0..40 {
            let mut noisy = clean.observations.clone();
            for s in noisy.iter_mut().flat_map(|o| &mut o.samples) {
                s.reading += random.random_range(-1.0..=1.0) * 1e-4;
            }
            let estimate = fit(&setup, &noisy, Estimator::Joint).unwrap();
            let t = student_t_95::<f64>(estimate.degrees_of_freedom);
            for (i, &b) in estimate.base.iter().enumerate() {
                let off = (estimate.values[i] - truth[b]).abs();
                inside += u32::from(off <= t * estimate.covariance[(i, i)].sqrt());
                all += 1;
            }
        }
        let share = f64::from(inside) / f64::from(all);
        println!("{name}: {share:.3} of {all} inside");
        // Coefficients of one fit go together: 40 fits say it to some 2 %.
        assert!((0.90..0.99).contains(&share), "{name}: {share}");
    }
}

#[test]
fn predicted_deviations_are_those_of_many_measurements() {
    let setup = setup("tilting-table-a");
    let half_width = 1e-4;
    let intended = Intended { samples: 120, range: (0.0, TAU), sigma: half_width / 3f64.sqrt() };
    let sweeps = grid(intended.samples, intended.range);
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let prediction = predict(&setup, intended, estimator).unwrap();
        let at = prediction.functions[0].largest.unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let count = prediction.base.len();
        let mut squares = vec![0.0; count + 1];
        let trials = 2000;
        for _ in 0..trials {
            let mut observations: Vec<Observation> =
                setup.model.runs.keys().map(|run| Observation::zero(&setup, run, &sweeps)).collect();
            for s in observations.iter_mut().flat_map(|o| &mut o.samples) {
                s.reading = random.random_range(-half_width..=half_width);
            }
            let estimate = fit(&setup, &observations, estimator).unwrap();
            squares.iter_mut().zip(estimate.values.iter()).for_each(|(s, v)| *s += v * v);
            squares[count] += estimate.function(&setup, prediction.functions[0].function, at.at).0.powi(2);
        }
        let predicted = prediction.base.iter().map(|(_, std)| *std).chain([at.std]);
        for (i, (predicted, square)) in predicted.zip(&squares).enumerate() {
            let empirical = (square / f64::from(trials)).sqrt();
            let ratio = empirical / predicted;
            println!("{estimator:?} {i}: {predicted:.3e}, ratio {ratio:.3}");
            assert!((ratio - 1.0).abs() < 0.05, "{estimator:?} {i}: {ratio}");
        }
        // A known deviation scales the band; it does not move with the residuals.
        let zero: Vec<Observation> =
            setup.model.runs.keys().map(|run| Observation::zero(&setup, run, &sweeps)).collect();
        let twice = fit_with(&setup, &zero, estimator, Variance::Known(2.0 * intended.sigma)).unwrap();
        let std = twice.function(&setup, prediction.functions[0].function, at.at).1;
        assert!((std / at.std - 2.0).abs() < 1e-12);
    }
}

#[test]
fn what_linearisation_leaves_is_as_large_as_said() {
    let setup = setup("tilting-table-a");
    let function = setup.estimated().next().unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let points = grid(72, (0.0, TAU));
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let one = simulate(&setup, 90, ErrorLimits::PAPER, &mut random);
        let estimate = fit(&setup, &one.observations, estimator).unwrap();
        let seen = estimate.seen(function).unwrap();
        let left = systematic(&setup, &one.observations, &estimate, seen, ErrorLimits::PAPER, &points).unwrap();
        let bound: f64 = left.terms.iter().map(|t| t.bound).sum();
        let error = setup.model.functions[function].error;
        let (mut square, mut largest) = (0.0, 0.0f64);
        let trials = 1500;
        for _ in 0..trials {
            let drawn = simulate(&setup, 90, ErrorLimits::PAPER, &mut random);
            let value = fit(&setup, &drawn.observations, estimator).unwrap().function(&setup, function, left.at).0;
            let off = value - drawn.machine.value(error, left.at);
            square += off * off;
            largest = largest.max(off.abs());
        }
        let ratio = (square / f64::from(trials)).sqrt() / left.typical;
        println!(
            "{estimator:?}: {:.3} µrad rms at {:.0}°, found {ratio:.3} of it; largest {:.2}, bound {:.1}; {:?}",
            left.typical * 1e6,
            left.at.to_degrees(),
            largest * 1e6,
            bound * 1e6,
            left.terms.iter().take(4).map(|t| &t.name).collect::<Vec<_>>()
        );
        // Two means of squares with heavy tails, of 400 and of 1500 machines.
        assert!((ratio - 1.0).abs() < 0.15, "{estimator:?}: {ratio}");
        assert!(largest <= bound, "{largest} > {bound}");
        assert!(left.terms.iter().all(|t| t.typical <= t.bound + 1e-9 * left.typical));
        assert!(left.terms.windows(2).all(|w| w[0].typical >= w[1].typical));
    }
}

#[test]
fn fewer_runs_are_the_same_machine_with_less_to_see() {
    let whole = catalogue::model("tilting-table-a").unwrap().unwrap();
    let [tilting, separation] = [0, 1].map(RunId::from);
    let rank = |runs: &[RunId]| derive(&subset(&whole, runs).unwrap()).unwrap().rank();
    assert_eq!((rank(&[tilting, separation]), rank(&[tilting]), rank(&[separation])), (11, 8, 8));
    // Only the second run: what the order names of the first is gone, the rest is kept.
    let second = subset(&whole, &[separation]).unwrap();
    assert!(second.order.iter().all(|t| t.value != "o_ya") && second.order.iter().any(|t| t.value == "d_yz2"));
}

#[test]
fn an_added_run_separates_what_the_exact_kernel_says() {
    let source = catalogue::source("tilting-table-a").unwrap();
    let mut draft = read_draft(source).unwrap();
    draft.runs.retain(|r| r.name.value == "tilting");
    draft.order.clear();
    draft.name = "one-run".into();
    let model = draft.build().unwrap();
    let derivation = derive(&model).unwrap();
    let dyz = catalogue::source("tilting-table-a-dyz").unwrap();
    let (tried, found) =
        additions(&draft, &model, &derivation, &[("tilting-table-a", source), ("tilting-table-a-dyz", dyz)]);
    assert_eq!(tried, 4);
    let of = |run: &str, kept: bool| found.iter().find(|a| a.run == run && a.ball_kept == kept);
    let name = |j: &ParameterId| derivation.parameters[*j].name.as_str();
    let separation = of("separation", false).unwrap();
    let determined: Vec<&str> = separation.determines.iter().map(name).collect();
    println!("{found:?}");
    // k11 = d_zz1 and k5 = d_yy1 − d_zz1 of the two runs together.
    assert!(determined.contains(&"d_zz1") && determined.contains(&"d_yy1"), "{determined:?}");
    // The whole rank of the paper's two runs is 11 with the tool ball left in place; 8 of it the first run sees, and two
    // of what is new (k9, k10) hold the new ball's set-up.
    assert_eq!(separation.gain, 1);
    // Of the directions it separates only the one that holds d_zz1; the others still change no reading.
    let parts: Vec<&str> =
        separation.separates.iter().flat_map(|&i| &derivation.kernel[i]).map(|(j, _)| name(j)).collect();
    assert!(separation.separates.len() == 1 && parts.contains(&"d_zz1"), "{parts:?}");
    // The run the machine has already tells nothing.
    assert!(of("tilting", true).is_none());
    let finds = |run| of(run, false).map(|a| a.finds.clone());
    assert_eq!(finds("along-y"), Some(vec!["d_ya".to_owned()]));
    assert_eq!(finds("along-z"), Some(vec!["d_za".to_owned()]));
}
