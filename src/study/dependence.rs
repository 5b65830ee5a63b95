//! How what is estimated depends on each reading.

use super::fit::{Fit, Observation};
use super::rows::each_row;
use super::seen::Seen;
use super::setup::Setup;
use super::weights::Weights;
use nalgebra::{DMatrix, DMatrixView, DVector};
use trunnion_codegen::ids::{BaseId, FunctionId};

impl Fit {
    /// How the value of a function at `x` depends on each reading.
    pub fn sensitivity(&self, setup: &Setup, observations: &[Observation], function: FunctionId, x: f64) -> Weights {
        Dependence::new(setup, observations, self).weights(&self.functional(setup, function, x))
    }

    /// How a base parameter depends on each reading.
    pub fn coefficient_sensitivity(&self, setup: &Setup, observations: &[Observation], base: BaseId) -> Weights {
        Dependence::new(setup, observations, self).weights(&self.coefficient(base))
    }

    /// How the coefficients of a function, as it is seen, depend on each reading.
    pub fn coefficient_sensitivities(&self, setup: &Setup, observations: &[Observation], seen: &Seen) -> Vec<Weights> {
        Dependence::new(setup, observations, self).of_coefficients(seen)
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

    /// What disturbances of one observation's readings add to the base parameters, a column for each; a line for each sample, mm.
    pub fn responses(&self, observation: usize, disturbances: DMatrixView<f64>) -> DMatrix<f64> {
        self.fit.sensitivity_of(observation) * self.rows[observation].tr_mul(&disturbances)
    }

    /// How the coefficients of a function, as it is seen, depend on each reading.
    pub fn of_coefficients(&self, seen: &Seen) -> Vec<Weights> {
        seen.combinations().map(|combination| self.weights(&self.fit.placed([(combination, 1.0)]))).collect()
    }

    /// How `functional · base parameters` depends on each reading.
    pub fn weights(&self, functional: &DVector<f64>) -> Weights {
        let of = |(at, rows): (usize, &DMatrix<f64>)| {
            (rows * self.fit.sensitivity_of(at).tr_mul(functional)).as_slice().to_vec()
        };
        Weights(self.rows.iter().enumerate().map(of).collect())
    }
}
