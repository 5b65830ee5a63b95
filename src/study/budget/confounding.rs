//! What other errors within their limits can add to a function.

use super::bound::Shape;
use crate::study::fit::Observation;
use crate::study::limits::ErrorLimits;
use crate::study::setup::Setup;
use crate::study::visited::{between, sweeps, visited};
use std::collections::BTreeMap;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Origin;
use trunnion_codegen::ids::FunctionId;

/// Coordinates at which a motion error is held to its limit.
const STEPS: usize = 96;

/// The motion errors of a model over the coordinates that the runs visit.
pub(super) struct Limited<'a> {
    setup: &'a Setup,
    limits: ErrorLimits,
    shapes: BTreeMap<FunctionId, Shape>,
}

/// A sum of parameters: of constant errors, and of coefficients by their function and term.
pub(super) type Sum = Vec<(Origin, f64)>;

impl<'a> Limited<'a> {
    pub fn new(setup: &'a Setup, observations: &[Observation], limits: ErrorLimits) -> Self {
        let shape = |function: FunctionId| {
            let terms = setup.model.functions[function].basis.functions().len();
            let range = visited(setup, function, sweeps(observations)).filter(|_| terms > 0)?;
            let values: Vec<Vec<f64>> = between(range, STEPS).map(|x| setup.basis(function, x).raw).collect();
            Some((function, Shape::new(terms, &values)))
        };
        Self { setup, limits, shapes: setup.model.functions.keys().filter_map(shape).collect() }
    }

    /// The errors of a sum, each with the most that a unit of it adds.
    pub fn largest(&self, sum: &Sum) -> Vec<(ErrorId, f64)> {
        let mut functions: BTreeMap<FunctionId, Vec<f64>> = BTreeMap::new();
        let mut constants: BTreeMap<ErrorId, f64> = BTreeMap::new();
        for &(origin, factor) in sum {
            match origin {
                Origin::Constant(error) => *constants.entry(error).or_default() += factor,
                Origin::Coefficient(c) => {
                    let terms = self.setup.model.functions[c.function].basis.functions().len();
                    let own = functions.entry(c.function).or_insert_with(|| vec![0.0; terms]);
                    own.iter_mut().skip(c.term.into()).take(1).for_each(|h| *h += factor);
                }
            }
        }
        let function = |(function, h): (&FunctionId, &Vec<f64>)| {
            let largest = self.shapes.get(function).map_or(0.0, |shape| shape.largest(h));
            (self.setup.model.functions[*function].error, largest)
        };
        constants.into_iter().chain(functions.iter().map(function)).collect()
    }

    /// The limit of an error, mm or rad.
    pub fn limit(&self, error: ErrorId) -> f64 {
        self.setup.limit(error, self.limits)
    }
}
