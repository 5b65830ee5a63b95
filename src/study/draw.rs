//! Machines with random errors within limits.
//!
//! A motion error is a random combination of functions, scaled so that it is as large as it may be, or smaller, at the
//! coordinates that the runs visit: the functions assumed of it, where there are any; else x and x² of a linear axis, or two
//! harmonics of a rotary one that vanish at 0; one assumed to be zero is zero.

use super::coordinates::Coordinates;
use super::limits::ErrorLimits;
use super::setup::Setup;
use super::shape::{ErrorShape, coordinates, parts};
use rand::{Rng, RngExt};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::graph::LANES;
use trunnion_codegen::identify::{Origin, Parameter};
use trunnion_codegen::ids::{AxisId, BaseId, ParameterId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use trunnion_solver::sized::{Work, vectorised};
use typed_index_collections::TiVec;

/// One machine: a value for every error.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedMachine {
    values: Vec<ErrorShape>,
    /// Of each error, the factors of the functions it is a combination of.
    coefficients: Vec<Vec<f64>>,
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

    /// An error as a function of its coordinate.
    pub(super) fn shape(&self, error: ErrorId) -> &ErrorShape {
        &self.values[error.index()]
    }

    /// True value of every base parameter.
    pub fn base(&self, setup: &Setup) -> TiVec<BaseId, f64> {
        let parameters = self.parameters(setup);
        setup.definitions().iter().map(|d| d.iter().map(|(j, f)| f * parameters[*j]).sum()).collect()
    }
}

/// The machines within limits.
#[derive(Clone, Debug)]
pub struct Population {
    errors: Vec<Law>,
    /// Where each axis' errors are scaled.
    over: TiVec<AxisId, Coordinates>,
}

/// How an error is drawn.
#[derive(Clone, Debug)]
enum Law {
    /// A location or set-up error, by its limit.
    Constant(f64),
    /// A motion error.
    Motion {
        limit: f64,
        axis: AxisId,
        /// The functions it is a combination of, each with what makes it as large as 1.
        parts: Vec<(ErrorShape, f64)>,
    },
}

impl Population {
    /// Machines to be measured along `runs`: they say over which coordinates a function is scaled.
    pub fn new<'a>(setup: &Setup, runs: impl IntoIterator<Item = &'a ExactReading>, limits: ErrorLimits) -> Self {
        let runs: Vec<&ExactReading> = runs.into_iter().collect();
        let model = &setup.model;
        let all: Vec<(ErrorId, Vec<ErrorShape>)> =
            model.alphabet.errors().map(|(id, ..)| (id, parts(setup, id))).collect();
        let axis_of = |id: ErrorId| model.axis_of(id).map(|(axis, _)| axis);
        let over = |axis: AxisId| {
            // Runs that take an axis along the same way count once.
            let mut ways: Vec<Vec<f64>> = Vec::new();
            for run in &runs {
                let way: Vec<f64> = run.run().coordinates(axis).flatten().collect();
                if !ways.contains(&way) {
                    ways.push(way);
                }
            }
            let own = all.iter().filter(|(id, _)| axis_of(*id) == Some(axis));
            coordinates(ways.concat(), own.flat_map(|(_, shapes)| shapes))
        };
        let over: TiVec<AxisId, Coordinates> = (0..model.axes().count()).map(|axis| over(axis.into())).collect();
        let drawn = |(id, shapes): (ErrorId, Vec<ErrorShape>)| {
            let limit = setup.limit(id, limits);
            let Some(axis) = axis_of(id) else { return Law::Constant(limit) };
            let parts = shapes.into_iter().map(|shape| {
                let inverse = inverse(&shape, &over[axis]);
                (shape, inverse)
            });
            Law::Motion { limit, axis, parts: parts.collect() }
        };
        Self { errors: all.into_iter().map(drawn).collect(), over }
    }

    /// Draws one of them.
    pub fn draw(&self, random: &mut impl Rng) -> SimulatedMachine {
        let shape = |drawn: &Law| match drawn {
            Law::Constant(limit) => {
                let value = uniform(random) * limit;
                (ErrorShape::Constant(value), vec![value])
            }
            Law::Motion { limit, axis, parts } => {
                let mut factors: Vec<f64> = parts.iter().map(|(_, inverse)| uniform(random) * inverse).collect();
                let mut sum =
                    ErrorShape::combination(parts.iter().map(|(shape, _)| shape).zip(factors.iter().copied()));
                let scale = limit * random.random::<f64>() * inverse(&sum, &self.over[*axis]);
                factors.iter_mut().for_each(|f| *f *= scale);
                sum.scale(scale);
                (sum, factors)
            }
        };
        let (values, coefficients) = self.errors.iter().map(shape).unzip();
        SimulatedMachine { values, coefficients }
    }
}

/// What makes a shape as large as 1 at its largest; 0 of one that is zero there.
fn inverse(shape: &ErrorShape, over: &Coordinates) -> f64 {
    let size = vectorised(Largest { shape, over });
    if size > 0.0 { size.recip() } else { 0.0 }
}

/// The largest size of a shape.
struct Largest<'a> {
    shape: &'a ErrorShape,
    over: &'a Coordinates,
}

impl Work for Largest<'_> {
    type Output = f64;

    #[inline(always)]
    fn work(self) -> f64 {
        let (mut most, mut values) = ([0.0; LANES], [0.0; LANES]);
        for block in 0..self.over.blocks() {
            self.shape.along(self.over, block, &mut values);
            for (most, value) in most.iter_mut().zip(values.map(f64::abs)) {
                *most = if value > *most { value } else { *most };
            }
        }
        most.into_iter().fold(0.0, f64::max)
    }
}

fn uniform(random: &mut impl Rng) -> f64 {
    random.random_range(-1.0..=1.0)
}
