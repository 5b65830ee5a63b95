//! The same chains in numbers: full 4×4 products of the same matrices, nothing dropped.
//!
//! What a simulated instrument reads comes from here, so that a fit is never tested against its own linear model.

use super::direction::directions;
use crate::algebra::{ErrorId, Poly, at, nominal_value};
use crate::ids::AxisId;
use crate::iso::Component;
use crate::model::{Axis, AxisKind, Ball, Model, Nuisance, NuisanceKind, Run};
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
    nuisances: Vec<NumericNuisance>,
    stations: Vec<Station>,
}

#[derive(Clone, Debug)]
struct NumericAxis {
    kind: AxisKind,
    direction: Place,
    location: [Option<ErrorId>; 6],
    motion: [Option<ErrorId>; 6],
}

/// A nuisance term: what it moves by its parameter.
#[derive(Clone, Debug)]
struct NumericNuisance {
    error: ErrorId,
    axis: AxisId,
    /// The motion it moves; `None` for the coordinate itself.
    component: Option<Component>,
}

/// Nominal coordinates (`None` at rest) and balls at one value of the sweep.
#[derive(Clone, Debug)]
struct Station {
    coordinates: TiVec<AxisId, Option<f64>>,
    balls: [Place; 2],
    /// By how much each nuisance term moves: factors of its parameter, its square and its cube.
    moves: Vec<[f64; 3]>,
}

impl ExactRun {
    /// Works out `run` at the given values of its sweep (rad), in the order in which they are visited; `constant` gives the
    /// set-up's lengths in mm.
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
        let nuisance = |n: &Nuisance| NumericNuisance {
            error: n.error,
            axis: n.axis,
            component: if let NuisanceKind::LateralPlay(component) = n.kind { Some(component) } else { None },
        };
        let slopes: Vec<[Poly; 3]> = run.nuisance.iter().map(|n| slopes(model, run, n)).collect();
        let moves = |(n, [first, second, third]): (&Nuisance, &[Poly; 3]), sweep: f64, direction: f64| {
            let sense = nominal_value(n.sense, &model.alphabet, sweep, constant) * direction;
            match n.kind {
                NuisanceKind::Backlash | NuisanceKind::LateralPlay(_) => {
                    [if n.against { -0.5 * sense } else { 0.5 * sense }, 0.0, 0.0]
                }
                // Taylor's series of the coordinate at the sweep less the lag; at 1 mrad its end is 10⁻¹¹ mm.
                NuisanceKind::Lag => [
                    -value(first, sweep) * direction,
                    value(second, sweep) / 2.0 * direction.powi(2),
                    -value(third, sweep) / 6.0 * direction,
                ],
            }
        };
        let station = |(&sweep, direction): (&f64, f64)| Station {
            coordinates: run.at.iter().map(|c| c.poly().map(|p| value(p, sweep))).collect(),
            balls: [ball(&run.workpiece_ball, sweep), ball(&run.tool_ball, sweep)],
            moves: run.nuisance.iter().zip(&slopes).map(|term| moves(term, sweep, direction)).collect(),
        };
        Self {
            sides: [model.workpiece.iter().map(axis).collect(), model.tool.iter().map(axis).collect()],
            setups: [run.workpiece_ball.setup, run.tool_ball.setup],
            nuisances: run.nuisance.iter().map(nuisance).collect(),
            stations: sweeps.iter().zip(directions(sweeps)).map(station).collect(),
        }
    }

    /// The workpiece ball and the tool ball at every sample.
    pub fn balls<'a>(&'a self, errors: &'a impl ErrorValues) -> impl Iterator<Item = [Place; 2]> + 'a {
        let tool = self.sides[0].len();
        self.stations.iter().map(move |station| {
            let [w, t] = station.balls;
            [self.position(0, 0, station, w, errors), self.position(1, tool, station, t, errors)]
        })
    }

    /// Carries a ball from the last axis' frame of a side, whose first axis is `first`, to the machine's.
    fn position(&self, side: usize, first: usize, station: &Station, ball: Place, errors: &impl ErrorValues) -> Place {
        let setup = self.setups[side];
        let mut point: Place = core::array::from_fn(|i| ball[i] + setup.map_or(0.0, |s| errors.value(s[i], 0.0)));
        for (id, axis) in self.sides[side].iter().enumerate().rev() {
            let id = AxisId::from(first + id);
            let Some(nominal) = station.coordinates[id] else { continue };
            let mut motion = axis.motion.map(|e| e.map_or(0.0, |e| errors.value(e, nominal)));
            let mut coordinate = nominal;
            for (nuisance, [a, b, c]) in self.nuisances.iter().zip(&station.moves).filter(|(n, _)| n.axis == id) {
                let parameter = errors.value(nuisance.error, 0.0);
                let moved = ((c * parameter + b) * parameter + a) * parameter;
                match nuisance.component {
                    Some(component) => motion[component.index()] += moved,
                    None => coordinate += moved,
                }
            }
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

    /// Nominal coordinate of an axis at every sample; `None` at rest.
    pub fn coordinates(&self, axis: AxisId) -> impl Iterator<Item = Option<f64>> {
        self.stations.iter().map(move |s| s.coordinates[axis])
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
