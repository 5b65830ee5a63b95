//! The systematic error that linearisation leaves in an estimated function, product by product.
//!
//! A second-order term c(a)·eᵢ·eⱼ of the readings moves an estimated coefficient by Σ w(a)·c(a)·eᵢ·eⱼ, with the fit's
//! sensitivities w. Every error is a combination of functions (1 for a location or set-up error), so the sums over the
//! samples are worked out once for each pair of functions; what remains is quadratic in their factors, and its size on
//! machines drawn within the limits is a mean over draws.

use super::draw::{Population, SimulatedMachine};
use super::fit::{Fit, Observation};
use super::limits::ErrorLimits;
use super::neglected::{SecondOrder, product_name, product_size};
use super::seen::Seen;
use super::setup::{Setup, SetupError};
use super::shape::parts;
use super::simulate::grid;
use super::weights::Weights;
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use std::collections::BTreeMap;
use trunnion_codegen::algebra::{ErrorId, Monomial};
use trunnion_codegen::measurement::ExactReading;

/// Machines drawn: a root mean square over them is good to some 4 %.
const MACHINES: u64 = 400;

/// Samples of a run that the drawn errors are scaled over.
const SCALED_OVER: usize = 120;

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

/// A product of two errors and how it moves the coefficients of the function.
struct Product {
    errors: [ErrorId; 2],
    /// How many functions either is a combination of.
    counts: [usize; 2],
    /// Per coefficient, per pair of functions.
    moves: Vec<f64>,
}

impl Product {
    /// How it moves each coefficient on a machine.
    fn on<'a>(&'a self, machine: &'a SimulatedMachine) -> impl Iterator<Item = f64> + 'a {
        let [first, second] = self.errors.map(|e| machine.factors(e));
        let pairs = self.counts[0] * self.counts[1];
        self.moves.chunks(pairs.max(1)).map(move |moves| {
            let factors = first.iter().flat_map(|a| second.iter().map(move |b| a * b));
            moves.iter().zip(factors).map(|(m, f)| m * f).sum()
        })
    }
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
    let basis = |x: f64| seen.basis(setup, x);
    let weights = fit.coefficient_sensitivities(setup, observations, seen);
    let seconds: Vec<SecondOrder> =
        observations.iter().map(|o| SecondOrder::new(setup, o.run)).collect::<Result<_, _>>()?;
    let products = products(setup, observations, &seconds, &weights);

    let size = weights.len();
    let mut total = Moments::new(size);
    let mut single: Vec<Moments> = products.iter().map(|_| Moments::new(size)).collect();
    for machine in machines(setup, observations, limits) {
        let mut sum = vec![0.0; size];
        for ((_, product), moments) in products.iter().zip(&mut single) {
            let moved: Vec<f64> = product.on(&machine).collect();
            sum.iter_mut().zip(&moved).for_each(|(s, m)| *s += m);
            moments.add(&moved);
        }
        total.add(&sum);
    }
    let largest = |(at, typical): (f64, f64), &x: &f64| {
        let here = total.at(&basis(x));
        if here > typical { (x, here) } else { (at, typical) }
    };
    let (at, typical) = points.iter().fold((points.first().copied().unwrap_or(0.0), 0.0), largest);
    let here = basis(at);
    let bounds = bounds(setup, observations, &seconds, &weights, &here, limits);
    let term = |((errors, _), moments): (&(Monomial, Product), &Moments)| Contribution {
        name: product_name(setup, errors),
        typical: moments.at(&here),
        bound: bounds.get(errors).copied().unwrap_or(0.0),
    };
    let mut terms: Vec<Contribution> = products.iter().zip(&single).map(term).collect();
    terms.sort_by(|a, b| b.typical.total_cmp(&a.typical));
    Ok(Systematic { at, typical, terms })
}

/// Sweep and direction of each sample.
fn places(observation: &Observation) -> Vec<(f64, f64)> {
    observation.samples.iter().map(|s| (s.sweep, s.direction)).collect()
}

fn pair(errors: &Monomial) -> Option<[ErrorId; 2]> {
    let mut both = errors.errors();
    Some([both.next()?, both.next()?])
}

/// Each function an error is a combination of, at every sample of a run.
type Along = Vec<Vec<f64>>;

/// `Σ w·c·φᵢ·φⱼ` of every product, over all observations.
fn products(
    setup: &Setup,
    observations: &[Observation],
    seconds: &[SecondOrder],
    weights: &[Weights],
) -> Vec<(Monomial, Product)> {
    let shapes: Vec<_> = setup.model.alphabet.errors().map(|(id, ..)| parts(setup, id)).collect();
    let mut products: BTreeMap<Monomial, Product> = BTreeMap::new();
    for (o, (observation, second)) in observations.iter().zip(seconds).enumerate() {
        let sweeps: Vec<f64> = observation.samples.iter().map(|s| s.sweep).collect();
        let exact = setup.exact(observation.run, &sweeps);
        let along = |error: ErrorId| -> Along {
            let axis = setup.model.axis_of(error).map(|(axis, _)| axis);
            let at: Vec<f64> = match axis {
                Some(axis) => exact.run().coordinates(axis).map(|x| x.unwrap_or(0.0)).collect(),
                None => vec![0.0; sweeps.len()],
            };
            shapes[error.index()].iter().map(|shape| at.iter().map(|x| shape.at(*x)).collect()).collect()
        };
        let mut values: BTreeMap<ErrorId, Along> = BTreeMap::new();
        for errors in &second.products {
            let Some(both) = pair(errors) else { continue };
            for e in both {
                values.entry(e).or_insert_with(|| along(e));
            }
            let counts = both.map(|e| shapes[e.index()].len());
            let moves = || vec![0.0; weights.len() * counts[0] * counts[1]];
            products.entry(*errors).or_insert_with(|| Product { errors: both, counts, moves: moves() });
        }
        // Taken out while this run adds to them: a look-up for every sample would cost more than the sums.
        let mut own: Vec<Option<Product>> = second.products.iter().map(|errors| products.remove(errors)).collect();
        let along_of: Vec<[Option<&Along>; 2]> =
            own.iter().map(|p| p.as_ref().map_or([None; 2], |p| p.errors.map(|e| values.get(&e)))).collect();
        second.along(&places(observation), |sample, factors| {
            for ((product, pair), factor) in own.iter_mut().zip(&along_of).zip(factors).filter(|(_, f)| **f != 0.0) {
                let (Some(product), [Some(first), Some(second)]) = (product, pair) else { continue };
                let mut moves = product.moves.iter_mut();
                for weight in weights {
                    let scaled = weight.0[o][sample] * factor;
                    for a in first.iter() {
                        for (b, m) in second.iter().zip(&mut moves) {
                            *m += scaled * a[sample] * b[sample];
                        }
                    }
                }
            }
        });
        products.extend(second.products.iter().zip(own).filter_map(|(errors, product)| Some((*errors, product?))));
    }
    products.into_iter().collect()
}

/// Per product the most it can move the function where its basis is `here`.
fn bounds(
    setup: &Setup,
    observations: &[Observation],
    seconds: &[SecondOrder],
    weights: &[Weights],
    here: &[f64],
    limits: ErrorLimits,
) -> BTreeMap<Monomial, f64> {
    // Signed sums for products of constants, sums of sizes for the others.
    let mut sums: BTreeMap<Monomial, f64> = BTreeMap::new();
    for (o, (observation, second)) in observations.iter().zip(seconds).enumerate() {
        let moving = |m: &Monomial| m.errors().any(|e| setup.model.axis_of(e).is_some());
        let moving: Vec<bool> = second.products.iter().map(moving).collect();
        let mut own = vec![0.0; moving.len()];
        second.along(&places(observation), |sample, factors| {
            let weight: f64 = weights.iter().zip(here).map(|(w, b)| w.0[o][sample] * b).sum();
            for ((sum, factor), moving) in own.iter_mut().zip(factors).zip(&moving) {
                let part = weight * factor;
                *sum += if *moving { part.abs() } else { part };
            }
        });
        for (errors, sum) in second.products.iter().zip(own) {
            *sums.entry(*errors).or_insert(0.0) += sum;
        }
    }
    sums.into_iter().map(|(errors, sum)| (errors, sum.abs() * product_size(setup, &errors, limits))).collect()
}

/// Machines within the limits, the same ones every time.
fn machines(
    setup: &Setup,
    observations: &[Observation],
    limits: ErrorLimits,
) -> impl Iterator<Item = SimulatedMachine> {
    let exact = |o: &Observation| {
        let sweeps = o.samples.iter().map(|s| s.sweep);
        let (low, high) = sweeps.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (l.min(s), h.max(s)));
        setup.exact(o.run, &grid(SCALED_OVER, (low, high)))
    };
    let runs: Vec<ExactReading> = observations.iter().map(exact).collect();
    let machines = Population::new(setup, &runs, limits);
    (0..MACHINES).map(move |n| {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(n);
        machines.draw(&mut random)
    })
}

/// Mean outer product of vectors of coefficients.
struct Moments {
    size: usize,
    sums: Vec<f64>,
}

impl Moments {
    fn new(size: usize) -> Self {
        Self { size, sums: vec![0.0; size * size] }
    }

    fn add(&mut self, vector: &[f64]) {
        let products = vector.iter().flat_map(|a| vector.iter().map(move |b| a * b));
        self.sums.iter_mut().zip(products).for_each(|(s, p)| *s += p);
    }

    /// Root mean square of the function with these values of its basis.
    fn at(&self, basis: &[f64]) -> f64 {
        let row = |(row, b): (&[f64], &f64)| row.iter().zip(basis).map(|(m, c)| m * c).sum::<f64>() * b;
        let square: f64 = self.sums.chunks(self.size.max(1)).zip(basis).map(row).sum();
        (square.max(0.0) / MACHINES as f64).sqrt()
    }
}
