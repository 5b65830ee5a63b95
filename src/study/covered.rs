//! Over which coordinates of its axis an estimate says something of a function.

use super::fit::Observation;
use super::setup::Setup;
use std::f64::consts::TAU;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::AxisKind;

/// Of the coordinates that were visited, the most that is taken as a gap between samples.
const SHARE: f64 = 0.05;

/// Coordinates between which an axis was measured, mm or rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// The lowest.
    pub low: f64,
    /// The highest.
    pub high: f64,
    /// The largest gap between two neighbours: so much beyond either end counts as measured, too.
    pub step: f64,
    /// Whether they, with that, are a whole turn of a function that repeats over each: then all turns are measured.
    pub whole_turn: bool,
}

impl Covered {
    /// Of measured runs; `None` where the axis moves in none of them.
    pub fn of(setup: &Setup, function: FunctionId, observations: &[Observation]) -> Option<Self> {
        let (axis, _) = setup.model.axis_of(setup.model.functions[function].error)?;
        let ways = observations.iter().map(|o| {
            let sweeps: Vec<f64> = o.samples.iter().map(|s| s.sweep).collect();
            setup.coordinates(o.run, axis, &sweeps)
        });
        let mut visited: Vec<f64> = ways.filter(|way| way.len() > 1).flatten().collect();
        visited.sort_by(f64::total_cmp);
        let (low, high) = (*visited.first()?, *visited.last()?);
        let gap = visited.windows(2).map(|two| two[1] - two[0]).fold(0.0, f64::max);
        let step = gap.min(SHARE * (high - low));
        let turns = setup.axis(function).is_some_and(|axis| axis.kind == AxisKind::Rotary);
        // A whole turn is often measured without its end, which is its beginning.
        let whole_turn = turns && high - low + 2.0 * step >= TAU && repeats(setup, function);
        (low < high).then_some(Self { low, high, step, whole_turn })
    }

    /// Whether a range is within it, mm or rad.
    pub fn has(&self, (low, high): (f64, f64)) -> bool {
        let slack = self.step + 1e-9 * (1.0 + low.abs().max(high.abs()));
        self.whole_turn || (low >= self.low - slack && high <= self.high + slack)
    }
}

/// Whether a function is the same a turn further.
fn repeats(setup: &Setup, function: FunctionId) -> bool {
    let same = |x: f64| {
        let (here, there) = (setup.basis(function, x), setup.basis(function, x + TAU));
        here.iter().zip(&there).all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + a.abs()))
    };
    [-2.0, -0.3, 0.7, 1.9, 4.1].into_iter().all(same)
}
