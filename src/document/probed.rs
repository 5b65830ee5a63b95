//! Budgets of what a probe in a ring finds.

use crate::data::Unit;
use crate::exechon::{ProbedBudget, ProbedPart, Tried};
use serde_json::{Value, json};

/// The rows of each budget, µm, and beside it the interval by trials.
pub fn probed<const N: usize>(budgets: &[ProbedBudget; N], tried: Option<&Tried<N>>) -> Value {
    let um = |mm: f64| Unit::Um.from_inner(mm);
    let input = |own: &ProbedBudget, part: &ProbedPart| {
        json!({
            "source": part.source,
            "quantity": part.quantity,
            "distribution": if part.degrees_of_freedom.is_some() { "Student's t" } else { "normal" },
            "bound": part.stated.map(um),
            "divisor": part.stated.map(|_| 2.0),
            "std": um(part.std),
            "unit": Unit::Um.suffix(),
            "sensitivity": part.sensitivity,
            "contribution": um(part.contribution()),
            "degrees_of_freedom": part.degrees_of_freedom,
            "share_percent": 100.0 * own.share(part),
        })
    };
    let budget = |(k, own): (usize, &ProbedBudget)| {
        let combined = &own.combined;
        json!({
            "result": own.result,
            "inputs": own.parts.iter().map(|part| input(own, part)).collect::<Vec<_>>(),
            "correlations": { "contribution": 0.0, "share_percent": 0.0 },
            "budget": {
                "std": um(combined.std),
                "effective_degrees_of_freedom": Some(combined.degrees_of_freedom).filter(|n| n.is_finite()),
                "coverage_factor": combined.factor,
                "u95": um(combined.expanded),
            },
            "monte_carlo": tried.map(|tried| json!({ "trials": tried.trials, "u95": um(tried.expanded[k]) })),
        })
    };
    budgets.iter().enumerate().map(budget).collect()
}
