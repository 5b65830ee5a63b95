//! Errors as functions of a coordinate, and the functions they are combinations of.

use super::coordinates::{Coordinates, PART};
use super::setup::Setup;
use std::collections::BTreeSet;
use trunnion_codegen::algebra::{ErrorId, wrapped_value};
use trunnion_codegen::basis::{Arithmetic, Basis, Univariate};
use trunnion_codegen::graph::Lanes;
use trunnion_codegen::model::AxisKind;

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

    /// The same at a block of coordinates, operation by operation.
    #[inline(always)]
    pub fn along(&self, coordinates: &Coordinates, block: usize, values: &mut Lanes) {
        match self {
            Self::Constant(v) => values.fill(*v),
            Self::Polynomial(c, turn) => {
                let x = coordinates.of_turn(*turn, block);
                for (values, x) in values.as_chunks_mut::<PART>().0.iter_mut().zip(x.as_chunks::<PART>().0) {
                    let mut sum = [0.0; PART];
                    for c in c.iter().rev() {
                        for (sum, x) in sum.iter_mut().zip(x) {
                            *sum = *sum * x + c;
                        }
                    }
                    *values = sum;
                }
            }
            Self::Harmonics(constant, waves) => {
                values.fill(0.0);
                for (k, (c, s)) in waves.iter().enumerate() {
                    coordinates.wave(k + 1, block, |cos, sin| {
                        for (value, (cos, sin)) in values.iter_mut().zip(cos.iter().zip(sin)) {
                            *value += c * cos + s * sin;
                        }
                    });
                }
                for value in values.iter_mut() {
                    *value += constant;
                }
            }
        }
    }

    /// `Σ factor · part`
    pub fn combination<'a>(parts: impl IntoIterator<Item = (&'a Self, f64)>) -> Self {
        let mut parts = parts.into_iter();
        let Some((first, factor)) = parts.next() else { return Self::Constant(0.0) };
        let mut sum = first.clone();
        sum.scale(factor);
        parts.for_each(|(part, factor)| sum.add(part, factor));
        sum
    }

    pub fn scale(&mut self, factor: f64) {
        match self {
            Self::Constant(v) => *v *= factor,
            Self::Polynomial(c, _) => c.iter_mut().for_each(|c| *c *= factor),
            Self::Harmonics(constant, waves) => {
                *constant *= factor;
                waves.iter_mut().for_each(|(c, s)| (*c, *s) = (*c * factor, *s * factor));
            }
        }
    }

    /// Adds `factor · part`, of the same kind.
    fn add(&mut self, part: &Self, factor: f64) {
        match (self, part) {
            (Self::Polynomial(a, _), Self::Polynomial(b, _)) => {
                a.resize(a.len().max(b.len()), 0.0);
                a.iter_mut().zip(b).for_each(|(a, b)| *a += b * factor);
            }
            (Self::Harmonics(c, a), Self::Harmonics(d, b)) => {
                *c += d * factor;
                a.resize(a.len().max(b.len()), (0.0, 0.0));
                a.iter_mut().zip(b).for_each(|(a, b)| *a = (a.0 + b.0 * factor, a.1 + b.1 * factor));
            }
            _ => {}
        }
    }
}

/// Coordinates for errors that are combinations of `shapes`.
pub(super) fn coordinates<'a>(x: Vec<f64>, shapes: impl IntoIterator<Item = &'a ErrorShape>) -> Coordinates {
    let (mut harmonics, mut starts) = (0, BTreeSet::new());
    for shape in shapes {
        match shape {
            ErrorShape::Constant(_) => {}
            ErrorShape::Polynomial(_, turn) => starts.extend(turn),
            ErrorShape::Harmonics(_, waves) => harmonics = harmonics.max(waves.len()),
        }
    }
    Coordinates::new(x, harmonics, starts)
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
            let constant = ErrorShape::Harmonics(1.0, Vec::new());
            let less_one = |cosine| ErrorShape::combination([(&cosine, 1.0), (&constant, -1.0)]);
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
