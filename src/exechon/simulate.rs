//! Touches in a ring as the machine would make them, without errors but those asked for.

use super::{ALONG, PointError, rotation_at};
use std::f64::consts::PI;
use trunnion_solver::exechon::Machine;
use trunnion_solver::probe::ball;

/// A ring and a probe with an offset in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Centre of the ring, mm.
    pub centre: [f64; 3],
    /// The ring's radius less the stylus ball's, mm.
    pub radius: f64,
    /// The stylus ball's centre less the spindle axis with the tool oriented as at home, mm.
    pub offset: [f64; 2],
}

/// A touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedTouch {
    /// The spindle axis, mm.
    pub position: [f64; 3],
    /// The spindle angle, rad.
    pub spindle: f64,
    /// The dependent rotation there, rad.
    pub rotation: f64,
}

/// Moves the spindle axis from `from` along `direction` (rad from x) until the ball touches the ring; the spindle stands
/// at `spindle`, rad, throughout.
///
/// # Errors
/// [`PointError`] where the machine does not reach.
pub fn simulate(
    machine: &Machine<f64>,
    probe: &Probe,
    from: [f64; 2],
    direction: f64,
    spindle: f64,
) -> Result<SimulatedTouch, PointError> {
    let (s, c) = direction.sin_cos();
    let place = |way: f64| [from[0] + way * c, from[1] + way * s, probe.centre[2]];
    let gap = |way: f64| -> Result<(f64, f64), PointError> {
        let at = place(way);
        let rotation = rotation_at(machine, at, ALONG)?;
        let [x, y] = ball([at[0], at[1]], spindle - rotation, probe.offset);
        Ok(((x - probe.centre[0]).hypot(y - probe.centre[1]) - probe.radius, rotation))
    };
    // The gap grows by nearly one with the way: it is taken off until nothing is left.
    let mut way = probe.radius;
    let mut rotation = 0.0;
    for _ in 0..60 {
        let (open, turned) = gap(way)?;
        (way, rotation) = (way - open, turned);
        if open.abs() < 1e-12 {
            break;
        }
    }
    Ok(SimulatedTouch { position: place(way), spindle, rotation })
}

/// The paper's offset measurement in a ring: four touches that centre the ball, the spindle reversed, four more.
/// `spindle` gives the compensation (rad) at a place the spindle goes to.
///
/// # Errors
/// [`PointError`].
pub(super) fn offset_touches(
    machine: &Machine<f64>,
    probe: &Probe,
    spindle: impl Fn([f64; 3]) -> Result<f64, PointError>,
) -> Result<Vec<SimulatedTouch>, PointError> {
    let [x, y, z] = probe.centre;
    let mut touches = Vec::with_capacity(8);
    for reversed in [0.0, PI] {
        for quarter in 0..4 {
            let direction = f64::from(quarter) * PI / 2.0;
            let nominal = [x + probe.radius * direction.cos(), y + probe.radius * direction.sin(), z];
            touches.push(simulate(machine, probe, [x, y], direction, spindle(nominal)? + reversed)?);
        }
    }
    Ok(touches)
}
