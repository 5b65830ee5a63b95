//! What a factor's fit says is what a fit of its samples says, as far as sums of constant size can tell it.

use trunnion::Setup;
use trunnion::document;
use trunnion::study::{
    Curve, ErrorLimits, Estimator, Factor, Fit, Instrument, Observation, Report, Sample, Simulation, Variance, Warning,
    fit, report, report_on,
};
use trunnion_codegen::kinematics::directions;
use trunnion_codegen::model::StatedInstrument;

fn measured(samples: u32) -> (Setup, Vec<Observation>) {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let simulation = Simulation {
        seed: 5,
        samples: samples as usize,
        noise_um: 0.1,
        limits: ErrorLimits::PAPER,
        range_deg: (0.0, 360.0),
    };
    let observations = simulation.measure(&setup).observations.raw;
    (setup, observations)
}

fn instrument() -> Instrument {
    Instrument::of(&StatedInstrument::preset("QC20-W").unwrap())
}

/// Of the samples themselves.
fn whole(setup: &Setup, observations: &[Observation], estimator: Estimator, no_table: bool) -> (Fit, Report) {
    let fit = fit(setup, observations, estimator).unwrap();
    let report = report(setup, observations, &fit, ErrorLimits::PAPER, &instrument(), no_table).unwrap();
    (fit, report)
}

/// Of a factor that is merged of so many pieces of each run and was bytes in between.
fn merged(setup: &Setup, observations: &[Observation], estimator: Estimator, count: usize) -> (Factor, Fit, Report) {
    let mut sum = Factor::new(setup, estimator).unwrap();
    for o in observations.iter().rev() {
        for samples in o.samples.chunks(o.samples.len().div_ceil(count)) {
            let mut part = Factor::new(setup, estimator).unwrap();
            part.push(setup, &Observation { samples: samples.to_vec(), ..o.clone() }).unwrap();
            sum.merge(&Factor::from_bytes(&part.to_bytes()).unwrap()).unwrap();
        }
    }
    let (fit, standing) = sum.solve(setup, Variance::Residual).unwrap();
    let report = report_on(setup, &standing, &fit, ErrorLimits::PAPER, &instrument(), sum.without_table()).unwrap();
    (sum, fit, report)
}

/// The largest share by which any uncertainty of either report differs from the other's.
fn apart(a: &Report, b: &Report) -> f64 {
    let off = |a: f64, b: f64| if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) };
    let of_curve = |(a, b): (&Curve, &Curve)| {
        assert_eq!((&a.name, &a.told, a.unit, a.coordinate_unit), (&b.name, &b.told, b.unit, b.coordinate_unit));
        assert_eq!(a.points.len(), b.points.len(), "{}", a.name);
        let points = a.points.iter().zip(&b.points).map(|(a, b)| off(a.std, b.std).max(off(a.sum_u95, b.sum_u95)));
        points.fold(off(a.neglected, b.neglected), f64::max).max(off(a.neglected_typical, b.neglected_typical))
    };
    assert_eq!(a.functions.len(), b.functions.len());
    let curves = a.functions.iter().zip(&b.functions).map(of_curve);
    let coefficients = a.coefficients.iter().zip(&b.coefficients).map(|(a, b)| {
        assert_eq!((&a.name, &a.definition, &a.unit), (&b.name, &b.definition, &b.unit));
        assert_eq!(a.budget.lines.len(), b.budget.lines.len(), "{}", a.name);
        let own = a;
        let lines = a.budget.lines.iter().zip(&b.budget.lines).map(|(a, b)| {
            assert_eq!(a.source, b.source);
            // What nearly cancels says nothing of itself.
            let counts = a.contribution.std > 0.1 * own.std;
            if counts { off(a.contribution.std, b.contribution.std) } else { 0.0 }
        });
        lines.fold(off(a.u95, b.u95), f64::max)
    });
    let usual = a.neglected_usual.iter().zip(&b.neglected_usual).map(|(a, b)| off(*a, *b));
    curves.chain(coefficients).chain(usual).fold(off(a.condition, b.condition), f64::max)
}

#[test]
fn its_report_is_that_of_the_samples() {
    for (samples, agrees) in [(360, 1e-5), (5000, 1e-2)] {
        let (setup, observations) = measured(samples);
        for estimator in [Estimator::Joint, Estimator::TwoStep] {
            let (expected, of_samples) = whole(&setup, &observations, estimator, false);
            let (_, own, of_factor) = merged(&setup, &observations, estimator, 3);
            let off = apart(&of_factor, &of_samples);
            assert!(off < agrees, "{samples} samples, {estimator}: {off:e}");
            assert_eq!(of_factor.warnings, of_samples.warnings);
            for (a, b) in own.looks.iter().zip(&expected.looks) {
                assert_eq!(a.samples, b.samples);
                assert!((a.rms / b.rms - 1.0).abs() < 1e-9, "{} {}", a.rms, b.rms);
                // Neighbours in two pieces are none.
                assert!((a.correlation - b.correlation).abs() < 2e-2, "{} {}", a.correlation, b.correlation);
                assert_eq!((a.runs, a.deviation), (None, None));
            }
        }
    }
}

#[test]
fn what_only_samples_tell_is_not_made_up() {
    let (setup, observations) = measured(360);
    let (_, fit, of_factor) = merged(&setup, &observations, Estimator::Joint, 1);
    assert!(of_factor.of_factor && of_factor.traces.is_empty() && of_factor.histograms.is_empty());
    let json = document::report(&setup, &of_factor);
    assert!(json["recordings"].is_null() && json["weighed_down"].as_array().unwrap().is_empty());
    assert!(json["functions"][0]["largest"]["monte_carlo"]["u95"].as_f64().unwrap() > 0.0);
    let refused = trunnion::report::fit(&json, &setup, &of_factor).unwrap_err().to_string();
    assert!(refused.contains("which a factor does not keep"), "{refused}");
    assert!(trunnion::report::picture_files(&of_factor).is_ok());
    // A look at the samples is one with the fit, wherever it comes from.
    let residuals = fit.residuals(&setup, &observations[0]);
    let square: f64 = residuals.iter().map(|e| e * e).sum();
    assert!(((square / 360.0).sqrt() / fit.rms[0] - 1.0).abs() < 1e-9);
}

/// A wave that no base parameter explains.
#[test]
fn residuals_that_are_no_noise_are_told_and_make_the_noise_larger() {
    let (setup, mut observations) = measured(360);
    for sample in &mut observations[0].samples {
        sample.reading += 2e-3 * (9.0 * sample.sweep).sin();
    }
    let (expected, of_samples) = whole(&setup, &observations, Estimator::Joint, false);
    let (_, own, of_factor) = merged(&setup, &observations, Estimator::Joint, 1);
    for (a, b) in own.looks.iter().zip(&expected.looks) {
        assert!((a.correlation - b.correlation).abs() < 1e-6, "{} {}", a.correlation, b.correlation);
        assert!((a.alike() / b.alike() - 1.0).abs() < 1e-4, "{} {}", a.alike(), b.alike());
    }
    assert!(expected.looks[0].alike() > 10.0 && apart(&of_factor, &of_samples) < 1e-4);
    let misfit = |report: &Report| {
        let found = report.warnings.iter().find(|warning| matches!(warning, Warning::Misfit(_)));
        found.map(ToString::to_string).unwrap()
    };
    let (told, told_of_factor) = (misfit(&of_samples), misfit(&of_factor));
    assert!(told.contains("no usual mistake explains it"), "{told}");
    let end = "which mistake explains it only a fit of the samples tells, not one of a factor";
    assert!(told_of_factor.ends_with(end), "{told_of_factor}");
    let head = |told: &str| told.split("; ").next().unwrap().to_owned();
    assert_eq!(head(&told_of_factor), head(&told));
}

#[test]
fn both_directions_and_tables_are_kept() {
    let (setup, mut observations) = measured(180);
    for o in &mut observations {
        let back: Vec<Sample> = o.samples.iter().rev().cloned().collect();
        o.samples.extend(back);
        let sweeps: Vec<f64> = o.samples.iter().map(|sample| sample.sweep).collect();
        for (sample, direction) in o.samples.iter_mut().zip(directions(&sweeps)) {
            sample.direction = direction;
            sample.reading += 5e-4 * direction;
            sample.known_std = sample.known.iter().map(|_| 2e-4).collect();
        }
    }
    let (_, of_samples) = whole(&setup, &observations, Estimator::Joint, false);
    let (factor, _, of_factor) = merged(&setup, &observations, Estimator::Joint, 1);
    assert!(!factor.without_table() && apart(&of_factor, &of_samples) < 1e-4);
    let pairs = of_factor.hysteresis.iter().zip(&of_samples.hysteresis);
    assert_eq!((of_factor.hysteresis.len(), of_samples.hysteresis.len()), (2, 2));
    for (a, b) in pairs {
        assert_eq!((&a.run, a.samples), (&b.run, b.samples));
        assert!((a.largest - b.largest).abs() < 1e-12 && (a.mean - b.mean).abs() < 1e-12);
    }
    // Without a table what is not known is told, and taken to be in the result.
    observations.iter_mut().flat_map(|o| &mut o.samples).for_each(|sample| {
        sample.known.fill(0.0);
        sample.known_std.clear();
    });
    let (_, of_samples) = whole(&setup, &observations, Estimator::Joint, true);
    let (factor, _, of_factor) = merged(&setup, &observations, Estimator::Joint, 1);
    assert!(factor.without_table() && apart(&of_factor, &of_samples) < 1e-4);
    let taken = |report: &Report| report.warnings.iter().filter(|w| matches!(w, Warning::TakenAsZero { .. })).count();
    assert!(taken(&of_factor) > 0 && taken(&of_factor) == taken(&of_samples));
}

#[test]
fn runs_of_two_weights_are_two_observations() {
    let (setup, observations) = measured(360);
    let mut all = observations.clone();
    all[1].weight = 4.0;
    all.push(observations[1].clone());
    let (_, of_samples) = whole(&setup, &all, Estimator::Joint, false);
    let (_, fit, of_factor) = merged(&setup, &all, Estimator::Joint, 2);
    assert_eq!(fit.looks.len(), 3);
    let names: Vec<&str> = of_factor.runs.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["tilting", "separation/1", "separation/2"]);
    assert!(apart(&of_factor, &of_samples) < 1e-4, "{}", apart(&of_factor, &of_samples));
}
