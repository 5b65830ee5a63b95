//! The paper's experiments (section 4) on the model.

use super::simulate::offset_touches;
use super::{
    ALONG, Compensation, CompensationError, PointError, Probe, RingError, RingReport, ring_report, rotation_at,
    simulate,
};
use std::f64::consts::{PI, TAU};
use trunnion_solver::exechon::Machine;
use trunnion_solver::probe::{ProbeError, Touch, offset};

/// The paper's setting ring, diameter in mm (Table 2; Table 4 calls it a radius).
const RING: f64 = 40.001;
/// A stylus ball's diameter, mm; the paper does not name its own.
const BALL: f64 = 6.0;
/// The paper's offset (Table 3), mm.
const OFFSET: [f64; 2] = [0.210, 0.160];
/// Standard deviation of a touch, mm: 0.25 µm are two (Table 2).
const TOUCH: f64 = 0.125e-3;
/// Centres of the rings: Table 3's two, and that of Fig. 9 and Table 4.
pub const RING_CENTRES: [[f64; 3]; 3] =
    [[-0.625, 200.914, -168.0], [-319.135, 198.236, -168.0], [-316.081, 247.037, -166.817]];

/// A row of Table 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetRow {
    /// Centre of the ring, mm.
    pub centre: [f64; 3],
    /// Whether the spindle followed the dependent rotation.
    pub compensated: bool,
    /// What the paper measured, mm.
    pub paper: [f64; 2],
    /// What the model gives, mm.
    pub model: [f64; 2],
    /// Its standard uncertainty from the probe's repeatability, mm.
    pub uncertainty: [f64; 2],
}

/// All of section 4 on the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiments {
    /// Table 3.
    pub offsets: [OffsetRow; 3],
    /// φ at the first ring less φ at the second, rad; the paper's −16.3°.
    pub between_rings: f64,
    /// Fig. 8, around the first ring.
    pub quintic: Compensation,
    /// Fig. 9 and Table 4 without compensation.
    pub plain: RingReport,
    /// Fig. 9 and Table 4 with compensation by the quintic.
    pub compensated: RingReport,
}

/// Why the experiments cannot be shown on a machine.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// Out of reach.
    #[error(transparent)]
    Point(#[from] PointError),
    /// No quintic.
    #[error(transparent)]
    Compensation(#[from] CompensationError),
    /// No offset.
    #[error(transparent)]
    Probe(#[from] ProbeError),
    /// No circle.
    #[error(transparent)]
    Ring(#[from] RingError),
}

/// Simulates section 4 on a machine, with a probe offset of (0.210, 0.160) mm and no other error.
///
/// # Errors
/// [`ExperimentError`] where the machine does not reach the paper's positions.
pub fn experiments(machine: &Machine<f64>) -> Result<Experiments, ExperimentError> {
    let radius = (RING - BALL) / 2.0;
    let row = |centre: [f64; 3], compensated: bool, paper: [f64; 2]| -> Result<OffsetRow, ExperimentError> {
        let probe = Probe { centre, radius, offset: OFFSET };
        let spindle = |at| if compensated { rotation_at(machine, at, ALONG) } else { Ok(0.0) };
        let touches = offset_touches(machine, &probe, spindle)?;
        // What the operator takes the probe's orientation to be: as at home, then reversed.
        let taken = touches.iter().zip([0.0, 0.0, 0.0, 0.0, PI, PI, PI, PI]);
        let touches: Vec<_> =
            taken.map(|(t, turned)| Touch { position: [t.position[0], t.position[1]], turned }).collect();
        let fit = offset(&touches, TOUCH)?;
        let uncertainty = [fit.covariance[(0, 0)].sqrt(), fit.covariance[(1, 1)].sqrt()];
        Ok(OffsetRow { centre, compensated, paper, model: fit.offset, uncertainty })
    };
    let offsets = [
        row(RING_CENTRES[0], true, [0.210, 0.160])?,
        row(RING_CENTRES[1], true, [0.212, 0.163])?,
        row(RING_CENTRES[1], false, [0.253, 0.097])?,
    ];
    let between_rings = rotation_at(machine, RING_CENTRES[0], ALONG)? - rotation_at(machine, RING_CENTRES[1], ALONG)?;
    let quintic = Compensation::fit(machine, RING_CENTRES[0], radius, 36)?;

    let probe = Probe { centre: RING_CENTRES[2], radius, offset: OFFSET };
    let follow = Compensation::fit(machine, RING_CENTRES[2], radius, 36)?;
    let test = |spindle: &dyn Fn(f64) -> f64| -> Result<RingReport, ExperimentError> {
        let mut points = Vec::new();
        for k in 0..36 {
            let theta = TAU * f64::from(k) / 36.0;
            let touch = simulate(machine, &probe, [RING_CENTRES[2][0], RING_CENTRES[2][1]], theta, spindle(theta))?;
            points.push((touch.position, touch.spindle));
        }
        Ok(ring_report(machine, &points, None, TAU / 36.0)?)
    };
    let plain = test(&|_| 0.0)?;
    let compensated = test(&|theta| follow.at(theta))?;
    Ok(Experiments { offsets, between_rings, quintic, plain, compensated })
}
