//! How an estimate depends on the readings it was made from.

use super::fit::{Fit, Observation};
use super::rows::each_row;
use super::setup::Setup;
use nalgebra::{DMatrix, DVector};

/// ∂ estimate / ∂ reading, for every sample of every observation of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(pub(super) Vec<Vec<f64>>);

impl Weights {
    /// Those of each observation's samples, in the order in which the fit was given them.
    pub fn observations(&self) -> impl Iterator<Item = &[f64]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// The estimate that these readings give, mm at every sample of every observation.
    pub fn apply(&self, readings: &[Vec<f64>]) -> f64 {
        let part = |(weights, y): (&[f64], &Vec<f64>)| weights.iter().zip(y).map(|(w, y)| w * y).sum::<f64>();
        self.observations().zip(readings).map(part).sum()
    }
}

/// What the base parameters of a fit depend on: of each observation the rows, a line for each sample and a column for each base parameter,
/// times the weight.
pub(super) struct Dependence<'a> {
    fit: &'a Fit,
    rows: Vec<DMatrix<f64>>,
}

impl<'a> Dependence<'a> {
    pub fn new(setup: &Setup, observations: &[Observation], fit: &'a Fit) -> Self {
        let rows = |observation: &Observation| {
            let places = fit.places(setup, observation.run);
            let mut rows = DMatrix::zeros(observation.samples.len(), fit.base.len());
            let mut sample = 0;
            each_row(setup, observation, |_, row, _| {
                for (x, place) in row.iter().zip(&places) {
                    if let Some(place) = place {
                        rows[(sample, *place)] = x * observation.weight;
                    }
                }
                sample += 1;
            });
            rows
        };
        Self { fit, rows: observations.iter().map(rows).collect() }
    }

    /// How `functional · base parameters` depends on each reading.
    pub fn weights(&self, functional: &DVector<f64>) -> Weights {
        let of = |(at, rows): (usize, &DMatrix<f64>)| {
            (rows * self.fit.sensitivity_of(at).tr_mul(functional)).as_slice().to_vec()
        };
        Weights(self.rows.iter().enumerate().map(of).collect())
    }
}
