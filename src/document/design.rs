//! Runs that were searched for functions, as one JSON object.

use crate::study::plan::design::{Design, Proposal};
use serde_json::{Value, json};
use trunnion_codegen::model::Model;

/// Runs that were searched for functions: what can be reached of each, and sets that suffice, the best first, ready for a model file.
pub fn design(model: &Model, found: &Design) -> Value {
    let reachable = found.functions.iter().map(|r| {
        let unit = r.unit;
        json!({ "name": r.name, "unit": unit.suffix(), "within": unit.from_inner(r.within), "best": unit.from_inner(r.best) })
    });
    let proposal = |p: &Proposal| {
        let functions = p.prediction.functions.iter().map(|f| {
            let unit = p.setup.quantity(f.function).deviation();
            let largest = f.largest.map(|l| json!({ "std": unit.from_inner(l.std), "u95": unit.from_inner(l.u95) }));
            let budget = p.budgets.iter().find(|own| own.function == f.function);
            let [measured, whole] =
                [budget.map(|b| b.measured), budget.map(|b| b.whole)].map(|u| u.map(|u| unit.from_inner(u)));
            json!({
                "name": p.setup.function_name(f.function), "unit": unit.suffix(), "told": f.told.words,
                "largest": largest, "u95": measured, "u95_with_assumptions": whole,
            })
        });
        json!({
            "placings": p.placings,
            "condition": p.prediction.condition,
            "functions": functions.collect::<Vec<_>>(),
            "runs": p.draft.runs.iter().map(|run| run.name.value.as_str()).collect::<Vec<_>>(),
            "model_file": p.draft.runs.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
        })
    };
    json!({
        "model": model.name,
        "choices": found.choices.iter().map(|run| run.name.value.as_str()).collect::<Vec<_>>(),
        "functions": reachable.collect::<Vec<_>>(),
        "proposals": found.proposals.iter().map(proposal).collect::<Vec<_>>(),
    })
}
