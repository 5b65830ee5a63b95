//! Reversal spikes: what an axis does within a moment after it has turned round.

use super::direction::Direction;
use super::effects::{Model, SETTLING, after};
use super::plane::Reversal;
use super::trace::{Trace, Traces};
use super::undetermined::Undetermined;
use nalgebra::SVector;
use std::f64::consts::TAU;
use trunnion_solver::lstsq::Factor;

/// The level on either side is that of this arc, rad.
const SIDE: f64 = 1.5 * SETTLING;
/// How much of the path has to be there before a reversal and after it, rad.
const BEFORE: f64 = SETTLING;
const AFTER: f64 = 1.5 * SETTLING;
/// What is higher than this many standard deviations is none of the scatter.
const SEEN: f64 = 4.0;

/// The spike of a reversal in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spike {
    /// Where the axis turns round.
    pub reversal: Reversal,
    /// On the way in this direction.
    pub direction: Direction,
    /// Its height, or why that is not told.
    pub height: Result<Height, Undetermined>,
}

/// How high a spike is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// Above the level that the path settles to after it, mm, outwards.
    pub height: f64,
    /// Where its top is, rad from 0 to a turn.
    pub angle: f64,
    /// Its standard deviation by the scatter of the readings on either side, mm.
    pub std: f64,
}

impl Height {
    /// Whether it is more than the readings' scatter makes.
    pub fn stands_out(&self) -> bool {
        self.height.abs() > SEEN * self.std
    }
}

/// Each reversal's spike in each direction.
pub(super) fn spikes(traces: &Traces, model: &Model) -> Vec<Spike> {
    let of = |(direction, trace): (Direction, &Trace)| {
        let residual = |(angle, deviation): &(f64, f64)| (*angle, deviation - model.at(*angle, direction));
        let residuals: Vec<_> = trace.samples().iter().map(residual).collect();
        let from = if direction == Direction::Counterclockwise { -BEFORE } else { -AFTER };
        let spike = |reversal: Reversal| {
            let covered = trace.profile().covers(reversal.angle() + from, BEFORE + AFTER);
            let missed = Undetermined::NoReversal { before: BEFORE, after: AFTER };
            let height = if covered { height(&residuals, reversal, direction) } else { Err(missed) };
            Spike { reversal, direction, height }
        };
        Reversal::ALL.map(spike)
    };
    traces.each().flat_map(of).collect()
}

/// Before the reversal and after the moment the residuals have a level each and one slope: `b·[t < 0] + a·[t > 0] + s t`.
fn height(residuals: &[(f64, f64)], reversal: Reversal, direction: Direction) -> Result<Height, Undetermined> {
    let timed = || residuals.iter().map(|(a, r)| (after(reversal, *a, direction), *a, *r));
    let mut factor = Factor::<f64, 3>::new();
    let (mut before, mut later) = (0, 0);
    for (t, _, residual) in timed().filter(|(t, ..)| (-SIDE..0.0).contains(t) || beside(*t)) {
        let side = if t < 0.0 { &mut before } else { &mut later };
        *side += 1;
        let row = SVector::from(if t < 0.0 { [1.0, 0.0, t] } else { [0.0, 1.0, t] });
        factor.push(&row, residual).map_err(|_| Undetermined::Samples)?;
    }
    if before < 3 || later < 3 {
        return Err(Undetermined::Samples);
    }
    let level = factor.solve().map_err(|_| Undetermined::Samples)?;
    let settled = |t: f64| SVector::from([0.0, 1.0, t]);
    let moment = timed().filter(|(t, ..)| (0.0..=SETTLING).contains(t));
    let heights = moment.map(|(t, angle, residual)| (residual - settled(t).dot(&level.coefficients), t, angle));
    let top = heights.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).ok_or(Undetermined::Samples)?;
    // A reading scatters, and so does the level that it is compared with.
    let variance = level.variance_of(&settled(top.1)).ok_or(Undetermined::Samples)?;
    let std = level.residual_std.hypot(variance.max(0.0).sqrt());
    Ok(Height { height: top.0, angle: top.2.rem_euclid(TAU), std })
}

/// After the moment in which a spike may be.
fn beside(t: f64) -> bool {
    SETTLING < t && t <= SETTLING + SIDE
}
