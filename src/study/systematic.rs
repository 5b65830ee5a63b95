//! The systematic error that linearisation leaves in an estimated function, product by product.
//!
//! A second-order term c(a)·eᵢ·eⱼ of the readings moves an estimated coefficient by Σ w(a)·c(a)·eᵢ·eⱼ, with the fit's
//! sensitivities w. Every error is a combination of functions (1 for a location or set-up error), so the sums over the
//! samples are worked out once for each pair of functions; what remains is quadratic in their factors, and its size on
//! machines drawn within the limits is a mean over draws.

use super::budget::{Instrument, Sources};
use super::factors::{Factors, OfMachine};
use super::fit::{Fit, Observation};
use super::limits::ErrorLimits;
use super::neglected::{Neglected, Place, SecondOrder, product_name, product_size};
use super::seen::Seen;
use super::setup::{Setup, SetupError};
use super::shape::parts;
use super::weights::Weights;
use std::collections::BTreeMap;
use trunnion_codegen::algebra::{ErrorId, Monomial};
use trunnion_codegen::graph::{LANES, Lanes, in_blocks};

/// What linearisation leaves in an estimated function, in its own unit (mm or rad).
#[derive(Clone, Debug, PartialEq)]
pub struct Systematic {
    /// Where it is largest, mm or rad.
    pub at: f64,
    /// Its root mean square there, over machines drawn within the limits: a standard deviation.
    pub typical: f64,
    /// Each product of two errors, the one that contributes most first.
    pub terms: Vec<Contribution>,
}

/// What one product of two errors contributes.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// `o_ya·e_ya`
    pub name: String,
    /// Root mean square over drawn machines.
    pub typical: f64,
    /// No machine within the limits has more: of two constant errors exactly, else with motion errors of the worst shape.
    pub bound: f64,
}

/// The systematic error of a function that `fit` estimated from `observations`, over `points` of its coordinate (mm or rad).
///
/// # Errors
/// [`SetupError`] where the exact arithmetic overflows.
pub fn systematic(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    seen: &Seen,
    limits: ErrorLimits,
    points: &[f64],
) -> Result<Systematic, SetupError> {
    let sources = Sources::new(setup, observations, fit, limits, &Instrument::default(), false);
    let weights = sources.dependence().of_coefficients(seen);
    Ok(Linearised::new(setup, observations, &sources, limits)?.left_in(&weights, |x| seen.basis(setup, x), points))
}

/// The runs of a measurement with what linearisation drops along them, and machines to try it on: the same for every function that is
/// estimated from them.
pub(super) struct Linearised<'a> {
    setup: &'a Setup,
    limits: ErrorLimits,
    runs: Vec<Along<'a>>,
    /// Drawn within the limits.
    machines: &'a Factors,
}

/// What linearisation drops along a run.
struct Along<'a> {
    second: SecondOrder<'a>,
    places: Vec<Place>,
    /// Of each error in a product, the functions it is a combination of, at every sample.
    shapes: BTreeMap<ErrorId, Vec<Vec<Lanes>>>,
}

/// A product of two errors and how it moves the coefficients of the function.
struct Product {
    errors: [ErrorId; 2],
    /// Per pair of functions that the two are combinations of, per coefficient: `Σ w·c·φᵢ·φⱼ` over all samples.
    moves: Vec<f64>,
}

impl<'a> Linearised<'a> {
    /// Derives each run at order 2.
    ///
    /// # Errors
    /// [`SetupError`] where the exact arithmetic overflows.
    pub fn new(
        setup: &'a Setup,
        observations: &[Observation],
        sources: &'a Sources,
        limits: ErrorLimits,
    ) -> Result<Self, SetupError> {
        let runs = observations.iter().map(|o| Along::new(setup, o)).collect::<Result<_, _>>()?;
        Ok(Self { setup, limits, runs, machines: sources.machines() })
    }

    /// Per run, what is dropped within the limits.
    pub fn neglected(&self) -> Vec<Neglected> {
        self.runs.iter().map(|run| run.second.within(&run.places, self.limits)).collect()
    }

    /// What is left in the function whose coefficients depend on the readings by `weights`, over points of its coordinate.
    pub fn left_in(&self, weights: &[Weights], basis: impl Fn(f64) -> Vec<f64>, points: &[f64]) -> Systematic {
        let products = self.products(weights);
        let mut total = Moments::new(weights.len());
        for machine in self.machines.machines() {
            total.add(&moved(&products, machine, weights.len()));
        }
        let largest = |(at, typical): (f64, f64), &x: &f64| {
            let here = total.at(&basis(x));
            if here > typical { (x, here) } else { (at, typical) }
        };
        let (at, typical) = points.iter().fold((points.first().copied().unwrap_or(0.0), 0.0), largest);
        let here = basis(at);
        let bounds = self.most(weights, &here);
        let term = |(errors, product): &(Monomial, Product)| Contribution {
            name: product_name(self.setup, errors),
            typical: product.typical(&here, self.machines),
            bound: bounds.get(errors).copied().unwrap_or(0.0),
        };
        let mut terms: Vec<Contribution> = products.iter().map(term).collect();
        terms.sort_by(|a, b| b.typical.total_cmp(&a.typical));
        Systematic { at, typical, terms }
    }

    /// Every product of two errors, in all runs.
    fn products(&self, weights: &[Weights]) -> Vec<(Monomial, Product)> {
        let mut products: BTreeMap<Monomial, Product> = BTreeMap::new();
        let size = weights.len().max(1);
        for (o, run) in self.runs.iter().enumerate() {
            let weights: Vec<Vec<Lanes>> = weights.iter().map(|w| in_blocks(w.0[o].iter().copied())).collect();
            // Taken out while this run adds to them.
            let of = |errors: &Monomial| {
                let both = pair(errors)?;
                let [first, second] = [run.shapes.get(&both[0])?, run.shapes.get(&both[1])?];
                let moves = first.len() * second.len() * weights.len();
                let none = || Product { errors: both, moves: vec![0.0; moves] };
                Some((products.remove(errors).unwrap_or_else(none), first, second))
            };
            let mut own: Vec<_> = run.second.products.iter().map(of).collect();
            run.second.along(&run.places, |range, factors| {
                let (block, count) = (range.start / LANES, range.len());
                for (own, factors) in own.iter_mut().zip(factors) {
                    let Some((product, first, second)) = own else { continue };
                    let pairs = first.iter().flat_map(|a| second.iter().map(move |b| (&a[block], &b[block])));
                    for ((a, b), moves) in pairs.zip(product.moves.chunks_mut(size)) {
                        let mut values = [0.0; LANES];
                        for (value, ((f, a), b)) in values[..count].iter_mut().zip(factors.iter().zip(a).zip(b)) {
                            *value = f * a * b;
                        }
                        let moves = moves.iter_mut().zip(&weights);
                        moves.for_each(|(m, weights)| *m += dot(&weights[block], &values));
                    }
                }
            });
            let own = run.second.products.iter().zip(own);
            products.extend(own.filter_map(|(errors, own)| own.map(|(product, ..)| (*errors, product))));
        }
        products.into_iter().collect()
    }

    /// Per product the most it can move the function where its basis is `here`.
    fn most(&self, weights: &[Weights], here: &[f64]) -> BTreeMap<Monomial, f64> {
        let setup = self.setup;
        // Signed sums for products of constants, sums of sizes for the others.
        let mut sums: BTreeMap<Monomial, f64> = BTreeMap::new();
        for (o, run) in self.runs.iter().enumerate() {
            let moving = |m: &Monomial| m.errors().any(|e| setup.model.axis_of(e).is_some());
            let moving: Vec<bool> = run.second.products.iter().map(moving).collect();
            let mut own = vec![0.0; moving.len()];
            run.second.along(&run.places, |range, factors| {
                let weight = |sample: usize| weights.iter().zip(here).map(|(w, b)| w.0[o][sample] * b).sum();
                let weights: Vec<f64> = range.map(weight).collect();
                for ((sum, factors), moving) in own.iter_mut().zip(factors).zip(&moving) {
                    let parts = weights.iter().zip(*factors).map(|(w, f)| w * f);
                    *sum += if *moving { parts.map(f64::abs).sum::<f64>() } else { parts.sum() };
                }
            });
            for (errors, sum) in run.second.products.iter().zip(own) {
                *sums.entry(*errors).or_insert(0.0) += sum;
            }
        }
        let within = |(errors, sum): (Monomial, f64)| (errors, sum.abs() * product_size(setup, &errors, self.limits));
        sums.into_iter().map(within).collect()
    }
}

impl<'a> Along<'a> {
    fn new(setup: &'a Setup, observation: &Observation) -> Result<Self, SetupError> {
        let second = SecondOrder::new(setup, observation.run)?;
        let sweeps: Vec<f64> = observation.samples.iter().map(|s| s.sweep).collect();
        let exact = setup.exact(observation.run, &sweeps);
        let along = |error: ErrorId| {
            let at: Vec<f64> = match setup.model.axis_of(error) {
                Some((axis, _)) => exact.run().coordinates(axis).map(|x| x.unwrap_or(0.0)).collect(),
                None => vec![0.0; sweeps.len()],
            };
            parts(setup, error).iter().map(|shape| in_blocks(at.iter().map(|x| shape.at(*x)))).collect()
        };
        let mut shapes = BTreeMap::new();
        for error in second.products.iter().filter_map(pair).flatten() {
            shapes.entry(error).or_insert_with(|| along(error));
        }
        let places = observation.samples.iter().map(|s| (s.sweep, s.direction)).collect();
        Ok(Self { second, places, shapes })
    }
}

impl Product {
    /// On a machine, for each pair of functions the product of the two errors' factors.
    fn factors<'a>(&self, machine: OfMachine<'a>) -> impl Iterator<Item = f64> + use<'a> {
        let [first, second] = self.errors.map(|error| machine.of(error));
        first.iter().flat_map(move |a| second.iter().map(move |b| a * b))
    }

    /// The root mean square, over machines, of what it moves the function by where its basis is `here`.
    fn typical(&self, here: &[f64], machines: &Factors) -> f64 {
        let move_here = |moves: &[f64]| moves.iter().zip(here).map(|(m, b)| m * b).sum();
        let moves: Vec<f64> = self.moves.chunks(here.len().max(1)).map(move_here).collect();
        let on = |machine| moves.iter().zip(self.factors(machine)).map(|(m, f)| m * f).sum::<f64>();
        let (squares, count) = machines.machines().map(on).fold((0.0, 0.0), |(sum, n), x| (sum + x * x, n + 1.0));
        (squares / f64::max(count, 1.0)).sqrt()
    }
}

/// How all products move each of so many coefficients on a machine.
fn moved(products: &[(Monomial, Product)], machine: OfMachine, coefficients: usize) -> Vec<f64> {
    let mut moved = vec![0.0; coefficients];
    for (_, product) in products {
        for (factor, moves) in product.factors(machine).zip(product.moves.chunks(coefficients.max(1))) {
            moved.iter_mut().zip(moves).for_each(|(sum, m)| *sum += m * factor);
        }
    }
    moved
}

fn pair(errors: &Monomial) -> Option<[ErrorId; 2]> {
    let mut both = errors.errors();
    Some([both.next()?, both.next()?])
}

fn dot(a: &Lanes, b: &Lanes) -> f64 {
    let mut sums = [0.0; 8];
    for (a, b) in a.as_chunks::<8>().0.iter().zip(b.as_chunks::<8>().0) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.iter().sum()
}

/// Mean outer product of vectors of coefficients.
struct Moments {
    size: usize,
    sums: Vec<f64>,
    count: f64,
}

impl Moments {
    fn new(size: usize) -> Self {
        Self { size, sums: vec![0.0; size * size], count: 0.0 }
    }

    fn add(&mut self, vector: &[f64]) {
        let products = vector.iter().flat_map(|a| vector.iter().map(move |b| a * b));
        self.sums.iter_mut().zip(products).for_each(|(s, p)| *s += p);
        self.count += 1.0;
    }

    /// Root mean square of the function with these values of its basis.
    fn at(&self, basis: &[f64]) -> f64 {
        let row = |(row, b): (&[f64], &f64)| row.iter().zip(basis).map(|(m, c)| m * c).sum::<f64>() * b;
        let square: f64 = self.sums.chunks(self.size.max(1)).zip(basis).map(row).sum();
        (square.max(0.0) / self.count.max(1.0)).sqrt()
    }
}
