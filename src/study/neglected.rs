//! What linearisation drops: the second-order terms of a reading, bounded for given limits of the errors.

use super::limits::ErrorLimits;
use super::rows::Evaluate;
use super::setup::{Setup, SetupError};
use std::ops::Range;
use trunnion_codegen::algebra::{Monomial, Nominal, Order};
use trunnion_codegen::emit::model::{motion, poly};
use trunnion_codegen::graph::{Graph, LANES, Lanes, Symbol, Tape};
use trunnion_codegen::identify::DeriveError;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::directions;
use trunnion_codegen::measurement::reading;
use trunnion_solver::sized::vectorised;

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

/// A sweep, and the direction in which it is reached.
pub(super) type Place = (f64, f64);

/// The second-order terms of a run's reading, ready to evaluate along it.
pub(super) struct SecondOrder<'a> {
    setup: &'a Setup,
    run: RunId,
    /// The products of two errors.
    pub products: Vec<Monomial>,
    tape: Tape,
}

impl<'a> SecondOrder<'a> {
    /// Derives a run at order 2.
    pub fn new(setup: &'a Setup, run: RunId) -> Result<Self, SetupError> {
        let model = &setup.model;
        let refused = |e| SetupError::derivation(model, &e);
        let order = Order::new(2).map_err(|e| refused(DeriveError::Algebra(e)))?;
        let second =
            reading(model, &model.runs[run], order).map_err(|e| refused(DeriveError::Reading(run, e)))?.of_order(2);
        let terms = second.by_errors();
        let mut graph = Graph::new();
        let outputs: Vec<_> = terms.iter().map(|(_, p)| poly(&mut graph, &model.alphabet, p)).collect();
        let lengths = model.alphabet.nominals().filter(|(_, n)| matches!(n, Nominal::Constant(_))).map(|(id, _)| id);
        let [sweep, ..] = model.alphabet.sweep_symbols(model.runs[run].sweep);
        let symbols: Vec<Symbol> = lengths.chain([sweep]).chain(motion(model, run)).map(Symbol::Nominal).collect();
        let tape = Tape::new(&graph.lower(&symbols, &outputs)?);
        Ok(Self { setup, run, products: terms.into_iter().map(|(errors, _)| errors).collect(), tape })
    }

    /// Calls `each` for blocks of places, a sweep and the direction in which it is reached, with those that the block has, and the factor of
    /// every product at each of them.
    pub fn along(&self, places: &[Place], mut each: impl FnMut(Range<usize>, &[&Lanes])) {
        let mut evaluator = self.tape.block_evaluator();
        let mut inputs = self.setup.inputs(self.run);
        for (block, places) in places.chunks(LANES).enumerate() {
            for (lane, &(sweep, direction)) in places.iter().enumerate() {
                self.setup.place(self.run, &mut inputs, sweep, direction);
                evaluator.inputs().iter_mut().zip(&inputs).for_each(|(lanes, &input)| lanes[lane] = input);
            }
            vectorised(Evaluate(&mut evaluator));
            let factors: Vec<&Lanes> = (0..self.products.len()).filter_map(|at| evaluator.output(at)).collect();
            each(block * LANES..block * LANES + places.len(), &factors);
        }
    }

    /// What its terms come to within the limits.
    pub fn within(&self, places: &[Place], limits: ErrorLimits) -> Neglected {
        let setup = self.setup;
        let sizes: Vec<f64> = self.products.iter().map(|errors| product_size(setup, errors, limits)).collect();
        let (mut largest, mut bound) = (vec![0.0f64; sizes.len()], vec![0.0; places.len()]);
        self.along(places, |range, factors| {
            let bound = &mut bound[range];
            for ((factors, size), largest) in factors.iter().zip(&sizes).zip(&mut largest) {
                for (bound, factor) in bound.iter_mut().zip(*factors) {
                    let part = factor.abs() * size;
                    *bound += part;
                    *largest = largest.max(part);
                }
            }
        });
        let named = |(errors, l): (&Monomial, f64)| (product_name(setup, errors), l);
        let mut terms: Vec<(String, f64)> = self.products.iter().zip(largest).map(named).collect();
        terms.sort_by(|a, b| b.1.total_cmp(&a.1));
        Neglected { bound, terms }
    }
}

/// A product by the names of its errors: `o_ya·e_ya`.
pub(super) fn product_name(setup: &Setup, errors: &Monomial) -> String {
    errors.errors().map(|e| setup.model.alphabet.error_name(e)).collect::<Vec<_>>().join("·")
}

/// The largest value of a product within the limits.
pub(super) fn product_size(setup: &Setup, errors: &Monomial, limits: ErrorLimits) -> f64 {
    errors.errors().map(|e| setup.limit(e, limits)).product()
}

/// Derives a run at order 2 and bounds its second-order terms at the given values of the sweep, rad.
///
/// # Errors
/// [`SetupError`] where the exact arithmetic overflows.
pub fn neglected(setup: &Setup, run: RunId, sweeps: &[f64], limits: ErrorLimits) -> Result<Neglected, SetupError> {
    let places: Vec<Place> = sweeps.iter().copied().zip(directions(sweeps)).collect();
    Ok(SecondOrder::new(setup, run)?.within(&places, limits))
}
