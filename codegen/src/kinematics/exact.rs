//! The same chains in numbers, with everything nominal worked out: full 4×4 products of the same matrices, nothing dropped.
//!
//! What a simulated instrument reads comes from here, so that a fit is never tested against its own linear model. Along a run
//! all numbers stand in blocks of [`LANES`](crate::graph::LANES) samples.

use super::direction::directions;
use crate::algebra::{ErrorId, Poly, at, nominal_value};
use crate::ids::AxisId;
use crate::iso::Component;
use crate::lanes::{Lanes, in_blocks};
use crate::model::{Axis, AxisKind, Ball, Model, Nuisance, NuisanceKind, Run};
use typed_index_collections::TiVec;

/// A run with everything nominal worked out at each of its samples; only the errors are missing.
#[derive(Clone, Debug)]
pub struct ExactRun {
    /// The workpiece's and the tool's.
    pub(super) sides: [Side; 2],
    coordinates: TiVec<AxisId, Option<Vec<f64>>>,
    samples: usize,
}

/// A ball and the axes that carry it, from the base outwards; one at rest moves nothing.
#[derive(Clone, Debug)]
pub(super) struct Side {
    pub axes: Vec<NumericAxis>,
    pub ball: [Vec<Lanes>; 3],
    pub setup: Option<[ErrorId; 3]>,
}

#[derive(Clone, Debug)]
pub(super) struct NumericAxis {
    pub id: AxisId,
    pub kind: AxisKind,
    pub direction: [f64; 3],
    pub location: [Option<ErrorId>; 6],
    pub motion: [Option<ErrorId>; 6],
    /// Its nominal coordinate.
    pub at: Vec<Lanes>,
    /// Sine and cosine of that, of a rotary axis.
    pub turn: [Vec<Lanes>; 2],
    pub nuisances: Vec<NumericNuisance>,
}

/// A nuisance term: what it moves by its parameter.
#[derive(Clone, Debug)]
pub(super) struct NumericNuisance {
    pub error: ErrorId,
    /// The motion it moves; `None` for the coordinate itself.
    pub component: Option<Component>,
    /// By how much: factors of its parameter, its square and its cube.
    pub moves: [Vec<Lanes>; 3],
}

impl ExactRun {
    /// Works out `run` at the given values of its sweep (rad), in the order in which they are visited; `constant` gives the
    /// set-up's lengths in mm.
    pub fn new(model: &Model, run: &Run, sweeps: &[f64], constant: &impl Fn(&str) -> f64) -> Self {
        let value = |p: &Poly, sweep: f64| at(p, &model.alphabet, sweep, constant);
        let along = |p: &Poly| sweeps.iter().map(|&sweep| value(p, sweep)).collect::<Vec<f64>>();
        let coordinates: TiVec<AxisId, Option<Vec<f64>>> = run.at.iter().map(|c| c.poly().map(along)).collect();
        let directions = directions(sweeps);
        let nuisance = |n: &Nuisance| {
            let slopes = slopes(model, run, n);
            let moves = |(&sweep, &direction): (&f64, &f64)| -> [f64; 3] {
                let sense = nominal_value(n.sense, &model.alphabet, sweep, constant) * direction;
                match n.kind {
                    NuisanceKind::Backlash | NuisanceKind::LateralPlay(_) => {
                        [if n.against { -0.5 * sense } else { 0.5 * sense }, 0.0, 0.0]
                    }
                    // Taylor's series of the coordinate at the sweep less the lag; at 1 mrad its end is 10⁻¹¹ mm.
                    NuisanceKind::Lag => [
                        -value(&slopes[0], sweep) * direction,
                        value(&slopes[1], sweep) / 2.0 * direction.powi(2),
                        -value(&slopes[2], sweep) / 6.0 * direction,
                    ],
                }
            };
            let moves: Vec<[f64; 3]> = sweeps.iter().zip(&directions).map(moves).collect();
            NumericNuisance {
                error: n.error,
                component: if let NuisanceKind::LateralPlay(component) = n.kind { Some(component) } else { None },
                moves: core::array::from_fn(|power| in_blocks(moves.iter().map(|m| m[power]))),
            }
        };
        let kept = |error: Option<ErrorId>| error.filter(|e| !run.left_out.contains(e));
        let axis = |(id, a): (AxisId, &Axis)| {
            let at = coordinates[id].as_deref()?;
            let turns = if a.kind == AxisKind::Rotary { at } else { &[] };
            Some(NumericAxis {
                id,
                kind: a.kind,
                direction: core::array::from_fn(|i| value(&a.direction[i], 0.0)),
                location: a.location.map(kept),
                motion: a.motion.map(|e| kept(Some(e))),
                at: in_blocks(at.iter().copied()),
                turn: [f64::sin, f64::cos].map(|of| in_blocks(turns.iter().map(|&angle| of(angle)))),
                nuisances: run.nuisance.iter().filter(|n| n.axis == id).map(nuisance).collect(),
            })
        };
        let side = |first: usize, axes: &[Axis], ball: &Ball| Side {
            axes: axes.iter().enumerate().filter_map(|(i, a)| axis((AxisId::from(first + i), a))).collect(),
            ball: ball.at.each_ref().map(|p| in_blocks(along(p))),
            setup: ball.setup,
        };
        let sides =
            [side(0, &model.workpiece, &run.workpiece_ball), side(model.workpiece.len(), &model.tool, &run.tool_ball)];
        Self { sides, coordinates, samples: sweeps.len() }
    }

    /// How many samples it has.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Nominal coordinate of an axis at every sample; `None` at rest.
    pub fn coordinates(&self, axis: AxisId) -> impl Iterator<Item = Option<f64>> {
        let along = self.coordinates[axis].as_deref();
        (0..self.samples).map(move |sample| along.map(|along| along[sample]))
    }
}

/// Of what lags, its coordinate's first three derivatives along the sweep.
fn slopes(model: &Model, run: &Run, nuisance: &Nuisance) -> [Poly; 3] {
    if nuisance.kind != NuisanceKind::Lag {
        return Default::default();
    }
    let mut derivative = run.at[nuisance.axis].poly().cloned().unwrap_or_default();
    [(); 3].map(|()| {
        // A description whose derivatives overflow has been refused: the first one is in the reading.
        derivative = derivative.derivative(run.sweep, &model.alphabet).unwrap_or_default();
        derivative.clone()
    })
}
