//! The document for programs: expressions in plain infix with `**`.

use super::document::Document;
use super::extent::remaining;
use super::printer::Style;
use crate::algebra::Fraction;
use crate::identify::{Derivation, Extent};
use crate::ids::ParameterId;
use crate::model::Model;
use serde_json::{Map, Value, json};

/// `{"model", "rank", "coefficients", "functions", "kernel", "unseen", "runs"}`; in `kernel` each entry maps parameters to their factors.
pub fn json(model: &Model, derivation: &Derivation) -> Value {
    let d = Document::new(model, derivation, Style::Plain);
    let coefficients =
        derivation.base.iter().map(|b| json!({ "name": b.name, "definition": d.definition(&b.definition) }));
    let functions = model.functions.iter_enumerated().map(|(i, f)| {
        let x = d.coordinate(i);
        let expression = d.function(i, &x).unwrap_or_else(|| "known".to_owned());
        let mut object = json!({
            "name": d.error(f.error), "location_error": f.is_location(), "coordinate": x, "expression": expression, "estimated": f.estimate,
        });
        if let Some(determination) = derivation.functions.iter().find(|d| d.function == i) {
            let up_to = remaining(model, derivation, determination);
            let up_to = up_to.iter().map(|r| json!({ "term": r.term, "parameter": r.parameter, "factor": r.factor }));
            object["determined"] = json!(determination.extent() == Extent::Determined);
            object["up_to"] = json!(up_to.collect::<Vec<_>>());
        }
        object
    });
    let kernel = derivation.kernel.iter().map(|vector| {
        let entry = |(j, f): &(ParameterId, Fraction)| {
            (derivation.parameters[*j].name.clone(), Value::from(d.printer.fraction(f)))
        };
        Value::Object(vector.iter().map(entry).collect::<Map<_, _>>())
    });
    let runs = derivation.runs.iter().map(|run| {
        let regressors =
            run.regressors.iter().map(|(b, r)| (derivation.base[*b].name.clone(), Value::from(d.printer.fraction(r))));
        let known = run.known.iter().map(|(f, p)| (d.error(model.functions[*f].error), Value::from(d.printer.poly(p))));
        json!({
            "name": run.name,
            "reading": d.reading(run),
            "regressors": regressors.collect::<Map<_, _>>(),
            "known": known.collect::<Map<_, _>>(),
        })
    });
    json!({
        "model": model.name,
        "assumptions": model.assumptions.iter().map(|a| a.text.as_str()).collect::<Vec<_>>(),
        "rank": derivation.rank(),
        "coefficients": coefficients.collect::<Vec<_>>(),
        "functions": functions.collect::<Vec<_>>(),
        "kernel": kernel.collect::<Vec<_>>(),
        "unseen": derivation.unseen.iter().map(|e| model.alphabet.error_name(*e)).collect::<Vec<_>>(),
        "runs": runs.collect::<Vec<_>>(),
    })
}
