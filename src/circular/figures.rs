//! From the paths of a test to all of its figures.

use super::circles::{At, Circles, Radial, hysteresis, radial};
use super::direction::Direction;
use super::effects::{Effect, Model, Scatter};
use super::error::{CircularError, Which};
use super::plane::Plane;
use super::spikes::{Spike, spikes};
use super::trace::{Trace, Traces};
use super::undetermined::Undetermined;
use crate::data::Radius;
use thiserror::Error;

/// A deviation beyond this share of the radius is none of a circle.
const LARGEST: f64 = 0.5;

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// The paths.
    pub traces: Traces,
    /// The nominal radius: the bar's length.
    pub radius: Radius,
    /// The axes.
    pub plane: Plane,
    /// The feed along the path, mm/s, if it is known.
    pub feed: Option<f64>,
}

/// The figures of a circular test.
#[derive(Clone, Debug, PartialEq)]
pub struct Circular {
    /// The axes.
    pub plane: Plane,
    /// The nominal radius.
    pub radius: Radius,
    /// The feed along the path, mm/s, if it is known.
    pub feed: Option<f64>,
    /// Each path, clockwise first.
    pub paths: Vec<Path>,
    /// Both together; none of one.
    pub both: Option<Both>,
    /// What is read from the trace.
    pub effects: Vec<Effect>,
    /// What its model leaves; none where there were too few samples for it.
    pub scatter: Option<Scatter>,
    /// Spikes of each path at each reversal.
    pub spikes: Vec<Spike>,
}

/// The figures of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Which way it goes.
    pub direction: Direction,
    /// Samples there are.
    pub samples: usize,
    /// How much of the circle it covers, rad.
    pub arc: f64,
    /// Whether that is all of it.
    pub whole: bool,
    /// Where it begins, rad; none of samples in no order.
    pub start: Option<f64>,
    /// Whether the samples' angles go the other way: those of another path, or brought into order.
    pub against: bool,
    /// G about either centre.
    pub circles: Circles,
    /// F about the centre that the instrument was set to.
    pub radial: Radial,
}

/// The figures of both paths together.
#[derive(Clone, Debug, PartialEq)]
pub struct Both {
    /// G(b) about either centre.
    pub circles: Circles,
    /// F over both.
    pub radial: Radial,
    /// D, mm.
    pub mean_radial: Result<f64, Undetermined>,
    /// H about the least-squares centre of both.
    pub hysteresis: Result<At, Undetermined>,
}

/// What to be wary of.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Warning {
    /// The angles of a path go the other way.
    #[error("the angles of the {0} path go the other way: is it the right file, or was it sorted?")]
    Against(Direction),
}

impl Circular {
    /// What to be wary of.
    pub fn warnings(&self) -> impl Iterator<Item = Warning> {
        self.paths.iter().filter(|path| path.against).map(|path| Warning::Against(path.direction))
    }

    /// F about the least-squares centre of a path, largest and smallest, mm: defined for a full circle.
    ///
    /// # Errors
    /// [`Undetermined::PartialCircle`]
    pub fn centred(&self, path: &Path) -> Result<[f64; 2], Undetermined> {
        if path.whole { Ok(path.circles.radial(self.radius)) } else { Err(Undetermined::PartialCircle) }
    }
}

/// All figures of a test.
///
/// # Errors
/// [`CircularError`]; what a figure lacks is told in its place.
pub fn circular(test: &Test) -> Result<Circular, CircularError> {
    let radius = test.radius;
    let paths = test.traces.each().map(|(direction, trace)| path(direction, trace, radius));
    let paths = paths.collect::<Result<Vec<_>, _>>()?;
    let both = match &test.traces {
        Traces::Both { clockwise, counterclockwise } => Some(both([clockwise, counterclockwise], &paths, radius)?),
        _ => None,
    };
    let model = Model::fit(&test.traces);
    let spikes = spikes(&test.traces, &model);
    let Model { effects, scatter, .. } = model;
    Ok(Circular { plane: test.plane, radius, feed: test.feed, paths, both, effects, scatter, spikes })
}

fn path(direction: Direction, trace: &Trace, radius: Radius) -> Result<Path, CircularError> {
    if let Some((_, deviation)) = trace.samples().iter().find(|(_, d)| d.abs() > LARGEST * radius.mm()) {
        return Err(CircularError::Deviation { direction, deviation: *deviation, radius: radius.mm() });
    }
    let circle = |problem| CircularError::Circle { which: Which::Path(direction), problem };
    let order = trace.order();
    let first = trace.path(direction).first().map(|(angle, _)| angle.rem_euclid(std::f64::consts::TAU));
    Ok(Path {
        direction,
        samples: trace.samples().len(),
        arc: trace.profile().arc(),
        whole: trace.profile().is_whole(),
        start: first.filter(|_| order.is_some()),
        against: order.is_some_and(|order| order != direction),
        circles: Circles::about(&trace.points(radius)).map_err(circle)?,
        radial: radial(trace.samples().iter()),
    })
}

fn both(traces: [&Trace; 2], paths: &[Path], radius: Radius) -> Result<Both, CircularError> {
    let points = traces.map(|trace| trace.points(radius)).concat();
    let circle = |problem| CircularError::Circle { which: Which::Both, problem };
    let circles = Circles::about(&points).map_err(circle)?;
    let whole = paths.iter().all(|path| path.whole);
    let mean_radial = if whole { Ok(circles.radius(radius)) } else { Err(Undetermined::PartialCircle) };
    let hysteresis = hysteresis(traces, radius, circles.least_squares.circle.centre).ok_or(Undetermined::Apart);
    let [one, other] = traces.map(|trace| trace.samples().iter());
    let radial = radial(one.chain(other));
    Ok(Both { circles, radial, mean_radial, hysteresis })
}
