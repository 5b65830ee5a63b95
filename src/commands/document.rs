//! A report and its parts as one JSON object, for a program.

use serde_json::{Map, Value, json};
use trunnion::study::{
    Budget, COVERAGE, Contribution, Curve, CurvePoint, Line, MachineErrors, Report, Spread, Study, Told,
};
use trunnion_codegen::emit::equations::Remaining;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::quantity::Unit;

/// One object: model, estimator, runs, coefficients, functions, condition, warnings.
pub fn report(report: &Report, radius_mm: Option<f64>) -> Value {
    let dropped = report.neglected.iter().zip(&report.neglected_usual);
    let runs = report.runs.iter().zip(dropped).map(|((name, samples, rms), (neglected, usual))| {
        let run = json!({ "samples": samples, "rms_um": rms, "neglected_um": neglected, "neglected_usual_um": usual });
        (name.clone(), run)
    });
    let coefficients = report.coefficients.iter();
    let coefficients = coefficients.map(|c| json!({ "name": c.name, "definition": c.definition, "value": c.value, "noise_std": c.noise_std, "std": c.std, "u95": c.u95, "unit": c.unit, "budget": budget(&c.budget) }));
    json!({
        "model": report.model,
        "estimator": report.estimator.to_string(),
        "radius_mm": radius_mm,
        "runs": runs.collect::<Map<_, _>>(),
        "coefficients": coefficients.collect::<Vec<_>>(),
        "functions": report.functions.iter().map(curve).collect::<Vec<_>>(),
        "weighed_down": report.weighed_down.iter().map(|(run, down)| json!({
            "run": run,
            "samples": down.samples,
            "scale_um": Unit::Um.from_inner(down.scale),
            "most": down.most.iter().map(|(at, w)| json!({ "at_deg": at.to_degrees(), "weight": w })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "hysteresis": report.hysteresis.iter().map(|h| json!({
            "run": h.run,
            "samples": h.samples,
            "largest_um": Unit::Um.from_inner(h.largest),
            "at_deg": h.at.to_degrees(),
            "mean_um": Unit::Um.from_inner(h.mean),
        })).collect::<Vec<_>>(),
        "condition": report.condition,
        "warnings": report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn curve(c: &Curve) -> Value {
    let key = format!("{}_{}", c.coordinate, c.coordinate_unit);
    let point = |p: &CurvePoint| {
        let pairs = [
            (key.as_str(), p.at),
            ("value", p.value),
            ("noise_std", p.noise_std),
            ("std", p.std),
            ("u95", p.u95),
            ("sum_u95", p.sum_u95),
        ];
        Value::Object(pairs.map(|(k, v)| (k.to_owned(), Value::from(v))).into_iter().collect())
    };
    let object = json!({
        "name": c.name,
        "unit": c.unit.suffix(),
        "points": c.points.iter().map(point).collect::<Vec<_>>(),
        "largest": c.largest.as_ref().map(|(at, b)| json!({ key.clone(): at, "budget": budget(b) })),
        "neglected": c.neglected,
        "neglected_typical": c.neglected_typical,
        "neglected_terms": c.neglected_terms.iter().map(contribution).collect::<Vec<_>>(),
    });
    with_told(object, &c.told)
}

/// An object that has numbers of a function, with what they are of: `determined`, `value_of` (the function, the sum it is
/// seen in, or null) and `up_to`, what stands between the two.
pub fn with_told(mut object: Value, told: &Told) -> Value {
    let remaining = |r: &Remaining| json!({ "term": r.term, "parameter": r.parameter, "factor": r.factor });
    object["determined"] = json!(told.extent == Extent::Determined);
    object["extent"] = json!(told.words);
    object["value_of"] = json!(told.sum);
    object["up_to"] = json!(told.up_to.iter().map(remaining).collect::<Vec<_>>());
    object
}

/// A line for each source, then what they make together.
fn budget(budget: &Budget) -> Value {
    let line = |l: &Line| {
        json!({
            "source": l.source.to_string(),
            "std": l.contribution.std,
            "degrees_of_freedom": l.contribution.degrees_of_freedom,
        })
    };
    let combined = &budget.combined;
    json!({
        "lines": budget.lines.iter().map(line).collect::<Vec<_>>(),
        "std": combined.std,
        "effective_degrees_of_freedom": Some(combined.degrees_of_freedom).filter(|n| n.is_finite()),
        "coverage_factor": combined.factor,
        "coverage": COVERAGE,
        "u95": combined.expanded,
    })
}

fn contribution(c: &Contribution) -> Value {
    json!({ "errors": c.name, "typical": c.typical, "bound": c.bound })
}

/// The distributions of one function with one estimator.
pub fn study(study: &Study) -> Value {
    let spread = |x: &Spread| json!({ "mean": x.mean, "median": x.median, "p95": x.p95, "max": x.max });
    let errors = study.errors.as_ref().map(|errors| {
        let mut object = json!({ "noise": spread(&errors.noise) });
        if let Some(MachineErrors { linearisation, both }) = &errors.machines {
            object["linearisation"] = spread(linearisation);
            object["both"] = spread(both);
        }
        object
    });
    let object = json!({
        "function": study.function,
        "estimator": study.estimator.to_string(),
        "largest_error": errors,
    });
    with_told(object, &study.told)
}
