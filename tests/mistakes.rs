//! Each usual mistake, made on ten drawn machines, is noticed and named; clean data raise no alarm.

use rayon::prelude::*;
use std::f64::consts::TAU;
use trunnion::study::{
    ErrorLimits, Estimator, Instrument, Mistake, Observation, Report, Sample, Setup, Simulation, Warning, fit, report,
};

const SAMPLES: usize = 360;

fn measured(setup: &Setup, seed: u64) -> Vec<Observation> {
    let simulation =
        Simulation { seed, samples: SAMPLES, noise_um: 0.1, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) };
    simulation.measure(setup).observations.raw
}

fn reported(setup: &Setup, observations: &[Observation]) -> Report {
    let fitted = fit(setup, observations, Estimator::Joint).unwrap();
    report(setup, observations, &fitted, ErrorLimits::PAPER, &Instrument::default(), false).unwrap()
}

/// Whether the report says that residuals are no noise, and the mistake that it names.
fn told(report: &Report) -> Option<Option<Mistake>> {
    report.warnings.iter().find_map(|warning| match warning {
        Warning::Misfit(misfit) => Some(misfit.mistake.clone()),
        _ => None,
    })
}

fn run(setup: &Setup, at: usize) -> String {
    setup.model.runs.raw[at].name.clone()
}

/// A mistake made, and whether what is named is it.
type Case = (&'static str, fn(&Setup, &mut Vec<Observation>), fn(&Setup, &Mistake) -> bool);

fn cases() -> Vec<Case> {
    vec![
        (
            "runs swapped",
            |_, o| {
                let readings: Vec<f64> = o[0].samples.iter().map(|s| s.reading).collect();
                let others: Vec<f64> = o[1].samples.iter().map(|s| s.reading).collect();
                o[0].samples.iter_mut().zip(others).for_each(|(s, reading)| s.reading = reading);
                o[1].samples.iter_mut().zip(readings).for_each(|(s, reading)| s.reading = reading);
            },
            |setup, m| *m == Mistake::Swapped(run(setup, 0), run(setup, 1)),
        ),
        (
            "direction mirrored",
            |_, o| o.iter_mut().flat_map(|o| &mut o.samples).for_each(|s| s.sweep = TAU - s.sweep),
            |_, m| *m == Mistake::Mirrored(None),
        ),
        (
            "mm called µm",
            |_, o| o[0].samples.iter_mut().for_each(|s| s.reading *= 1e-3),
            |setup, m| *m == Mistake::Unit(run(setup, 0), 1e3),
        ),
        (
            "angle shifted",
            |_, o| o[0].samples.iter_mut().for_each(|s| s.sweep += 0.35),
            |setup, m| matches!(m, Mistake::Shifted(Some(name), by) if *name == run(setup, 0) && (by + 0.35).abs() < 0.02),
        ),
        (
            "feed-in arcs left in",
            |_, o| {
                let n = o[0].samples.len();
                let arc = |i: usize| 0.3 * (1.0 - (i.min(n - 1 - i) as f64 / 6.0)).max(0.0);
                o[0].samples.iter_mut().enumerate().for_each(|(i, s)| s.reading += arc(i));
            },
            |_, m| matches!(m, Mistake::FeedIn { .. }),
        ),
        (
            "a spike",
            |_, o| o[1].samples[217].reading += 4e-3,
            |setup, m| {
                let at = |s: &Sample| s.sweep;
                let expected = at(&measured(setup, 1)[1].samples[217]);
                matches!(m, Mistake::Spikes(all) if matches!(all.as_slice(), [(name, sweep)]
                    if *name == run(setup, 1) && (sweep - expected).abs() < 1e-9))
            },
        ),
    ]
}

#[test]
fn the_usual_mistakes_are_noticed_and_named() {
    for name in ["tilting-table-a", "rotary-table-c"] {
        let setup = Setup::from_catalogue(name, &[]).unwrap();
        for (mistake, make, is_it) in cases() {
            let one = |seed: u64| {
                let mut observations = measured(&setup, seed);
                make(&setup, &mut observations);
                let told = told(&reported(&setup, &observations));
                let named = told.as_ref().is_some_and(|m| m.as_ref().is_some_and(|m| is_it(&setup, m)));
                if !named {
                    println!("  {name}, {mistake}, machine {seed}: {told:?}");
                }
                (told.is_some(), named)
            };
            let found: Vec<(bool, bool)> = (1..=10).into_par_iter().map(one).collect();
            let noticed = found.iter().filter(|(noticed, _)| *noticed).count();
            let named = found.iter().filter(|(_, named)| *named).count();
            println!("{name}, {mistake}: noticed {noticed}, named {named}");
            assert_eq!(noticed, 10, "{name}: {mistake}");
            assert!(named >= 9, "{name}: {mistake}: {named}");
        }
    }
}

#[test]
fn clean_data_raise_no_alarm() {
    let mut alarms = 0;
    for (name, machines) in [("tilting-table-a", 180_u64), ("rotary-table-c", 20)] {
        let setup = Setup::from_catalogue(name, &[]).unwrap();
        let alarm = |seed: &u64| told(&reported(&setup, &measured(&setup, *seed))).is_some();
        alarms += (1..=machines).into_par_iter().filter(alarm).count();
    }
    println!("{alarms} of 200");
    assert!(alarms <= 2, "{alarms}");
}

#[test]
fn residuals_are_held_against_the_stated_noise() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let observations = measured(&setup, 3);
    let fitted = fit(&setup, &observations, Estimator::Joint).unwrap();
    let said = |noise_um: f64| {
        let instrument = Instrument { noise: noise_um * 1e-3 / 3f64.sqrt(), ..Instrument::default() };
        told(&report(&setup, &observations, &fitted, ErrorLimits::PAPER, &instrument, false).unwrap()).is_some()
    };
    assert!(!said(0.1) && !said(0.2) && said(0.04));
}
