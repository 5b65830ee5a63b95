//! What a reading, a weight and a missing table do to the estimate.

use super::{ESTIMATORS, Set, TILTING, relative};
use trunnion::data::Unit;
use trunnion::study::{ErrorLimits, Estimator, Fit, Instrument, Observation, Warning, fit, report};

#[test]
fn sensitivity_is_what_a_moved_reading_does() {
    let mut set = Set::read("full");
    set.observations[1].weight = 2.5;
    let by = 1e-3;
    for (estimator, key) in ESTIMATORS {
        let whole = set.fit(estimator);
        for x in [30f64, 150.0, 300.0].map(f64::to_radians) {
            let value = |f: &Fit| f.function(&set.setup, set.eps_xa(), x).0;
            let sensitivity = whole.sensitivity(&set.setup, &set.observations, set.eps_xa(), x);
            let largest = sensitivity.observations().flatten().fold(0.0f64, |m, w| m.max(w.abs()));
            for (o, sensitivity) in sensitivity.observations().enumerate() {
                assert_eq!(sensitivity.len(), set.observations[o].samples.len());
                for i in (0..360).step_by(45) {
                    let moved = fit(&set.setup, &set.moved(o, i, by), estimator).unwrap();
                    let difference = (value(&moved) - value(&whole)) / by;
                    let off = (difference - sensitivity[i]).abs();
                    assert!(off < 1e-8 * largest, "{key}, run {o}, sample {i}: {difference} {}", sensitivity[i]);
                }
            }
        }
    }
}

#[test]
fn a_runs_weight_counts_as_so_many_copies_of_its_samples() {
    let set = Set::read("full");
    let doubled = |run: usize, copies: bool| {
        let mut observations = set.observations.clone();
        if copies {
            observations[run].samples.extend(set.observations[run].samples.clone());
        } else {
            observations[run].weight = 2.0;
        }
        observations
    };
    let values = |o: &[Observation], estimator| fit(&set.setup, o, estimator).unwrap().values;
    for (estimator, key) in ESTIMATORS {
        let equal = values(&set.observations, estimator);
        for run in 0..2 {
            let (weighted, copied) = (values(&doubled(run, false), estimator), values(&doubled(run, true), estimator));
            let off = weighted.iter().zip(&copied).map(|(a, b)| relative(*a, *b)).fold(0.0, f64::max);
            assert!(off < 1e-8, "{key}, run {run}: {off:e}");
            let moved = weighted.iter().zip(&equal).map(|(a, b)| relative(*a, *b)).fold(0.0, f64::max);
            // Weights only matter between runs of one step.
            assert_eq!(moved > 1e-6, estimator == Estimator::Joint, "{key}, run {run}: {moved:e}");
        }
    }
}

#[test]
fn the_cost_of_no_table_is_what_the_worst_table_does() {
    let mut set = Set::read("full");
    for s in &mut set.observations[TILTING].samples {
        s.known = vec![0.0; 2];
    }
    for (estimator, key) in ESTIMATORS {
        let whole = set.fit(estimator);
        let said =
            report(&set.setup, &set.observations, &whole, ErrorLimits::PAPER, &Instrument::default(), true).unwrap();
        let costs: Vec<(&str, f64)> = said
            .warnings
            .iter()
            .filter_map(|w| match w {
                Warning::TakenAsZero { known, unit, costs } => {
                    assert_eq!(
                        (*unit, costs[0].0.as_str(), costs[0].1, costs.len()),
                        (Unit::Um, "eps_xa", Unit::Urad, 1)
                    );
                    Some((known.as_str(), costs[0].2))
                }
                _ => None,
            })
            .collect();
        assert_eq!(costs.iter().map(|(n, _)| *n).collect::<Vec<_>>(), ["dya", "dza"], "{key}");
        for (at, (name, cost)) in costs.into_iter().enumerate() {
            // A table of ±1 µm whose signs follow those of the readings' influence on one angle; the factors of (7) are
            // −sin a for δya and cos a for δza.
            let change = |x: f64| {
                let sensitivity = whole.sensitivity(&set.setup, &set.observations, set.eps_xa(), x);
                let mut observations = set.observations.clone();
                for (s, w) in
                    observations[TILTING].samples.iter_mut().zip(sensitivity.observations().nth(TILTING).unwrap())
                {
                    let factor = [-s.sweep.sin(), s.sweep.cos()][at];
                    s.known[at] = 1e-3 * (w * factor).signum();
                }
                let other = fit(&set.setup, &observations, estimator).unwrap();
                let value = |f: &Fit| f.function(&set.setup, set.eps_xa(), x).0;
                (value(&other) - value(&whole)).abs() * 1e6
            };
            let largest = (0..72).map(|i| change(f64::from(i * 5).to_radians())).fold(0.0, f64::max);
            println!("{key}: 1 µm of {name} says {cost:.3} µrad, does {largest:.3} µrad");
            assert!(relative(cost, largest) < 0.01, "{key}, {name}: {cost} against {largest}");
        }
    }
}
