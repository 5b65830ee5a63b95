//! The picture of a ball-bar test: radial deviations around the circle, magnified.

use super::canvas::{Anchor, Canvas, FRAME, GRID, PAPER, ZERO, draw, width};
use super::line::{draw_mark, legend};
use super::series::{Extent, Mark, PlotError, Scale, Series};
use super::ticks::Ticks;

const SIZE: f64 = 560.0;
const TITLE: f64 = 40.0;
const LEGEND: f64 = 28.0;
const TEXT: f64 = 13.0;
/// The largest deviation's circle, pixels.
const OUTER: f64 = 225.0;
/// The smallest deviation's circle as a share of it: what is inside carries nothing.
const INNER: f64 = 0.4;
/// Ticks are written along this angle, between two spokes, in degrees.
const SCALE_AT: f64 = 75.0;

/// A polar chart: angle in degrees counter-clockwise from the right, deviation outward.
///
/// Points of a series are (angle in degrees, deviation). A series over a whole turn is closed, an arc is not.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarChart {
    /// Above the circle; may be empty.
    pub title: String,
    /// What is drawn outward, and its unit.
    pub deviation: Scale,
    /// Drawn in this order, later ones on top.
    pub series: Vec<Series>,
}

/// Where the circle is and how deviations grow outward.
struct Dial {
    centre: (f64, f64),
    ticks: Ticks,
}

impl Dial {
    fn at(&self, (degrees, deviation): (f64, f64)) -> (f64, f64) {
        let (low, high) = self.ticks.range;
        let radius = OUTER * (INNER + (1.0 - INNER) * (deviation - low) / (high - low));
        let (s, c) = degrees.to_radians().sin_cos();
        (self.centre.0 + radius * c, self.centre.1 - radius * s)
    }

    fn ring(&self, deviation: f64) -> impl Iterator<Item = (f64, f64)> {
        (0..=180).map(move |at| self.at((2.0 * f64::from(at), deviation)))
    }
}

impl PolarChart {
    /// The chart as SVG text.
    ///
    /// # Errors
    /// [`PlotError`] where there are no points or values that cannot be drawn.
    pub fn svg(&self) -> Result<String, PlotError> {
        let extent = Extent::of(&self.series, 1)?;
        // Zero, the nominal circle, is always on the picture.
        let ticks = Ticks::decimal((extent.y.0.min(0.0), extent.y.1.max(0.0)), 6);
        let top = if self.title.is_empty() { 8.0 } else { TITLE };
        let dial = Dial { centre: (SIZE / 2.0, top + LEGEND + 30.0 + OUTER), ticks };
        let height = dial.centre.1 + OUTER + 34.0;
        let closed: Vec<Series> = self.series.iter().map(close).collect();
        draw((SIZE as u32, height as u32), |canvas| {
            if !self.title.is_empty() {
                canvas.text(&self.title, (SIZE / 2.0, TITLE * 0.55), TEXT + 3.0, Anchor::Centre)?;
            }
            legend(canvas, &self.series, (24.0, top + LEGEND / 2.0))?;
            grid(canvas, &dial)?;
            scale(canvas, &dial)?;
            closed.iter().try_for_each(|series| draw_mark(canvas, series, |point| dial.at(point)))?;
            let unit = self.deviation.title();
            canvas.text(&unit, (SIZE - 24.0 - width(&unit, TEXT) / 2.0, top + LEGEND / 2.0), TEXT, Anchor::Centre)
        })
    }
}

fn grid(canvas: &Canvas, dial: &Dial) -> Result<(), PlotError> {
    let (low, high) = dial.ticks.range;
    for spoke in (0..360).step_by(30).map(f64::from) {
        canvas.line([dial.at((spoke, low)), dial.at((spoke, high))], GRID)?;
        let beyond = high + (high - low) * 18.0 / OUTER / (1.0 - INNER);
        canvas.text(&format!("{spoke}°"), dial.at((spoke, beyond)), TEXT, Anchor::Centre)?;
    }
    for tick in &dial.ticks.at {
        canvas.line(dial.ring(*tick), if *tick == 0.0 { ZERO } else { GRID })?;
    }
    canvas.line(dial.ring(high), FRAME)
}

/// The ticks' values, each just inside its circle.
fn scale(canvas: &Canvas, dial: &Dial) -> Result<(), PlotError> {
    let size = TEXT - 2.0;
    dial.ticks.at.iter().try_for_each(|tick| {
        let (label, (x, on)) = (dial.ticks.label(*tick), dial.at((SCALE_AT, *tick)));
        let (y, half) = (on + 10.0, width(&label, size) / 2.0 + 2.0);
        let (left, right, above, below) = (x - half, x + half, y - 7.0, y + 7.0);
        canvas.area([(left, above), (right, above), (right, below), (left, below)], PAPER)?;
        canvas.text(&label, (x, y), size, Anchor::Centre)
    })
}

/// A series whose points go round the whole turn, joined at its ends.
fn close(series: &Series) -> Series {
    let mut closed = series.clone();
    match &mut closed.mark {
        Mark::Line(points) | Mark::Dashed(points) => join(points, |point| point.0),
        Mark::Band(points) => join(points, |point| point.0),
    }
    closed
}

/// A gap no wider than three of the mean steps is one between neighbours.
fn join<P: Copy>(points: &mut Vec<P>, angle: impl Fn(&P) -> f64) {
    let (Some(first), Some(last)) = (points.first().copied(), points.last().copied()) else {
        return;
    };
    let span = (angle(&last) - angle(&first)).abs();
    let step = span / points.len() as f64;
    if points.len() > 2 && 360.0 - span <= 3.0 * step {
        points.push(first);
    }
}
