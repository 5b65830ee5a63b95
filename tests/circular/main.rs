//! The circular test of ISO 230-4, on paths that are worked out from what a machine's axes do.

mod command;
mod effects;
mod figures;
mod machine;
#[path = "../program/mod.rs"]
mod program;
mod zone;

use trunnion::circular::{Circular, Effect, Estimate, Plane, Term, Test, Trace, Traces, Undetermined, circular};
use trunnion::data::Radius;

/// mm.
const R: f64 = 150.0;
/// Nanometre: what the linear model drops of deviations of some µm is less.
const NM: f64 = 1e-6;

fn test(traces: Traces) -> Test {
    Test { traces, radius: Radius::new(R).unwrap(), plane: Plane::default(), feed: Some(machine::FEED) }
}

fn figures(traces: Traces) -> Circular {
    circular(&test(traces)).unwrap()
}

fn both(clockwise: Vec<(f64, f64)>, counterclockwise: Vec<(f64, f64)>) -> Circular {
    figures(Traces::Both { clockwise: trace(clockwise), counterclockwise: trace(counterclockwise) })
}

fn trace(samples: Vec<(f64, f64)>) -> Trace {
    Trace::new(samples).unwrap()
}

fn effect(figures: &Circular, term: Term) -> Result<Estimate, Undetermined> {
    figures.effects.iter().find(|effect: &&Effect| effect.term == term).unwrap().estimate
}

/// The value of a term, mm.
fn value(figures: &Circular, term: Term) -> f64 {
    effect(figures, term).unwrap().value
}

#[track_caller]
fn near(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b} within {within}");
}
