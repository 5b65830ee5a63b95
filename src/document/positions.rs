//! Positions that are proposed, as one JSON object.

use crate::data::degrees;
use crate::study::plan::positions::{Asked, Chosen, Proposed};
use crate::study::plan::{LargestValuation, Predicted, RotaryAxis};
use crate::study::{Measurement, Setup};
use serde_json::{Value, json};
use trunnion_codegen::ids::FunctionId;

/// Positions of each run, degrees, beside those that are spread evenly, and what both would give of each function: the valuation
/// number in `unit` for each µm, and the expanded uncertainty of 95 % from noise in `u95_unit`; of each rotary axis, in `axes`, the
/// largest valuation number of its linear and of its angular location errors.
pub fn positions(setup: &Setup, asked: &Asked, found: &Proposed) -> Value {
    let both = [("evenly", &found.evenly), ("proposed", &found.proposed)];
    let function = |f: &FunctionId| {
        let unit = setup.quantity(*f).deviation();
        let mut object = json!({ "name": setup.function_name(*f), "u95_unit": unit.suffix() });
        for (name, chosen) in both {
            let own: Option<&Predicted> = chosen.prediction.functions.iter().find(|own| own.function == *f);
            let valued = own.and_then(|own| own.valuation(setup, asked.sigma));
            let u95 = own.and_then(|own| own.largest).map(|largest| unit.from_inner(largest.u95));
            if let Some(valuation) = valued {
                object["unit"] = json!(valuation.suffix());
            }
            object[name] = json!({ "valuation": valued.map(|own| own.value), "u95": u95 });
        }
        object
    };
    let sweeps = |chosen: &Chosen, at: usize| chosen.positions[at].iter().map(|x| degrees(*x)).collect::<Vec<_>>();
    let run = |(at, measurement): (usize, &Measurement)| {
        json!({
            "name": measurement.name,
            "proposed_deg": sweeps(&found.proposed, at),
            "evenly_deg": sweeps(&found.evenly, at),
        })
    };
    json!({
        "model": setup.model.name,
        "step_deg": asked.step_deg,
        "functions": asked.functions.iter().map(function).collect::<Vec<_>>(),
        "axes": axes(setup, asked, found),
        "runs": found.measurements.iter().enumerate().map(run).collect::<Vec<_>>(),
    })
}

/// Each rotary axis' largest valuation numbers, and which of its location errors have none.
fn axes(setup: &Setup, asked: &Asked, found: &Proposed) -> Vec<Value> {
    let names = |of: &[FunctionId]| of.iter().map(|f| setup.function_name(*f)).collect::<Vec<_>>();
    let one = |own: &LargestValuation| json!({ "valuation": own.valuation.value, "function": setup.function_name(own.function) });
    let largest = |[evenly, proposed]: [&Option<LargestValuation>; 2]| {
        let (evenly, proposed) = (evenly.as_ref()?, proposed.as_ref()?);
        let (unit, of) = (proposed.valuation.suffix(), names(&proposed.of));
        Some(json!({ "unit": unit, "of": of, "evenly": one(evenly), "proposed": one(proposed) }))
    };
    let [evenly, proposed] = found.axes(setup, asked);
    let object = |(evenly, proposed): (&RotaryAxis, &RotaryAxis)| {
        json!({
            "name": setup.model.axis(proposed.axis).map(|axis| axis.name.as_str()),
            "linear": largest([&evenly.linear, &proposed.linear]),
            "angular": largest([&evenly.angular, &proposed.angular]),
            "not_determined": names(&proposed.not_determined),
            "without": proposed.without.iter().map(|e| setup.model.alphabet.error_name(*e)).collect::<Vec<_>>(),
        })
    };
    evenly.iter().zip(&proposed).map(object).collect()
}
