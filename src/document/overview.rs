//! What is said of a model's runs before anything is measured, as one JSON object.

use super::prediction::prediction;
use crate::study::plan::{Compared, Overview};
use serde_json::{Value, json};
use trunnion_codegen::ids::ParameterId;

/// The plans compared, the runs recommended, what is confounded and what would separate it; `noise_um` is the half width of the
/// readings' uniform noise, µm.
pub fn overview(found: &Overview, noise_um: f64) -> Value {
    let Overview { model, derivation, comparison, compared, described, tried, added, .. } = found;
    let name = |j: &ParameterId| derivation.parameters[*j].name.clone();
    let groups = derivation.groups();
    let groups = groups.iter().zip(described).map(|(g, words)| {
        json!({
            "parameters": g.parameters.iter().map(name).collect::<Vec<_>>(),
            "base": g.base.iter().map(|&b| derivation.base[b].name.clone()).collect::<Vec<_>>(),
            "directions": g.kernel.len(),
            "words": words,
            "separated_by": added.iter().filter_map(|a| {
                let count = a.separates.iter().filter(|s| g.kernel.contains(s)).count();
                (count > 0).then(|| json!({
                    "model": a.model,
                    "run": a.run,
                    "tool_ball_kept": a.ball_kept,
                    "directions": count,
                    "determines": a.determines.iter().filter(|j| g.parameters.contains(j)).map(name).collect::<Vec<_>>(),
                }))
            }).collect::<Vec<_>>(),
        })
    });
    let recommended = found.recommended.iter().map(|r| {
        let error = model.functions[r.function].error;
        let unit = model.alphabet.error_quantity(error).deviation();
        json!({
            "name": model.notation.function(model.alphabet.error_name(error)),
            "unit": unit.suffix(),
            "runs": r.runs,
            "u95": unit.from_inner(r.u95),
            "best": unit.from_inner(r.best),
        })
    });
    let known = added.iter().filter(|a| !a.finds.is_empty());
    json!({
        "model": model.name,
        "samples": comparison.samples,
        "noise_um": noise_um,
        "estimator": comparison.estimator.to_string(),
        "plans": compared.iter().map(object).collect::<Vec<_>>(),
        "recommended": recommended.collect::<Vec<_>>(),
        "runs_tried": tried,
        "confounded": groups.collect::<Vec<_>>(),
        "known_measured_by": known.map(|a| json!({ "model": a.model, "run": a.run, "functions": a.finds })).collect::<Vec<_>>(),
    })
}

fn object(line: &Compared) -> Value {
    let mut value = json!({
        "radius_mm": line.radius,
        "range_deg": [line.range_deg.0, line.range_deg.1],
        "without": line.without,
    });
    match &line.outcome {
        Err(why) => value["refused"] = json!(why.to_string()),
        Ok((setup, predicted)) => {
            let own = prediction(setup, predicted);
            value
                .as_object_mut()
                .into_iter()
                .for_each(|value| value.extend(own.as_object().cloned().unwrap_or_default()));
        }
    }
    value
}
