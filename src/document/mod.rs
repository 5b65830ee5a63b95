//! Results as one JSON object each, for a program: what the commands print and other languages get.

mod design;
mod overview;
mod pivots;
mod positions;
mod prediction;
mod probed;

pub use design::design;
pub use overview::overview;
pub use pivots::pivots;
pub use positions::positions;
pub use prediction::prediction;
pub use probed::probed;

use crate::data::{MachineAtHand, Unit};
use crate::study::{
    Budget, COVERAGE, Contribution, Curve, CurvePoint, Detail, Histogram, Input, Instrument, Line, MachineErrors,
    Report, Setup, Spread, Study, Told, Trace, TracePoint, coordinate, in_unit,
};
use serde_json::{Map, Value, json};
use trunnion_codegen::emit::equations::{self, Remaining};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::model::{Axis, AxisKind};

/// Trials of the Monte Carlo method: JCGM 101, 7.2.2, asks for 10⁴ over what is outside the interval.
const TRIALS: usize = 200_000;

/// One object: model, estimator, runs, coefficients, functions, condition, warnings; the machine, what is stated of it and of
/// the instrument, and what each recording looks like.
pub fn report(setup: &Setup, report: &Report) -> Value {
    let dropped = report.neglected.iter().zip(&report.neglected_usual);
    let runs = report.runs.iter().zip(dropped).map(|((name, samples, rms), (neglected, usual))| {
        let run = json!({ "samples": samples, "rms_um": rms, "neglected_um": neglected, "neglected_usual_um": usual });
        (name.clone(), run)
    });
    let coefficients = report.coefficients.iter();
    let coefficients = coefficients.map(|c| json!({ "name": c.name, "definition": c.definition, "value": c.value, "noise_std": c.noise_std, "std": c.std, "u95": c.u95, "unit": c.unit, "budget": budget(&c.budget) }));
    let recordings = report.runs.iter().zip(report.traces.iter().zip(&report.histograms));
    let recordings = recordings.map(|((name, ..), (trace, histogram))| recording(name, trace, histogram));
    json!({
        "model": report.model,
        "machine": machine(setup),
        "estimator": report.estimator.to_string(),
        "radius_mm": setup.radius(),
        "limits": {
            "length_um": stated(Unit::Um, report.limits.length),
            "angle_urad": stated(Unit::Urad, report.limits.angle),
        },
        "instrument": instrument(&report.instrument),
        "coverage": COVERAGE,
        "runs": runs.collect::<Map<_, _>>(),
        "recordings": (!report.of_factor).then(|| recordings.collect::<Vec<_>>()),
        "coefficients": coefficients.collect::<Vec<_>>(),
        "functions": report.functions.iter().map(curve).collect::<Vec<_>>(),
        "weighed_down": report.weighed_down.iter().map(|(run, down)| json!({
            "run": run,
            "samples": down.samples,
            "scale_um": Unit::Um.from_inner(down.scale),
            "most": down.most.iter().map(|(at, w)| json!({ "at_deg": in_unit(Unit::Deg, *at), "weight": w })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "hysteresis": report.hysteresis.iter().map(|h| json!({
            "run": h.run,
            "samples": h.samples,
            "largest_um": Unit::Um.from_inner(h.largest),
            "at_deg": in_unit(Unit::Deg, h.at),
            "mean_um": Unit::Um.from_inner(h.mean),
        })).collect::<Vec<_>>(),
        "condition": report.condition,
        "warnings": report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "derivation": equations::json(&setup.model, &setup.derivation),
    })
}

/// Adds what a project tells of the machine at hand.
pub fn at_hand(report: &mut Value, machine: &MachineAtHand) {
    for (key, value) in machine.told() {
        if let Some(value) = value {
            report["machine"][key] = json!(value);
        }
    }
}

/// What was stated in a unit, without what its conversions have added.
fn stated(unit: Unit, inner: f64) -> f64 {
    let value = unit.from_inner(inner);
    let rounded = (value * 1e6).round() / 1e6;
    if (rounded - value).abs() <= 1e-12 * value.abs() { rounded } else { value }
}

/// The machine as the model has it.
fn machine(setup: &Setup) -> Value {
    let model = &setup.model;
    let axis = |axis: &Axis, carries: &str| {
        let unit = coordinate(axis).coordinate();
        json!({
            "name": axis.name,
            "kind": if axis.kind == AxisKind::Rotary { "rotary" } else { "linear" },
            "carries": carries,
            "unit": unit.suffix(),
            "range": axis.range.map(|range| range.map(|end| in_unit(unit, end))),
        })
    };
    let axes = model.workpiece.iter().map(|a| axis(a, "workpiece")).chain(model.tool.iter().map(|a| axis(a, "tool")));
    let lengths = model.alphabet.constants().map(|name| (name.to_owned(), Value::from(setup.constant(name))));
    json!({
        "title": model.title,
        "axes": axes.collect::<Vec<_>>(),
        "lengths_mm": lengths.collect::<Map<_, _>>(),
        "assumptions": model.assumptions.iter().map(|a| a.text.as_str()).collect::<Vec<_>>(),
    })
}

/// What is stated of the instrument: bounds, which stand for rectangular distributions.
fn instrument(instrument: &Instrument) -> Value {
    let um = |std: f64| stated(Unit::Um, std * 3f64.sqrt());
    let plain = |std: f64| stated(Unit::Mm, std * 3f64.sqrt());
    json!({
        "constant_um": um(instrument.constant),
        "share": plain(instrument.proportional),
        "bar_length_um": um(instrument.bar_length),
        "temperature_k": plain(instrument.temperature),
        "expansion_per_k": instrument.expansion,
        "noise_um": um(instrument.noise),
    })
}

/// A recording over its sweep in steps, and its residuals counted.
fn recording(name: &str, trace: &Trace, histogram: &Histogram) -> Value {
    let um = |x: f64| Unit::Um.from_inner(x);
    let along = |points: &[TracePoint]| {
        let column = |of: &dyn Fn(&TracePoint) -> f64| points.iter().map(of).collect::<Vec<_>>();
        json!({
            "sweep_deg": column(&|p| Unit::Deg.from_inner(p.sweep)),
            "reading_um": column(&|p| um(p.reading)),
            "residual_um": column(&|p| um(p.residual)),
            "least_residual_um": column(&|p| um(p.residuals[0])),
            "largest_residual_um": column(&|p| um(p.residuals[1])),
            "samples": points.iter().map(|p| p.samples).collect::<Vec<_>>(),
        })
    };
    json!({
        "run": name,
        "increasing": along(&trace.increasing),
        "decreasing": along(&trace.decreasing),
        "histogram": counted(histogram),
    })
}

/// Residuals counted: the lower end of the first bin, the width of each, what is in them and what is beyond.
pub fn counted(histogram: &Histogram) -> Value {
    let [below, above] = histogram.beyond;
    json!({
        "from_um": Unit::Um.from_inner(histogram.from),
        "width_um": stated(Unit::Um, histogram.width),
        "counts": histogram.counts,
        "below": below,
        "above": above,
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
            ("coverage_factor", p.factor),
            ("sum_u95", p.sum_u95),
            ("sum_coverage_factor", p.sum_factor),
        ];
        Value::Object(pairs.map(|(k, v)| (k.to_owned(), Value::from(v))).into_iter().collect())
    };
    let object = json!({
        "name": c.name,
        "location_error": c.is_location,
        "unit": c.unit.suffix(),
        "coordinate": c.coordinate,
        "coordinate_unit": c.coordinate_unit.suffix(),
        "extreme": c.extreme().map(point),
        "points": c.points.iter().map(point).collect::<Vec<_>>(),
        "largest": c.largest.as_ref().map(|(at, b)| {
            let mut largest = json!({ key.clone(): at, "budget": budget(b) });
            if let Some(detail) = &c.detail {
                detailed(&mut largest, b, detail);
            }
            largest
        }),
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

/// The rows of a budget, what correlations between them add, and the interval of the distributions themselves.
fn detailed(largest: &mut Value, budget: &Budget, detail: &Detail) {
    let combined = budget.combined.std;
    let percent = |std: f64| if combined > 0.0 { 100.0 * (std / combined).powi(2) } else { 0.0 };
    let input = |i: &Input| {
        json!({
            "source": i.source.to_string(),
            "quantity": i.quantity,
            "distribution": i.distribution.to_string(),
            "bound": i.bound.map(|bound| stated(Unit::Mm, bound)),
            "divisor": i.distribution.divisor(),
            "std": i.std,
            "unit": i.unit,
            "sensitivity": i.sensitivity,
            "contribution": i.contribution.std,
            "degrees_of_freedom": i.contribution.degrees_of_freedom,
            "share_percent": percent(i.contribution.std),
        })
    };
    largest["inputs"] = json!(detail.inputs.iter().map(input).collect::<Vec<_>>());
    // What is common to several readings or runs is added up within its row.
    largest["correlations"] = json!({ "contribution": 0.0, "share_percent": 0.0 });
    largest["monte_carlo"] = json!({ "trials": TRIALS, "u95": detail.monte_carlo(TRIALS) });
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
