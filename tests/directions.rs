//! Runs measured in both directions and several times: all readings are data, the hysteresis is told.

use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use std::fmt::Write;
use trunnion::data;
use trunnion::study::{ErrorLimits, Estimator, Instrument, Report, Setup, Simulation, fit, report};
use trunnion_codegen::ids::RunId;

/// By how much readings differ between the directions, mm: half of it up, half of it down.
const HYSTERESIS: f64 = 1.6e-3;

fn setup() -> Setup {
    Setup::from_catalogue("tilting-table-b", &[]).unwrap()
}

/// The lines of a run from a simulation, up or down, with half of the hysteresis added or taken off.
fn lines(setup: &Setup, seed: u64, run: RunId, down: bool) -> Vec<String> {
    let simulation =
        Simulation { seed, samples: 280, noise_um: 0.1, limits: ErrorLimits::PAPER, range_deg: (-30.0, 110.0) };
    let half = if down { -HYSTERESIS / 2.0 } else { HYSTERESIS / 2.0 };
    let line = |s: &trunnion::study::Sample| format!("{},{}\n", s.sweep.to_degrees(), (s.reading + half) * 1e3);
    let mut lines: Vec<String> = simulation.measure(setup).observations[run].samples.iter().map(line).collect();
    if down {
        lines.reverse();
    }
    lines
}

fn reported(setup: &Setup, files: &[(String, String)]) -> Report {
    let directory = tempfile::tempdir().unwrap();
    let written: Vec<(String, std::path::PathBuf)> = files
        .iter()
        .enumerate()
        .map(|(i, (run, text))| {
            let path = directory.path().join(format!("{i}.csv"));
            std::fs::write(&path, format!("b_deg,dr_um\n{text}")).unwrap();
            (run.clone(), path)
        })
        .collect();
    let given: Vec<(&str, &std::path::Path)> = written.iter().map(|(run, p)| (run.as_str(), p.as_path())).collect();
    let observations = data::observations(setup, &given, None).unwrap();
    let fitted = fit(setup, &observations, Estimator::Joint).unwrap();
    report(setup, &observations, &fitted, ErrorLimits::PAPER, &Instrument::default(), false).unwrap()
}

fn values(report: &Report) -> Vec<f64> {
    report.functions[0].points.iter().map(|p| p.value).collect()
}

#[test]
fn both_directions_are_data_and_their_hysteresis_is_told() {
    let setup = setup();
    let (mut apart, mut together) = (Vec::new(), Vec::new());
    for (id, run) in setup.model.runs.iter_enumerated() {
        let [up, down] = [false, true].map(|down| lines(&setup, 4, id, down).concat());
        apart.push((run.name.clone(), up.clone()));
        apart.push((run.name.clone(), down.clone()));
        // Forth and back in one file: every angle twice.
        together.push((run.name.clone(), up + &down));
    }
    let (apart, together) = (reported(&setup, &apart), reported(&setup, &together));
    let names: Vec<&str> = apart.runs.iter().take(2).map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["b-radial-far/1", "b-radial-far/2"]);
    for report in [&apart, &together] {
        assert_eq!(report.hysteresis.len(), setup.model.runs.len());
        for h in &report.hysteresis {
            // The noise of both is the same draw: what is left of it is where a turn changes its direction.
            assert!((h.mean - HYSTERESIS).abs() < 2e-5, "{h:?}");
            assert!((h.largest - HYSTERESIS).abs() < 2.5e-4, "{h:?}");
        }
    }
    let worst = values(&apart).iter().zip(values(&together)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-6, "{worst}");
    // The mean of both directions has no hysteresis: the function is that of the machine without.
    let plain: Vec<(String, String)> = setup
        .model
        .runs
        .iter_enumerated()
        .map(|(id, run)| (run.name.clone(), lines(&setup, 4, id, false).concat()))
        .collect();
    // Lines in no order have no direction.
    let shuffled: Vec<(String, String)> = plain
        .iter()
        .map(|(run, text)| {
            let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
            lines.shuffle(&mut ChaCha8Rng::seed_from_u64(1));
            (run.clone(), lines.concat())
        })
        .collect();
    assert!(reported(&setup, &shuffled).hysteresis.is_empty());
    let plain = reported(&setup, &plain);
    assert!(plain.hysteresis.is_empty());
    let mut said = String::new();
    writeln!(said, "{apart}").unwrap();
    assert!(said.contains("circular hysteresis H = "), "{said}");
    let worst = values(&apart).iter().zip(values(&plain)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // A constant of either direction is one of the bar's length, which all runs have: the function does not move.
    assert!(worst < 0.05, "{worst} µrad");
}
