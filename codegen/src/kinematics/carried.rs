//! Where one machine's balls are, its errors put in: a block of samples at a time.

use super::exact::{ExactRun, NumericAxis, NumericNuisance, Side};
use crate::algebra::ErrorId;
use crate::ids::AxisId;
use crate::lanes::{LANES, Lanes};
use crate::model::AxisKind;

/// Values of the errors of one machine: mm and rad.
pub trait ErrorValues {
    /// Value of an error; of a motion error at the coordinate (mm or rad) of its axis.
    fn value(&self, error: ErrorId, coordinate: f64) -> f64;

    /// Values of a motion error at the samples of a block. Whoever knows the run may have worked out before what does not depend
    /// on the machine.
    #[inline(always)]
    fn along(&self, error: ErrorId, at: At, values: &mut Lanes) {
        for (value, &coordinate) in values.iter_mut().zip(at.coordinates) {
            *value = self.value(error, coordinate);
        }
    }
}

/// A block of a run's samples, as an axis is moved there.
#[derive(Clone, Copy, Debug)]
pub struct At<'a> {
    /// The axis.
    pub axis: AxisId,
    /// Which block of the run.
    pub block: usize,
    /// The axis' nominal coordinates; behind the last sample the last block has zeros.
    pub coordinates: &'a Lanes,
}

/// Places, coordinate by coordinate, mm.
pub type Places = [Lanes; 3];

impl ExactRun {
    /// Writes the workpiece ball and the tool ball at the samples of a block. To be inlined where vector instructions are at hand:
    /// then blocks stay where they are, and loops over them are nowhere in a closure that might not be inlined.
    #[inline(always)]
    pub fn balls(&self, block: usize, errors: &impl ErrorValues, [workpiece, tool]: &mut [Places; 2]) {
        let [carries_workpiece, carries_tool] = &self.sides;
        carries_workpiece.ball(block, errors, workpiece);
        carries_tool.ball(block, errors, tool);
    }
}

impl Side {
    /// Carries the ball from the last axis' frame to the machine's.
    #[inline(always)]
    fn ball(&self, block: usize, errors: &impl ErrorValues, point: &mut Places) {
        for (coordinate, nominal) in point.iter_mut().zip(&self.ball) {
            *coordinate = nominal[block];
        }
        for (coordinate, error) in point.iter_mut().zip(self.setup.into_iter().flatten()) {
            let by = errors.value(error, 0.0);
            for c in coordinate.iter_mut() {
                *c += by;
            }
        }
        let mut motion = [[0.0; LANES]; 6];
        for axis in self.axes.iter().rev() {
            axis.carry(block, errors, &mut motion, point);
        }
    }
}

impl NumericAxis {
    #[inline(always)]
    fn carry(&self, block: usize, errors: &impl ErrorValues, motion: &mut [Lanes; 6], point: &mut Places) {
        let nominal = &self.at[block];
        let at = At { axis: self.id, block, coordinates: nominal };
        for (values, error) in motion.iter_mut().zip(self.motion) {
            match error {
                Some(error) => errors.along(error, at, values),
                None => values.fill(0.0),
            }
        }
        let mut moved = None;
        for nuisance in &self.nuisances {
            let to = match nuisance.component {
                Some(component) => &mut motion[component.index()],
                None => moved.get_or_insert(*nominal),
            };
            nuisance.moves(block, errors, to);
        }
        match self.kind {
            AxisKind::Rotary => {
                match moved {
                    None => rotate(&self.direction, &self.turn[0][block], &self.turn[1][block], point),
                    Some(angle) => rotate(&self.direction, &angle.map(f64::sin), &angle.map(f64::cos), point),
                }
                small(motion, point);
            }
            AxisKind::Linear => {
                small(motion, point);
                let travel = moved.as_ref().unwrap_or(nominal);
                for (coordinate, direction) in point.iter_mut().zip(self.direction) {
                    for (c, travel) in coordinate.iter_mut().zip(travel) {
                        *c += travel * direction;
                    }
                }
            }
        }
        if self.location.iter().any(Option::is_some) {
            for (values, error) in motion.iter_mut().zip(self.location) {
                values.fill(error.map_or(0.0, |e| errors.value(e, 0.0)));
            }
            small(motion, point);
        }
    }
}

impl NumericNuisance {
    /// Adds what the term moves.
    #[inline(always)]
    fn moves(&self, block: usize, errors: &impl ErrorValues, to: &mut Lanes) {
        let parameter = errors.value(self.error, 0.0);
        let [a, b, c] = &self.moves;
        let powers = a[block].iter().zip(&b[block]).zip(&c[block]);
        for (to, ((a, b), c)) in to.iter_mut().zip(powers) {
            *to += ((c * parameter + b) * parameter + a) * parameter;
        }
    }
}

/// `[1 −c b x; c 1 −a y; −b a 1 z] · p`
#[inline(always)]
fn small([x, y, z, a, b, c]: &[Lanes; 6], [px, py, pz]: &mut Places) {
    for i in 0..LANES {
        let p = [px[i], py[i], pz[i]];
        px[i] = p[0] - c[i] * p[1] + b[i] * p[2] + x[i];
        py[i] = c[i] * p[0] + p[1] - a[i] * p[2] + y[i];
        pz[i] = -b[i] * p[0] + a[i] * p[1] + p[2] + z[i];
    }
}

/// Rodrigues' rotation about the unit vector `n`.
#[inline(always)]
fn rotate(n: &[f64; 3], sin: &Lanes, cos: &Lanes, [px, py, pz]: &mut Places) {
    for i in 0..LANES {
        let (sin, cos, p) = (sin[i], cos[i], [px[i], py[i], pz[i]]);
        let cross = [n[1] * p[2] - n[2] * p[1], n[2] * p[0] - n[0] * p[2], n[0] * p[1] - n[1] * p[0]];
        let along = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
        let turned = |k: usize| cos * p[k] + sin * cross[k] + (1.0 - cos) * along * n[k];
        (px[i], py[i], pz[i]) = (turned(0), turned(1), turned(2));
    }
}
