//! What an instrument reads on a drawn machine.

use super::draw::SimulatedMachine;
use super::fit::{Observation, Sample};
use super::setup::Setup;
use std::f64::consts::TAU;
use trunnion_codegen::algebra::{Monomial, Nominal, Rational, at};
use trunnion_codegen::ids::{AxisId, RunId};
use trunnion_codegen::kinematics::{ErrorValues, directions};
use trunnion_codegen::measurement::ExactReading;

/// `samples` equal steps over `range` (rad), the end left out: a whole turn does not visit its start twice.
pub fn grid(samples: usize, range: (f64, f64)) -> Vec<f64> {
    (0..samples).map(|i| step(i, samples, range)).collect()
}

/// One of the steps of [`grid`].
pub(super) fn step(i: usize, samples: usize, range: (f64, f64)) -> f64 {
    range.0 + (range.1 - range.0) * i as f64 / samples as f64
}

impl Setup {
    /// The sweep of a run at `samples` equal steps over `range` (rad), as far as its axes go; there and back where the run has
    /// terms that turn with the direction.
    pub fn swept(&self, run: RunId, samples: usize, range: (f64, f64)) -> Vec<f64> {
        self.both_ways(run, grid(samples, self.sweep_range(run, range)))
    }

    /// Whether a run has terms that turn with the direction.
    pub(super) fn goes_back(&self, run: RunId) -> bool {
        !self.model.runs[run].nuisance.is_empty()
    }

    /// `there`, and back where the run has terms that turn with the direction.
    pub fn both_ways(&self, run: RunId, mut there: Vec<f64>) -> Vec<f64> {
        if self.goes_back(run) {
            there.extend_from_within(..);
            let back = there.len() / 2;
            there[back..].reverse();
        }
        there
    }

    /// All runs at these places with all readings zero: for what does not depend on readings.
    pub fn unread(&self, samples: usize, range: (f64, f64)) -> Vec<Observation> {
        let runs = self.model.runs.keys();
        runs.map(|run| Observation::zero(self, run, &self.swept(run, samples, range))).collect()
    }

    /// A run and its instrument at the given values of its sweep, rad: what it reads comes from full 4×4 products, nothing
    /// linearised.
    pub fn exact(&self, run: RunId, sweeps: &[f64]) -> ExactReading {
        ExactReading::new(&self.model, &self.model.runs[run], sweeps, &|n| self.constant(n))
    }

    /// Nominal coordinates of an axis at the given values of a run's sweep (rad), mm or rad; none at rest.
    pub(super) fn coordinates(&self, run: RunId, axis: AxisId, sweeps: &[f64]) -> Vec<f64> {
        let along = self.model.runs[run].at[axis].poly();
        let value =
            |poly| sweeps.iter().map(|&sweep| at(poly, &self.model.alphabet, sweep, |n| self.constant(n))).collect();
        along.map_or(Vec::new(), value)
    }

    /// The same along sweeps in their order, as an axis gets from one to the next: an angle that is given by its sine and cosine goes
    /// on where it has come to half a turn.
    pub(super) fn followed(&self, run: RunId, axis: AxisId, sweeps: &[f64]) -> Vec<f64> {
        let alphabet = &self.model.alphabet;
        let is_arctangent = |(m, _): &(Monomial, Rational)| {
            alphabet.nominals().any(|(id, own)| matches!(own, Nominal::Arctangent { .. }) && m.exponent(id) != 0)
        };
        let mut along = self.coordinates(run, axis, sweeps);
        if self.model.runs[run].at[axis].poly().is_some_and(|poly| poly.terms().iter().any(is_arctangent)) {
            for i in 1..along.len() {
                along[i] -= TAU * ((along[i] - along[i - 1]) / TAU).round();
            }
        }
        along
    }

    /// A run as measured on `machine` at `sweeps`, those of `exact`: its exact readings with what `noise` gives (mm) added to
    /// each in turn, and the true values of its known functions.
    pub fn observe(
        &self,
        run: RunId,
        exact: &ExactReading,
        sweeps: &[f64],
        machine: &SimulatedMachine,
        mut noise: impl FnMut() -> f64,
    ) -> Observation {
        let known = self.true_known(run, exact, machine);
        let sample = |(i, ((&sweep, direction), clean)): (usize, ((&f64, f64), f64))| Sample {
            sweep,
            direction,
            reading: clean + noise(),
            known: known.get(i).cloned().unwrap_or_default(),
            known_std: Vec::new(),
        };
        let samples =
            sweeps.iter().zip(directions(sweeps)).zip(exact.values(machine)).enumerate().map(sample).collect();
        Observation { run, weight: 1.0, samples }
    }

    /// True values of a run's known functions at its samples, mm or rad, in the order of its derivation.
    pub fn true_known(&self, run: RunId, exact: &ExactReading, machine: &SimulatedMachine) -> Vec<Vec<f64>> {
        let mut at_samples: Vec<Vec<f64>> = Vec::new();
        for (function, _) in &self.derivation.runs[run].known {
            let error = self.model.functions[*function].error;
            let Some((axis, _)) = self.model.axis_of(error) else { continue };
            let values = exact.run().coordinates(axis).map(|x| machine.value(error, x.unwrap_or(0.0)));
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
