//! A report and its parts as one JSON object, for a program.

use serde_json::{Map, Value, json};
use trunnion::study::{Contribution, Curve, CurvePoint, Report, Spread, Study};

/// One object: model, estimator, runs, coefficients, functions, condition, warnings.
pub fn report(report: &Report, radius_mm: f64) -> Value {
    let runs = report.runs.iter().zip(&report.neglected).map(|((name, samples, rms), neglected)| {
        (name.clone(), json!({ "samples": samples, "rms_um": rms, "neglected_um": neglected }))
    });
    let coefficients = report.coefficients.iter();
    let coefficients = coefficients.map(|c| json!({ "name": c.name, "value": c.value, "std": c.std, "unit": c.unit }));
    json!({
        "model": report.model,
        "estimator": report.estimator.to_string(),
        "radius_mm": radius_mm,
        "runs": runs.collect::<Map<_, _>>(),
        "coefficients": coefficients.collect::<Vec<_>>(),
        "functions": report.functions.iter().map(curve).collect::<Vec<_>>(),
        "condition": report.condition,
        "warnings": report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn curve(c: &Curve) -> Value {
    let key = format!("{}_{}", c.coordinate, c.coordinate_unit);
    let point = |p: &CurvePoint| {
        let pairs = [(key.clone(), p.at), ("value".to_owned(), p.value), ("u95".to_owned(), p.u95)];
        Value::Object(pairs.map(|(k, v)| (k, Value::from(v))).into_iter().collect())
    };
    json!({
        "name": c.name,
        "unit": c.unit.suffix(),
        "points": c.points.iter().map(point).collect::<Vec<_>>(),
        "neglected": c.neglected,
        "neglected_typical": c.neglected_typical,
        "neglected_terms": c.neglected_terms.iter().map(contribution).collect::<Vec<_>>(),
    })
}

fn contribution(c: &Contribution) -> Value {
    json!({ "errors": c.name, "typical": c.typical, "bound": c.bound })
}

/// The distributions of one function with one estimator.
pub fn study(study: &Study) -> Value {
    let spread = |x: &Spread| json!({ "mean": x.mean, "median": x.median, "p95": x.p95, "max": x.max });
    json!({
        "function": study.function,
        "estimator": study.estimator.to_string(),
        "largest_error": {
            "noise": spread(&study.noise),
            "linearisation": spread(&study.linearisation),
            "both": spread(&study.both),
        },
    })
}
