//! Both estimators on the reference sets, against `high_precision/solutions.json` (made by the script beside it) and
//! against themselves: the streaming solver, what is said beside the numbers, what is refused.

mod influence;
mod linearisation;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use trunnion::data::{Known, Quantity, Radius, Sweep, Table};
use trunnion::study::{
    Curve, ErrorLimits, EstimateError, Estimator, Fit, Instrument, Observation, Report, Sample, Setup, Warning, fit,
    report,
};
use trunnion_codegen::catalogue;
use trunnion_codegen::ids::FunctionId;
use trunnion_solver::lstsq::student_t_95;
use trunnion_solver::tilting::{Estimate, Joint, Lengths, TwoStep};

const ESTIMATORS: [(Estimator, &str); 2] = [(Estimator::Joint, "joint"), (Estimator::TwoStep, "two-step")];
/// The place of the tilting run among the observations.
const TILTING: usize = 0;

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(path)
}

fn json(path: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(file(path)).unwrap()).unwrap()
}

/// A decimal string or a number.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

struct Set {
    setup: Setup,
    observations: Vec<Observation>,
    truth: Value,
}

impl Set {
    fn read(name: &str) -> Self {
        let truth = json(&format!("reference/tilting-table/{name}/truth.json"));
        let mm = truth["radius_mm"].as_f64().unwrap();
        let setup = Setup::new(catalogue::model("tilting-table-a").unwrap().unwrap(), &[("R", mm)]).unwrap();
        let path = |f: &str| file(&format!("reference/tilting-table/{name}/{f}.csv"));
        let lengths = ["dya", "dza"].map(|name| Known { name: name.into(), quantity: Quantity::Length });
        let table = Table::read(&path("table"), "a", &lengths).unwrap();
        let observe = |name: &str| {
            let sweep = Sweep::read(&path(name), "a", Radius::new(mm).unwrap(), 11).unwrap();
            let known = |at: usize| match name == "tilting" {
                true => table.at(sweep.samples()[at].angle_rad).unwrap().values,
                false => Vec::new(),
            };
            let samples = sweep.samples().iter().enumerate();
            let samples = samples
                .map(|(i, s)| Sample {
                    sweep: s.angle_rad,
                    direction: 1.0,
                    reading: s.reading_mm,
                    known: known(i),
                    known_std: Vec::new(),
                })
                .collect();
            Observation { run: setup.run(name).unwrap(), weight: 1.0, samples }
        };
        let observations = ["tilting", "separation"].map(observe).into();
        Self { setup, observations, truth }
    }

    fn eps_xa(&self) -> FunctionId {
        self.setup.estimated().next().unwrap()
    }

    fn fit(&self, estimator: Estimator) -> Fit {
        fit(&self.setup, &self.observations, estimator).unwrap()
    }

    fn report(&self, estimator: Estimator) -> (Report, Curve) {
        let report = report(
            &self.setup,
            &self.observations,
            &self.fit(estimator),
            ErrorLimits::PAPER,
            &Instrument::default(),
            false,
        )
        .unwrap();
        let curve = report.functions[0].clone();
        (report, curve)
    }

    /// The observations with one reading moved.
    fn moved(&self, observation: usize, sample: usize, by: f64) -> Vec<Observation> {
        let mut observations = self.observations.clone();
        observations[observation].samples[sample].reading += by;
        observations
    }
}

fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / b.abs()
}

#[test]
fn the_fit_is_the_least_squares_solution() {
    let solutions = json("high_precision/solutions.json");
    for name in ["full", "r100", "arc220", "exact", "arc90"] {
        let set = Set::read(name);
        for (estimator, key) in ESTIMATORS {
            let expected = &solutions[name][key];
            let (report, curve) = set.report(estimator);
            let degrees = u64::from(set.fit(estimator).degrees_of_freedom);
            assert_eq!(degrees, expected["degrees_of_freedom"].as_u64().unwrap(), "{name}, {key}");
            let points = expected["eps_xa_urad"].as_array().unwrap();
            // They have the multiples of 5°, not where the last sample is.
            let marks: Vec<_> = curve.points.iter().filter(|p| p.at % 5.0 == 0.0).collect();
            assert_eq!(marks.len(), points.len(), "{name}, {key}");
            let (mut value, mut u95, mut coefficients, mut std) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
            for (p, e) in marks.into_iter().zip(points) {
                assert!((p.at - e["a_deg"].as_f64().unwrap()).abs() < 1e-12);
                value = value.max((p.value - number(&e["value"])).abs());
                // At 0° and 360° the function and its band are zero but for rounding.
                if number(&e["u95"]) > 1e-9 {
                    let band = student_t_95::<f64>(set.fit(estimator).degrees_of_freedom) * p.noise_std;
                    u95 = u95.max(relative(band, number(&e["u95"])));
                }
            }
            let expected = expected["coefficients"].as_array().unwrap();
            assert_eq!(report.coefficients.len(), expected.len());
            for (c, e) in report.coefficients.iter().zip(expected) {
                assert_eq!(c.name, e["name"].as_str().unwrap());
                // Of a coefficient near zero the digits that count are those of its standard deviation.
                let scale = number(&e["value"]).abs().max(number(&e["std"]));
                coefficients = coefficients.max((c.value - number(&e["value"])).abs() / scale);
                std = std.max(relative(c.noise_std, number(&e["std"])));
            }
            println!(
                "{name:7} {key:9} eps_xa {value:.1e} µrad; relative: band {u95:.1e}, coefficients {coefficients:.1e}, std {std:.1e}"
            );
            // Reached: 7e-13 µrad and 2e-13 (arc90, with condition 37,000: 2e-10 µrad); the rest is left to other machines.
            let limit = if name == "arc90" { 1e-8 } else { 1e-10 };
            assert!(value < limit, "{name}, {key}: {value:e} µrad");
            assert!(u95 < 1e-9 && coefficients < 1e-9 && std < 1e-9, "{name}, {key}: {u95:e} {coefficients:e} {std:e}");
        }
    }
}

#[test]
fn an_arc_too_short_is_warned_of_by_name() {
    let named = |set: &str, estimator| {
        let (report, _) = Set::read(set).report(estimator);
        report.warnings.into_iter().find_map(|w| match w {
            Warning::HardlySeparated { names, condition, whole_turn: false } => Some((names, condition)),
            _ => None,
        })
    };
    for (estimator, key) in ESTIMATORS {
        let (names, condition) = named("arc90", estimator).unwrap();
        println!("arc90, {key}: condition {condition:.0}: {names:?}");
        assert!(names.len() >= 2 && names.iter().all(|n| n.starts_with('k') || n.starts_with("e_xa")), "{names:?}");
        for set in ["full", "r100", "arc220"] {
            assert_eq!(named(set, estimator), None, "{set}");
        }
    }
}

#[test]
fn the_embedded_solver_gives_the_same_as_the_study() {
    let set = Set::read("full");
    let (bar, bar_f32) = (Lengths { r: 150.0f64 }, Lengths { r: 150.0f32 });
    let (mut joint, mut two_step) = (Joint::new(bar).unwrap(), TwoStep::new(bar).unwrap());
    let (mut joint_f32, mut two_step_f32) = (Joint::new(bar_f32).unwrap(), TwoStep::new(bar_f32).unwrap());
    let short = |x: &f64| *x as f32;
    for o in &set.observations {
        for s in &o.samples {
            let (a, y) = (short(&s.sweep), short(&s.reading));
            if let [dya, dza] = s.known[..] {
                joint.push_tilting(s.sweep, s.reading, dya, dza).unwrap();
                two_step.push_tilting(s.sweep, s.reading, dya, dza).unwrap();
                joint_f32.push_tilting(a, y, short(&dya), short(&dza)).unwrap();
                two_step_f32.push_tilting(a, y, short(&dya), short(&dza)).unwrap();
            } else {
                joint.push_separation(s.sweep, s.reading).unwrap();
                two_step.push_separation(s.sweep, s.reading).unwrap();
                joint_f32.push_separation(a, y).unwrap();
                two_step_f32.push_separation(a, y).unwrap();
            }
        }
    }
    let (joint, two_step) = (joint.solve().unwrap(), two_step.solve().unwrap());
    let (joint_f32, two_step_f32) = (joint_f32.solve().unwrap(), two_step_f32.solve().unwrap());
    let point = |estimate: &Estimate<f64>, a: f64| {
        let (value, std) = estimate.e_xa(a).unwrap();
        [value, std, student_t_95::<f64>(estimate.solution.degrees_of_freedom) * std]
    };
    let streamed: [&dyn Fn(f64) -> [f64; 3]; 2] = [&|a| point(&joint, a), &|a| point(&two_step, a)];
    let streamed_f32: [&dyn Fn(f32) -> (f32, f32); 2] =
        [&|a| joint_f32.e_xa(a).unwrap(), &|a| two_step_f32.e_xa(a).unwrap()];
    for (((estimator, key), streamed), streamed_f32) in ESTIMATORS.into_iter().zip(streamed).zip(streamed_f32) {
        let whole = set.fit(estimator);
        let (_, curve) = set.report(estimator);
        let t = student_t_95::<f64>(whole.degrees_of_freedom);
        let (mut f64s, mut f32s) = (0.0f64, 0.0f64);
        for point in &curve.points {
            let a = point.at.to_radians();
            let (value, std) = whole.function(&set.setup, set.eps_xa(), a);
            let [v, s, band] = streamed(a);
            let differences = [(v - value) * 1e6, (s - std) * 1e6, band * 1e6 - t * point.noise_std];
            f64s = differences.iter().fold(f64s, |m, d| m.max(d.abs()));
            let (v, s) = streamed_f32(a as f32);
            f32s = f32s.max((f64::from(v) - value).abs() * 1e6).max((f64::from(s) - std).abs() * 1e6);
        }
        println!("{key}: f64 {f64s:.1e} µrad, f32 {f32s:.1e} µrad");
        assert!(f64s < 1e-9, "{key}: {f64s:e} µrad");
        assert!(f32s < 0.01, "{key}: {f32s:e} µrad in f32");
    }
}

#[test]
fn what_no_fit_can_use_is_refused() {
    let set = Set::read("full");
    let refused = |change: &dyn Fn(&mut Vec<Observation>), estimator| {
        let mut observations = set.observations.clone();
        change(&mut observations);
        fit(&set.setup, &observations, estimator).unwrap_err()
    };
    let few = |o: &mut Vec<Observation>| o.iter_mut().for_each(|o| o.samples.truncate(5));
    let one_angle =
        |o: &mut Vec<Observation>| o.iter_mut().for_each(|o| o.samples.iter_mut().for_each(|s| s.sweep = 1.0));
    let nan = |o: &mut Vec<Observation>| o[0].samples[3].reading = f64::NAN;
    let huge = |o: &mut Vec<Observation>| o[1].samples[3].reading = 1e300;
    for (estimator, key) in ESTIMATORS {
        assert!(matches!(refused(&few, estimator), EstimateError::TooFewSamples { .. }), "{key}");
        match refused(&one_angle, estimator) {
            EstimateError::Confounded { coefficients, .. } => {
                assert!(coefficients.len() >= 2, "{key}: {coefficients:?}")
            }
            other => panic!("{key}: {other:?}"),
        }
        assert_eq!(refused(&nan, estimator), EstimateError::NotFinite, "{key}");
        assert_eq!(refused(&huge, estimator), EstimateError::NotFinite, "{key}");
    }
    let only_tilting = |o: &mut Vec<Observation>| o.truncate(1);
    assert_eq!(refused(&only_tilting, Estimator::TwoStep), EstimateError::NoFirstStep);
}
