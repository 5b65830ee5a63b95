//! The same chains in numbers: full 4×4 products of the same matrices, nothing dropped.
//!
//! What a simulated instrument reads comes from here, so that a fit is never tested against its own linear model.

use crate::algebra::{ErrorId, Poly, at};
use crate::ids::AxisId;
use crate::model::{Axis, AxisKind, Ball, Model, Run};
use typed_index_collections::TiVec;

/// Values of the errors of one machine: mm and rad.
pub trait ErrorValues {
    /// Value of an error; of a motion error at the coordinate (mm or rad) of its axis.
    fn value(&self, error: ErrorId, coordinate: f64) -> f64;
}

/// A place in machine coordinates, mm.
pub type Place = [f64; 3];

/// A run with everything nominal worked out at each of its samples; only the errors are missing.
#[derive(Clone, Debug)]
pub struct ExactRun {
    sides: [Vec<NumericAxis>; 2],
    setups: [Option<[ErrorId; 3]>; 2],
    stations: Vec<Station>,
}

#[derive(Clone, Debug)]
struct NumericAxis {
    kind: AxisKind,
    direction: Place,
    location: [Option<ErrorId>; 6],
    motion: [Option<ErrorId>; 6],
}

/// Nominal coordinates (`None` at rest) and balls at one value of the sweep.
#[derive(Clone, Debug)]
struct Station {
    coordinates: TiVec<AxisId, Option<f64>>,
    balls: [Place; 2],
}

impl ExactRun {
    /// Works out `run` at the given values of its sweep (rad); `constant` gives the set-up's lengths in mm.
    pub fn new(model: &Model, run: &Run, sweeps: &[f64], constant: &impl Fn(&str) -> f64) -> Self {
        let value = |p: &Poly, sweep: f64| at(p, &model.alphabet, sweep, constant);
        let ball = |b: &Ball, sweep: f64| core::array::from_fn(|i| value(&b.at[i], sweep));
        let kept = |error: Option<ErrorId>| error.filter(|e| !run.left_out.contains(e));
        let axis = |a: &Axis| NumericAxis {
            kind: a.kind,
            direction: core::array::from_fn(|i| value(&a.direction[i], 0.0)),
            location: a.location.map(kept),
            motion: a.motion.map(|e| kept(Some(e))),
        };
        let station = |&sweep: &f64| Station {
            coordinates: run.at.iter().map(|c| c.poly().map(|p| value(p, sweep))).collect(),
            balls: [ball(&run.workpiece_ball, sweep), ball(&run.tool_ball, sweep)],
        };
        Self {
            sides: [model.workpiece.iter().map(axis).collect(), model.tool.iter().map(axis).collect()],
            setups: [run.workpiece_ball.setup, run.tool_ball.setup],
            stations: sweeps.iter().map(station).collect(),
        }
    }

    /// The workpiece ball and the tool ball at every sample.
    pub fn balls<'a>(&'a self, errors: &'a impl ErrorValues) -> impl Iterator<Item = [Place; 2]> + 'a {
        self.stations.iter().map(|station| {
            let (workpiece, tool) = station.coordinates.raw.split_at(self.sides[0].len());
            let [w, t] = station.balls;
            [
                position(&self.sides[0], workpiece, w, self.setups[0], errors),
                position(&self.sides[1], tool, t, self.setups[1], errors),
            ]
        })
    }

    /// Nominal coordinate of an axis at every sample; `None` at rest.
    pub fn coordinates(&self, axis: AxisId) -> impl Iterator<Item = Option<f64>> {
        self.stations.iter().map(move |s| s.coordinates[axis])
    }
}

fn position(
    axes: &[NumericAxis],
    coordinates: &[Option<f64>],
    ball: Place,
    setup: Option<[ErrorId; 3]>,
    errors: &impl ErrorValues,
) -> Place {
    let mut point: Place = core::array::from_fn(|i| ball[i] + setup.map_or(0.0, |s| errors.value(s[i], 0.0)));
    for (axis, coordinate) in axes.iter().zip(coordinates).rev() {
        let &Some(coordinate) = coordinate else { continue };
        let motion = axis.motion.map(|e| e.map_or(0.0, |e| errors.value(e, coordinate)));
        point = match axis.kind {
            AxisKind::Rotary => small(&motion, rotate(&axis.direction, coordinate, point)),
            AxisKind::Linear => {
                let moved = small(&motion, point);
                core::array::from_fn(|i| moved[i] + coordinate * axis.direction[i])
            }
        };
        point = small(&axis.location.map(|e| e.map_or(0.0, |e| errors.value(e, 0.0))), point);
    }
    point
}

/// `[1 −c b x; c 1 −a y; −b a 1 z] · p`
fn small([x, y, z, a, b, c]: &[f64; 6], [px, py, pz]: Place) -> Place {
    [px - c * py + b * pz + x, c * px + py - a * pz + y, -b * px + a * py + pz + z]
}

/// Rodrigues' rotation of `p` about the unit vector `n`.
fn rotate(n: &Place, angle: f64, p: Place) -> Place {
    let (sin, cos) = angle.sin_cos();
    let cross = [n[1] * p[2] - n[2] * p[1], n[2] * p[0] - n[0] * p[2], n[0] * p[1] - n[1] * p[0]];
    let along = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    core::array::from_fn(|i| cos * p[i] + sin * cross[i] + (1.0 - cos) * along * n[i])
}
