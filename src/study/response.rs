//! How far disturbances of the readings move the base parameters: the estimate is linear in the readings.

use super::fit::{Fit, Observation, Sample};
use super::rows::each_row;
use super::setup::Setup;
use nalgebra::DMatrix;
use trunnion_codegen::graph::LANES;

/// A sample whose reading is disturbed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disturbed<'a> {
    /// Which of the observations it is in.
    pub observation: usize,
    /// The sample.
    pub sample: &'a Sample,
    /// Factors of the run's known functions in the reading.
    pub factors: &'a [f64],
}

impl Fit {
    /// What `count` disturbances add to the base parameters, a column for each; `of` writes what they add to a reading, mm.
    pub(super) fn responses(
        &self,
        setup: &Setup,
        observations: &[Observation],
        count: usize,
        mut of: impl FnMut(Disturbed, &mut [f64]),
    ) -> DMatrix<f64> {
        let mut responses = DMatrix::zeros(self.base.len(), count);
        if count == 0 {
            return responses;
        }
        // A product of matrices for many samples at once: column by column what is disturbed, and where it goes.
        let (mut rows, mut by) = (DMatrix::zeros(self.base.len(), LANES), DMatrix::zeros(count, LANES));
        for (at, observation) in observations.iter().enumerate() {
            let places = self.places(setup, observation.run);
            let mut sum = DMatrix::zeros(self.base.len(), count);
            let mut samples = 0;
            rows.fill(0.0);
            each_row(setup, observation, |sample, row, factors| {
                let lane = samples % LANES;
                by.column_mut(lane).fill(0.0);
                of(Disturbed { observation: at, sample, factors }, by.column_mut(lane).as_mut_slice());
                for (x, place) in row.iter().zip(&places).filter_map(|(x, place)| Some((x, (*place)?))) {
                    rows[(place, lane)] = *x;
                }
                samples += 1;
                if samples % LANES == 0 {
                    sum.gemm(observation.weight, &rows, &by.transpose(), 1.0);
                }
            });
            let rest = samples % LANES;
            sum.gemm(observation.weight, &rows.columns(0, rest), &by.columns(0, rest).transpose(), 1.0);
            responses += self.sensitivity_of(at) * sum;
        }
        responses
    }
}

#[cfg(test)]
mod tests {
    use crate::study::{ErrorLimits, Estimator, Simulation, fit};
    use crate::{Setup, study::Observation};

    #[test]
    fn a_response_is_the_difference_of_two_fits() {
        let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
        let simulation =
            Simulation { seed: 7, samples: 60, noise_um: 0.1, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) };
        let mut observations: Vec<Observation> = simulation.measure(&setup).observations.raw;
        observations[1].weight = 3.0;
        for estimator in [Estimator::Joint, Estimator::TwoStep] {
            let before = fit(&setup, &observations, estimator).unwrap();
            let disturbance = |at: usize, sweep: f64| if at == 0 { 1e-3 * (2.0 * sweep).cos() } else { 5e-4 * sweep };
            let responses = before.responses(&setup, &observations, 1, |d, by| {
                by[0] = disturbance(d.observation, d.sample.sweep);
            });
            let mut disturbed = observations.clone();
            for (at, o) in disturbed.iter_mut().enumerate() {
                o.samples.iter_mut().for_each(|s| s.reading += disturbance(at, s.sweep));
            }
            let after = fit(&setup, &disturbed, estimator).unwrap();
            let moved = after.values - before.values;
            for (a, b) in moved.iter().zip(responses.iter()) {
                assert!((a - b).abs() <= 1e-9 * responses.amax(), "{estimator}: {a} {b}");
            }
        }
    }
}
