//! Positions that are proposed, as one JSON object.

use crate::data::degrees;
use crate::study::plan::Predicted;
use crate::study::plan::positions::{Asked, Chosen, Proposed};
use crate::study::{Measurement, Setup};
use serde_json::{Value, json};
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::quantity::Unit;

/// Positions of each run, degrees, beside those that are spread evenly, and what both would give of each function: the valuation
/// number in `unit` for each µm, and the expanded uncertainty of 95 % from noise in `u95_unit`.
pub fn positions(setup: &Setup, asked: &Asked, found: &Proposed) -> Value {
    let both = [("evenly", &found.evenly), ("proposed", &found.proposed)];
    let function = |f: &FunctionId| {
        let unit = setup.quantity(*f).deviation();
        let mut object = json!({ "name": setup.function_name(*f), "u95_unit": unit.suffix() });
        for (name, chosen) in both {
            let own: Option<&Predicted> = chosen.prediction.functions.iter().find(|own| own.function == *f);
            let valued = own.and_then(|own| own.valuation(setup, asked.sigma));
            let u95 = own.and_then(|own| own.largest).map(|largest| unit.from_inner(largest.u95));
            if let Some((_, unit)) = valued {
                object["unit"] = json!(format!("{}/{}", unit.suffix(), Unit::Um.suffix()));
            }
            object[name] = json!({ "valuation": valued.map(|(value, _)| value), "u95": u95 });
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
        "runs": found.measurements.iter().enumerate().map(run).collect::<Vec<_>>(),
    })
}
