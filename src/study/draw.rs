//! Machines drawn at random within bounds.
//!
//! A location or set-up error is uniform within ± its limit. A motion error is a random combination of its functions, each
//! scaled to a largest value of one over the coordinates of the runs, and the sum is scaled to a largest value uniform
//! between 0 and its limit. A function with a basis is drawn in that basis; one that is known or of which nothing is
//! assumed is a polynomial of degree 2 of a linear axis, or two harmonics of a rotary one that vanish at 0; one assumed
//! to be zero is zero.

use super::limits::ErrorLimits;
use super::setup::Setup;
use rand::{Rng, RngExt};
use trunnion_codegen::algebra::{ErrorId, Quantity, wrapped_value};
use trunnion_codegen::basis::{Arithmetic, Basis, Univariate};
use trunnion_codegen::identify::{Origin, Parameter};
use trunnion_codegen::ids::{BaseId, ParameterId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::model::AxisKind;
use typed_index_collections::TiVec;

/// One machine: a value for every error.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedMachine {
    values: Vec<ErrorShape>,
    /// Of each error, the factors of the functions it is a combination of.
    coefficients: Vec<Vec<f64>>,
}

/// An error's value as a function of its coordinate.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ErrorShape {
    Constant(f64),
    /// Coefficients of x⁰, x¹, …; with a start (in steps of 15°) of the angle less whole turns.
    Polynomial(Vec<f64>, Option<i32>),
    /// `c₀ + Σ cₖ cos kx + sₖ sin kx`
    Harmonics(f64, Vec<(f64, f64)>),
}

impl ErrorShape {
    pub fn at(&self, x: f64) -> f64 {
        match self {
            Self::Constant(v) => *v,
            Self::Polynomial(c, turn) => {
                let x = turn.map_or(x, |start| wrapped_value(x, start));
                c.iter().rev().fold(0.0, |sum, c| sum * x + c)
            }
            Self::Harmonics(constant, waves) => {
                let wave = |(k, (c, s)): (usize, &(f64, f64))| {
                    let (sin, cos) = ((k + 1) as f64 * x).sin_cos();
                    c * cos + s * sin
                };
                constant + waves.iter().enumerate().map(wave).sum::<f64>()
            }
        }
    }

    fn scaled(mut self, factor: f64) -> Self {
        match &mut self {
            Self::Constant(v) => *v *= factor,
            Self::Polynomial(c, _) => c.iter_mut().for_each(|c| *c *= factor),
            Self::Harmonics(constant, waves) => {
                *constant *= factor;
                waves.iter_mut().for_each(|(c, s)| (*c, *s) = (*c * factor, *s * factor));
            }
        }
        self
    }
}

impl ErrorValues for SimulatedMachine {
    fn value(&self, error: ErrorId, coordinate: f64) -> f64 {
        self.values[error.index()].at(coordinate)
    }
}

impl SimulatedMachine {
    /// True value of every physical parameter of the derivation, in its order: mm, rad, or per power of the coordinate.
    pub fn parameters(&self, setup: &Setup) -> TiVec<ParameterId, f64> {
        let value = |p: &Parameter| match p.origin {
            Origin::Constant(error) => self.value(error, 0.0),
            Origin::Coefficient(c) => {
                let error = setup.model.functions[c.function].error;
                self.coefficients[error.index()].get(usize::from(c.term)).copied().unwrap_or(0.0)
            }
        };
        setup.derivation.parameters.iter().map(value).collect()
    }

    /// Factors of the functions an error is a combination of.
    pub(super) fn factors(&self, error: ErrorId) -> &[f64] {
        &self.coefficients[error.index()]
    }

    /// True value of every base parameter.
    pub fn base(&self, setup: &Setup) -> TiVec<BaseId, f64> {
        let parameters = self.parameters(setup);
        setup.definitions().iter().map(|d| d.iter().map(|(j, f)| f * parameters[*j]).sum()).collect()
    }
}

/// Draws a machine. `runs` are the runs to be simulated: they say over which coordinates a function is scaled.
pub fn draw(setup: &Setup, runs: &[ExactReading], limits: ErrorLimits, random: &mut impl Rng) -> SimulatedMachine {
    let model = &setup.model;
    let shape = |(id, ..): (ErrorId, &str, Quantity)| {
        let limit = setup.limit(id, limits);
        let Some((axis, _)) = model.axis_of(id) else {
            let value = uniform(random) * limit;
            return (ErrorShape::Constant(value), vec![value]);
        };
        let coordinates: Vec<f64> = runs.iter().flat_map(|r| r.run().coordinates(axis)).flatten().collect();
        let parts = parts(setup, id);
        let largest = |s: &ErrorShape| coordinates.iter().map(|&x| s.at(x).abs()).fold(0.0, f64::max);
        let inverse = |s: &ErrorShape| Some(largest(s)).filter(|size| *size > 0.0).map_or(0.0, f64::recip);
        let factors: Vec<f64> = parts.iter().map(|s| uniform(random) * inverse(s)).collect();
        let sum = sum(parts.into_iter().zip(&factors).map(|(s, f)| s.scaled(*f)).collect());
        let scale = limit * random.random::<f64>() * inverse(&sum);
        let coefficients = factors.iter().map(|f| f * scale).collect();
        (sum.scaled(scale), coefficients)
    };
    let (values, coefficients) = model.alphabet.errors().map(shape).unzip();
    SimulatedMachine { values, coefficients }
}

/// The functions an error is a combination of: 1 for a location or set-up error.
pub(super) fn parts(setup: &Setup, error: ErrorId) -> Vec<ErrorShape> {
    let Some((axis, _)) = setup.model.axis_of(error) else { return vec![ErrorShape::Constant(1.0)] };
    let kind = setup.model.axis(axis).map_or(AxisKind::Linear, |a| a.kind);
    let mut shapes = Shapes { setup, turn: None };
    match (setup.model.function(error).map(|(_, f)| &f.basis), kind) {
        (Some(Basis::Zero), _) if setup.model.limits.of(error).is_none() => Vec::new(),
        (Some(Basis::Functions(functions)), _) => {
            shapes.turn = functions.turn_from;
            functions.terms.iter().map(|f| f.of(&mut shapes)).collect()
        }
        (None | Some(Basis::Known | Basis::Zero), AxisKind::Linear) => {
            [1, 2].map(|n| shapes.polynomial(&Univariate::power(n))).into()
        }
        (None | Some(Basis::Known | Basis::Zero), AxisKind::Rotary) => {
            let less_one = |cosine| sum(vec![cosine, ErrorShape::Harmonics(-1.0, Vec::new())]);
            [1, 2].into_iter().flat_map(|k| [less_one(shapes.cosine(k)), shapes.sine(k)]).collect()
        }
    }
}

/// Functions of a coordinate as shapes.
struct Shapes<'a> {
    setup: &'a Setup,
    turn: Option<i32>,
}

impl Shapes<'_> {
    fn wave(&self, multiple: u8, wave: (f64, f64)) -> ErrorShape {
        let below = (1..multiple).map(|_| (0.0, 0.0));
        ErrorShape::Harmonics(0.0, below.chain([wave]).collect())
    }
}

impl Arithmetic for Shapes<'_> {
    type Value = ErrorShape;

    fn polynomial(&mut self, f: &Univariate) -> ErrorShape {
        ErrorShape::Polynomial(f.coefficients(&self.setup.model.alphabet, &|n| self.setup.constant(n)), self.turn)
    }

    fn cosine(&mut self, multiple: u8) -> ErrorShape {
        self.wave(multiple, (1.0, 0.0))
    }

    fn sine(&mut self, multiple: u8) -> ErrorShape {
        self.wave(multiple, (0.0, 1.0))
    }
}

fn sum(shapes: Vec<ErrorShape>) -> ErrorShape {
    let add = |a: ErrorShape, b: ErrorShape| match (a, b) {
        (ErrorShape::Polynomial(a, turn), ErrorShape::Polynomial(b, _)) => {
            let at = |c: &[f64], i: usize| c.get(i).copied().unwrap_or(0.0);
            ErrorShape::Polynomial((0..a.len().max(b.len())).map(|i| at(&a, i) + at(&b, i)).collect(), turn)
        }
        (ErrorShape::Harmonics(c, a), ErrorShape::Harmonics(d, b)) => {
            let at = |w: &[(f64, f64)], i: usize| w.get(i).copied().unwrap_or((0.0, 0.0));
            let pair = |i| (at(&a, i).0 + at(&b, i).0, at(&a, i).1 + at(&b, i).1);
            ErrorShape::Harmonics(c + d, (0..a.len().max(b.len())).map(pair).collect())
        }
        (a, _) => a,
    };
    shapes.into_iter().reduce(add).unwrap_or(ErrorShape::Constant(0.0))
}

fn uniform(random: &mut impl Rng) -> f64 {
    random.random_range(-1.0..=1.0)
}
