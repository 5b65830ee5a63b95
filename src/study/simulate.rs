//! What an ideal instrument reads on a drawn machine.

use super::draw::Machine;
use super::setup::Setup;
use trunnion_codegen::kinematics::{ErrorValues, ExactRun};
use trunnion_codegen::measurement::exact_readings;

/// `samples` equal steps over `range` (rad), the end left out: a whole turn does not visit its start twice.
pub fn grid(samples: usize, range: (f64, f64)) -> Vec<f64> {
    (0..samples).map(|i| range.0 + (range.1 - range.0) * i as f64 / samples as f64).collect()
}

/// The exact readings of a run on `machine`, mm: full 4×4 products, nothing linearised.
pub fn readings(setup: &Setup, run: usize, exact: &ExactRun, machine: &Machine) -> Vec<f64> {
    exact_readings(&setup.model, &setup.model.runs[run], exact, &|name| setup.constant(name), machine).collect()
}

impl Setup {
    /// A run at the given values of its sweep, rad.
    pub fn exact_run(&self, run: usize, sweeps: &[f64]) -> ExactRun {
        ExactRun::new(&self.model, &self.model.runs[run], sweeps, &|n| self.constant(n))
    }

    /// True values of a run's known functions at its samples, mm or rad, in the order of its derivation.
    pub fn true_known(&self, run: usize, exact: &ExactRun, machine: &Machine) -> Vec<Vec<f64>> {
        let mut at_samples: Vec<Vec<f64>> = Vec::new();
        for (function, _) in &self.derivation.runs[run].known {
            let error = self.model.functions[*function].error;
            let Some((axis, _)) = self.model.axis_of(error) else { continue };
            let values = exact.coordinates(axis).map(|x| machine.value(error, x.unwrap_or(0.0)));
            for (i, value) in values.enumerate() {
                match at_samples.get_mut(i) {
                    Some(sample) => sample.push(value),
                    None => at_samples.push(vec![value]),
                }
            }
        }
        at_samples
    }
}
