//! What an instrument reads exactly: nothing truncated, at any sizes of the errors.

use crate::kinematics::{ErrorValues, ExactRun, Point};
use crate::model::{Model, ReadingKind, Run, at};

/// The reading at every sample of `exact`, mm: the bar's length less its nominal length, eq. (4), or `n · (TB − WB)`.
///
/// `exact` is `run` worked out with the same `constant`, which gives the set-up's lengths in mm.
pub fn exact_readings<'a>(
    model: &'a Model,
    run: &'a Run,
    exact: &'a ExactRun,
    constant: &'a impl Fn(&str) -> f64,
    errors: &'a impl ErrorValues,
) -> impl Iterator<Item = f64> + 'a {
    let dot = |a: &Point, b: &Point| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let nominal = match &run.reading {
        ReadingKind::BarLength(radius) => constant(&model.alphabet.nominal_name(*radius)),
        ReadingKind::Displacement(_) => 0.0,
    };
    exact.sweeps().zip(exact.balls(errors)).map(move |(sweep, [workpiece, tool])| {
        let v: Point = core::array::from_fn(|k| tool[k] - workpiece[k]);
        match &run.reading {
            ReadingKind::BarLength(_) => dot(&v, &v).sqrt() - nominal,
            ReadingKind::Displacement(direction) => {
                let n = direction.each_ref().map(|p| at(p, &model.alphabet, sweep, constant));
                dot(&n, &v)
            }
        }
    })
}
