//! What moves with the feed and not with the geometry: put into the exact simulation, found again, and kept out of the geometry.

use trunnion::study::{ErrorLimits, Estimator, Fit, Instrument, Report, Setup, Simulated, Simulation, fit, report};
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::model::{Draft, Text, read_draft};

const MACHINES: u64 = 8;
/// Models, the runs that have terms, and the terms.
const CASES: [(&str, &[&str], &[&str]); 3] = [
    ("tilting-table-a", &["tilting", "separation"], &["backlash Y", "backlash Z", "mismatch"]),
    ("rotary-table-c", &[], &["backlash X", "lateral play EYX", "mismatch"]),
    ("tilting-table-b", &[], &["backlash X", "mismatch"]),
];

fn simulation(seed: u64) -> Simulation {
    let limits = ErrorLimits::PAPER;
    Simulation { seed, samples: 360, noise_um: 0.1, limits, range_deg: (0.0, 360.0) }
}

fn draft(name: &str) -> Draft {
    read_draft(trunnion_codegen::catalogue::source(name).unwrap()).unwrap()
}

/// The model of the catalogue with terms in the runs that can have them.
fn with_terms(name: &str, runs: &[&str], terms: &[&str]) -> Setup {
    let mut draft = draft(name);
    for at in 0..draft.runs.len() {
        if runs.is_empty() || runs.contains(&draft.runs[at].name.value.as_str()) {
            draft.runs[at].nuisance = terms.iter().map(|term| Text::from(*term)).collect();
            if draft.build().is_err() {
                draft.runs[at].nuisance.clear();
            }
        }
    }
    assert!(draft.runs.iter().any(|run| !run.nuisance.is_empty()), "{name}");
    Setup::new(draft.build().unwrap(), &[]).unwrap()
}

fn reported(setup: &Setup, simulated: &Simulated) -> Report {
    let observations = &simulated.observations.raw;
    let fitted = fit(setup, observations, Estimator::Joint).unwrap();
    report(setup, observations, &fitted, ErrorLimits::PAPER, &Instrument::default(), false).unwrap()
}

/// Of every point of every function: how far it is from the truth, its expanded uncertainty, and how far `other` is.
fn off(setup: &Setup, simulated: &Simulated, report: &Report, other: &Fit) -> Vec<[f64; 3]> {
    let mut off = Vec::new();
    for (function, curve) in setup.estimated().collect::<Vec<FunctionId>>().into_iter().zip(&report.functions) {
        let error = setup.model.functions[function].error;
        for p in curve.points.iter().filter(|p| p.u95 > 0.0) {
            let at = curve.coordinate_unit.to_inner(p.at);
            let truth = curve.unit.from_inner(simulated.machine.value(error, at));
            let other = curve.unit.from_inner(other.function(setup, function, at).0);
            off.push([(p.value - truth).abs(), p.u95, (other - truth).abs()]);
        }
    }
    off
}

/// The share that is within its uncertainty.
fn share(off: &[[f64; 3]]) -> f64 {
    off.iter().filter(|[off, u95, _]| off <= u95).count() as f64 / off.len() as f64
}

#[test]
fn terms_are_recovered_and_the_geometry_is_unharmed() {
    for (name, runs, terms) in CASES {
        let (setup, plain) = (with_terms(name, runs, terms), Setup::from_catalogue(name, &[]).unwrap());
        let largest = |r: &Report| r.functions.iter().flat_map(|f| &f.points).map(|p| p.u95).fold(0.0, f64::max);
        let clean = largest(&reported(&plain, &simulation(0).measure(&plain)));
        let (mut parameters, mut points, mut price) = (Vec::new(), Vec::new(), 0.0f64);
        for seed in 0..MACHINES {
            let simulated = simulation(seed).measure(&setup);
            let report = reported(&setup, &simulated);
            let truth = simulated.machine.base(&setup);
            for (base, c) in setup.derivation.base.iter_enumerated().zip(&report.coefficients).map(|((b, _), c)| (b, c))
            {
                let is_term = ["backlash", "play", "mismatch"].iter().any(|kind| c.name.starts_with(kind));
                if is_term {
                    assert!(c.u95 < 2e-3, "{name}: {} ± {}", c.name, c.u95);
                    parameters.push([(c.value - truth[base]).abs(), c.u95, 0.0]);
                }
            }
            // One direction of the same readings, without the terms.
            let mut one_way = simulated.observations.raw.clone();
            one_way.iter_mut().for_each(|o| o.samples.truncate(360));
            points.extend(off(&setup, &simulated, &report, &fit(&plain, &one_way, Estimator::Joint).unwrap()));
            price = price.max(largest(&report) / clean);
        }
        let (found, geometry) = (share(&parameters), share(&points));
        let sum = |at: usize| points.iter().map(|off| off[at]).sum::<f64>();
        let harm = sum(2) / sum(0);
        println!(
            "{name}: {found:.3} of the terms and {geometry:.3} of the geometry within ±, which grows {price:.2}-fold; without \
             the terms the geometry is {harm:.1} times as far off"
        );
        assert!(found >= 0.9 && geometry >= 0.9, "{name}: {found} {geometry}");
        assert!(harm > 3.0, "{name}: {harm}, nothing was to be kept out");
        assert!(price < 1.5, "{name}: {price}");
    }
}

#[test]
fn a_direction_that_nobody_knows_is_told() {
    let setup = with_terms("tilting-table-a", &["tilting"], &["backlash A", "mismatch"]);
    let simulated = simulation(1).measure(&setup);
    let mut observations = simulated.observations.raw;
    let half = observations[0].samples.len() / 2;
    // One way only: a backlash of A is a constant, like the ball's place.
    observations[0].samples.truncate(half);
    let refused = fit(&setup, &observations, Estimator::Joint).unwrap_err().to_string();
    assert!(refused.contains("backlash_A_tilting") && refused.contains("in both directions"), "{refused}");
    observations[0].samples.iter_mut().for_each(|s| s.direction = 0.0);
    let refused = fit(&setup, &observations, Estimator::Joint).unwrap_err().to_string();
    assert!(refused.starts_with("tilting: the samples go up and down in no order"), "{refused}");
}
