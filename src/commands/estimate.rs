//! A fit's report as JSON and as text.

use serde_json::{Map, Value, json};
use std::fmt::Write;
use trunnion::data::Unit;
use trunnion::study::{Curve, Estimator, Limits, Report, Setup, Term};

/// Name of an estimator on the command line and in JSON.
pub fn name(estimator: Estimator) -> &'static str {
    match estimator {
        Estimator::Joint => "joint",
        Estimator::TwoStep => "two-step",
    }
}

/// One object: model, estimator, runs, coefficients, functions, condition, warnings.
pub fn json(setup: &Setup, radius: f64, estimator: Estimator, report: &Report) -> Value {
    let runs = report.runs.iter().zip(&report.neglected).map(|((name, samples, rms), neglected)| {
        (name.clone(), json!({ "samples": samples, "rms_um": rms, "neglected_um": neglected }))
    });
    let coefficients = report.coefficients.iter();
    let coefficients = coefficients.map(|c| json!({ "name": c.name, "value": c.value, "std": c.std, "unit": c.unit }));
    json!({
        "model": setup.model.name,
        "estimator": name(estimator),
        "radius_mm": radius,
        "runs": runs.collect::<Map<_, _>>(),
        "coefficients": coefficients.collect::<Vec<_>>(),
        "functions": report.functions.iter().map(curve).collect::<Vec<_>>(),
        "condition": report.condition,
        "warnings": report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn curve(c: &Curve) -> Value {
    let key = format!("{}_{}", c.coordinate, c.coordinate_unit);
    let point = |p: &trunnion::study::Point| {
        let pairs = [(key.clone(), p.at), ("value".to_owned(), p.value), ("u95".to_owned(), p.u95)];
        Value::Object(pairs.map(|(k, v)| (k, Value::from(v))).into_iter().collect())
    };
    json!({
        "name": c.name,
        "unit": c.unit.suffix(),
        "points": c.points.iter().map(point).collect::<Vec<_>>(),
        "neglected": c.neglected,
        "neglected_typical": c.neglected_typical,
        "neglected_terms": c.neglected_terms.iter().map(term).collect::<Vec<_>>(),
    })
}

fn term(t: &Term) -> Value {
    json!({ "errors": t.name, "typical": t.typical, "bound": t.bound })
}

/// The report for reading at a terminal.
pub fn text(setup: &Setup, estimator: Estimator, limits: Limits, report: &Report) -> String {
    let mut out = format!("{}: {} estimate\n", setup.model.name, name(estimator));
    for (name, samples, rms) in &report.runs {
        let _ = writeln!(out, "run {name}: {samples} samples, residuals {rms:.3} µm rms");
    }
    let _ = writeln!(out, "condition {:.1} (columns scaled)", report.condition);
    let round = |x: f64| (x * 1e6).round() / 1e6;
    let (length, angle) = (round(Unit::Um.from_inner(limits.length)), round(Unit::Urad.from_inner(limits.angle)));
    let dropped = report.runs.iter().zip(&report.neglected).map(|((name, ..), n)| format!("{n:.3} µm ({name})"));
    let dropped: Vec<String> = dropped.collect();
    let _ = writeln!(
        out,
        "linearisation drops at most {} with errors within {length} µm and {angle} µrad",
        dropped.join(", ")
    );
    let _ = writeln!(out, "\nbase parameters");
    let width = report.coefficients.iter().map(|c| c.name.len()).max().unwrap_or(0);
    for c in &report.coefficients {
        let _ = writeln!(out, "  {:width$} {:>14.6e} ± {:<10.2e} {}", c.name, c.value, c.std, c.unit);
    }
    for c in &report.functions {
        let _ = writeln!(
            out,
            "\n{} ({}), 95 % band of the fit; linearisation adds typically {:.2} (rms), at most {:.1}",
            c.name, c.unit, c.neglected_typical, c.neglected
        );
        let terms = c.neglected_terms.iter().take(5).map(|t| format!("{} {:.2}", t.name, t.typical));
        let terms: Vec<String> = terms.collect();
        if !terms.is_empty() {
            let _ = writeln!(out, "  most of it from {}", terms.join(", "));
        }
        let every = c.points.len().div_ceil(25).max(1);
        for p in c.points.iter().step_by(every) {
            let _ = writeln!(
                out,
                "  {} = {:>6.1} {}  {:>9.3} ± {:.3}",
                c.coordinate, p.at, c.coordinate_unit, p.value, p.u95
            );
        }
    }
    let _ =
        writeln!(out, "\nThe band holds the noise of these readings; the uncertainty of the instrument is not in it.");
    out
}
