//! What an instrument reads exactly: nothing truncated, at any sizes of the errors.

use crate::algebra::at;
use crate::kinematics::{ErrorValues, ExactRun, Place};
use crate::model::{Model, ReadingKind, Run};

/// A run and its instrument with everything nominal worked out at each of its samples; only the errors are missing.
#[derive(Clone, Debug)]
pub struct ExactReading {
    run: ExactRun,
    instrument: Instrument,
}

#[derive(Clone, Debug)]
enum Instrument {
    /// The bar's nominal length, mm.
    Bar(f64),
    /// The unit vector at every sample.
    Displacement(Vec<Place>),
}

impl ExactReading {
    /// Works out `run` at the given values of its sweep (rad); `constant` gives the set-up's lengths in mm.
    pub fn new(model: &Model, run: &Run, sweeps: &[f64], constant: &impl Fn(&str) -> f64) -> Self {
        let instrument = match &run.reading {
            ReadingKind::BarLength(radius) => Instrument::Bar(constant(&model.alphabet.nominal_name(*radius))),
            ReadingKind::Displacement(direction) => {
                let value = |sweep: &f64| direction.each_ref().map(|p| at(p, &model.alphabet, *sweep, constant));
                Instrument::Displacement(sweeps.iter().map(value).collect())
            }
        };
        Self { run: ExactRun::new(model, run, sweeps, constant), instrument }
    }

    /// The machine along the run.
    pub fn run(&self) -> &ExactRun {
        &self.run
    }

    /// The reading at every sample, mm: the bar's length less its nominal length, T(4), or `n · (TB − WB)`.
    pub fn values<'a>(&'a self, errors: &'a impl ErrorValues) -> impl Iterator<Item = f64> + 'a {
        self.run.balls(errors).enumerate().map(move |(i, [workpiece, tool])| {
            let v: Place = core::array::from_fn(|k| tool[k] - workpiece[k]);
            let dot = |a: &Place, b: &Place| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            match &self.instrument {
                Instrument::Bar(radius) => dot(&v, &v).sqrt() - radius,
                Instrument::Displacement(directions) => directions.get(i).map_or(0.0, |n| dot(n, &v)),
            }
        })
    }
}
