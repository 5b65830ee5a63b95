//! What linearisation drops: the second-order terms of a reading, bounded for given limits of the errors.

use super::draw::Limits;
use super::setup::{Setup, SetupError};
use trunnion_codegen::algebra::{Monomial, Order};
use trunnion_codegen::emit::model::poly;
use trunnion_codegen::graph::{Graph, Tape};
use trunnion_codegen::identify::DeriveError;
use trunnion_codegen::measurement::reading;

/// The neglected part of one run's reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Neglected {
    /// At each sample `Σ |coefficient| · limit · limit` over all second-order terms: no machine within the limits has a
    /// larger one there, mm.
    pub bound: Vec<f64>,
    /// Products of errors with their largest contribution along the run, mm, largest first.
    pub terms: Vec<(String, f64)>,
}

impl Neglected {
    /// The largest bound along the run, mm.
    pub fn largest(&self) -> f64 {
        self.bound.iter().copied().fold(0.0, f64::max)
    }
}

/// Derives a run at order 2 and bounds its second-order terms at the given values of the sweep, rad.
///
/// # Errors
/// [`SetupError`] where the exact arithmetic overflows.
pub fn neglected(setup: &Setup, run: usize, sweeps: &[f64], limits: Limits) -> Result<Neglected, SetupError> {
    let model = &setup.model;
    let algebra = |e| SetupError::Derive(DeriveError::Algebra(e));
    let order = Order::new(2).map_err(algebra)?;
    let second = reading(model, &model.runs[run], order)
        .map_err(|e| SetupError::Derive(DeriveError::Reading(run, e)))?
        .of_order(2);
    let terms = second.by_errors();
    let mut graph = Graph::new();
    let outputs: Vec<_> = terms.iter().map(|(_, p)| poly(&mut graph, &model.alphabet, p)).collect();
    let names: Vec<&str> =
        model.alphabet.constants().chain([model.alphabet.sweep_name(model.runs[run].sweep)]).collect();
    let tape = Tape::new(&graph.lower(&names, &outputs)?);
    let size =
        |errors: &Monomial| errors.errors().map(|e| limits.of(model.alphabet.error_quantity(e))).product::<f64>();
    let sizes: Vec<f64> = terms.iter().map(|(errors, _)| size(errors)).collect();
    let mut inputs: Vec<f64> = model.alphabet.constants().map(|n| setup.constant(n)).chain([0.0]).collect();
    let mut evaluator = tape.evaluator();
    let mut values = vec![0.0; outputs.len()];
    let mut largest = vec![0.0f64; outputs.len()];
    let mut bound = Vec::with_capacity(sweeps.len());
    for &sweep in sweeps {
        if let Some(last) = inputs.last_mut() {
            *last = sweep;
        }
        let evaluated = evaluator.evaluate(&inputs, &mut values);
        debug_assert_eq!(evaluated, Ok(()), "the tape was made for these inputs");
        let parts = || values.iter().zip(&sizes).map(|(v, s)| v.abs() * s);
        bound.push(parts().sum());
        for (l, part) in largest.iter_mut().zip(parts()) {
            *l = l.max(part);
        }
    }
    let name = |errors: &Monomial| errors.errors().map(|e| model.alphabet.error_name(e)).collect::<Vec<_>>().join("·");
    let mut terms: Vec<(String, f64)> = terms.iter().zip(largest).map(|((errors, _), l)| (name(errors), l)).collect();
    terms.sort_by(|a, b| b.1.total_cmp(&a.1));
    Ok(Neglected { bound, terms })
}
