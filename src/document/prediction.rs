//! What intended runs would give, as one JSON object.

use super::with_told;
use crate::study::Setup;
use crate::study::plan::{Predicted, Prediction};
use serde_json::{Map, Value, json};
use trunnion_codegen::ids::BaseId;

/// Rank, condition, the standard deviation of each base parameter (in its own unit), and the largest of each estimated function.
pub fn prediction(setup: &Setup, prediction: &Prediction) -> Value {
    let name = |b: &BaseId| setup.derivation.base[*b].name.clone();
    let function = |f: &Predicted| {
        let unit = setup.quantity(f.function).deviation();
        let object = json!({
            "name": setup.function_name(f.function),
            "unit": unit.suffix(),
            "largest_std": f.largest.map(|l| unit.from_inner(l.std)),
            "largest_u95": f.largest.map(|l| unit.from_inner(l.u95)),
        });
        with_told(object, &f.told)
    };
    let std: Map<String, Value> = prediction.base.iter().map(|(b, std)| (name(b), json!(std))).collect();
    json!({
        "rank": setup.derivation.rank(),
        "condition": prediction.condition,
        "weakest": prediction.weakest.iter().map(name).collect::<Vec<_>>(),
        "std": std,
        "functions": prediction.functions.iter().map(function).collect::<Vec<_>>(),
    })
}
