//! The data of a run.

use super::setup::Setup;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::directions;

/// A reading whose size is beyond this is none a ball-bar gives: twice its stroke, mm.
pub(crate) const BEYOND_STROKE_MM: f64 = 2.0;

/// An angle beyond this many turns is none of a run.
pub(crate) const MOST_TURNS: f64 = 10.0;

/// One sample of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The sweep, rad.
    pub sweep: f64,
    /// Which way the sweep goes: 1 increasing, −1 decreasing, 0 where that is not known.
    pub direction: f64,
    /// The reading, mm.
    pub reading: f64,
    /// Values of the run's known functions (mm or rad), in the order of its derivation.
    pub known: Vec<f64>,
    /// Their standard uncertainties; none where they are not stated.
    pub known_std: Vec<f64>,
}

/// The data of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The run.
    pub run: RunId,
    /// Weight of each sample: one over the variance of its reading, up to a common factor.
    pub weight: f64,
    /// Its samples.
    pub samples: Vec<Sample>,
}

impl Observation {
    /// A run at the given sweeps (rad), in the order in which they are visited, with all readings zero: for what does not depend on readings.
    pub fn zero(setup: &Setup, run: RunId, sweeps: &[f64]) -> Self {
        let known = vec![0.0; setup.derivation.runs[run].known.len()];
        let samples = sweeps
            .iter()
            .zip(directions(sweeps))
            .map(|(&sweep, direction)| Sample {
                sweep,
                direction,
                reading: 0.0,
                known: known.clone(),
                known_std: Vec::new(),
            })
            .collect();
        Self { run, weight: 1.0, samples }
    }
}
