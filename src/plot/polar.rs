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
/// Ticks are written along one of these angles, between two spokes, in degrees: where the fewest points are in their way.
const SCALE_AT: [f64; 12] = [75.0, 105.0, 45.0, 135.0, 15.0, 165.0, 285.0, 255.0, 315.0, 225.0, 345.0, 195.0];
/// A point nearer to a tick's text than this is in its way, pixels.
const NEAR: f64 = 16.0;

/// A polar chart: angle in degrees counter-clockwise from the right, deviation outward.
///
/// Points of a series are (angle in degrees, deviation). A series over a whole turn is closed, an arc is not.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarChart {
    /// Above the circle; may be empty.
    pub title: String,
    /// What is drawn outward, and its unit.
    pub deviation: Scale,
    /// What stands around the circle.
    pub rim: Rim,
    /// Drawn in this order, later ones on top.
    pub series: Vec<Series>,
}

/// What stands at the spokes of a polar chart.
#[derive(Clone, Debug, PartialEq)]
pub enum Rim {
    /// Their angles.
    Degrees,
    /// The same, but the positive and negative ends of two axes, the first one to the right, the second one upwards.
    Axes([String; 2]),
}

impl Rim {
    fn label(&self, degrees: u32) -> String {
        match (self, degrees) {
            (Self::Axes([first, _]), 0) => format!("+{first}"),
            (Self::Axes([_, second]), 90) => format!("+{second}"),
            (Self::Axes([first, _]), 180) => format!("\u{2212}{first}"),
            (Self::Axes([_, second]), 270) => format!("\u{2212}{second}"),
            _ => format!("{degrees}°"),
        }
    }
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
        let height = dial.centre.1 + OUTER + 58.0;
        let closed: Vec<Series> = self.series.iter().map(close).collect();
        draw((SIZE as u32, height as u32), |canvas| {
            if !self.title.is_empty() {
                canvas.text(&self.title, (SIZE / 2.0, TITLE * 0.55), TEXT + 3.0, Anchor::Centre)?;
            }
            legend(canvas, &self.series, (24.0, top + LEGEND / 2.0))?;
            grid(canvas, &dial, &self.rim)?;
            closed.iter().try_for_each(|series| draw_mark(canvas, series, |point| dial.at(point)))?;
            scale(canvas, &dial, &closed)?;
            let Scale { label, unit } = &self.deviation;
            let step = dial.ticks.label(dial.ticks.step());
            let unit = unit.map_or_else(String::new, |unit| format!(" {}", unit.symbol()));
            let division = format!("{label}: {step}{unit} a division");
            canvas.text(&division, (SIZE / 2.0, height - 14.0), TEXT, Anchor::Centre)
        })
    }
}

fn grid(canvas: &Canvas, dial: &Dial, rim: &Rim) -> Result<(), PlotError> {
    let (low, high) = dial.ticks.range;
    for degrees in (0..360).step_by(30) {
        let spoke = f64::from(degrees);
        canvas.line([dial.at((spoke, low)), dial.at((spoke, high))], GRID)?;
        let beyond = high + (high - low) * 18.0 / OUTER / (1.0 - INNER);
        canvas.text(&rim.label(degrees), dial.at((spoke, beyond)), TEXT, Anchor::Centre)?;
    }
    for tick in &dial.ticks.at {
        canvas.line(dial.ring(*tick), if *tick == 0.0 { ZERO } else { GRID })?;
    }
    canvas.line(dial.ring(high), FRAME)
}

/// Where a tick's value stands: just inside its circle.
fn beside(dial: &Dial, degrees: f64, tick: f64) -> (f64, f64) {
    let (x, y) = dial.at((degrees, tick));
    let (dx, dy) = (x - dial.centre.0, y - dial.centre.1);
    let inward = 1.0 - 10.0 / dx.hypot(dy);
    (dial.centre.0 + inward * dx, dial.centre.1 + inward * dy)
}

/// The ticks' values.
fn scale(canvas: &Canvas, dial: &Dial, series: &[Series]) -> Result<(), PlotError> {
    let size = TEXT - 2.0;
    let points: Vec<_> = series.iter().flat_map(|series| series.mark.points()).map(|point| dial.at(point)).collect();
    let in_the_way = |degrees: f64| {
        let texts: Vec<_> = dial.ticks.at.iter().map(|tick| beside(dial, degrees, *tick)).collect();
        points.iter().filter(|(x, y)| texts.iter().any(|(u, v)| (x - u).hypot(y - v) < NEAR)).count()
    };
    let free = SCALE_AT.into_iter().min_by_key(|degrees| in_the_way(*degrees)).unwrap_or_default();
    dial.ticks.at.iter().try_for_each(|tick| {
        let (label, (x, y)) = (dial.ticks.label(*tick), beside(dial, free, *tick));
        let half = width(&label, size) / 2.0 + 2.0;
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
        Mark::Arrow(_) => {}
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
    if points.len() > 2 && (360.0 - span).abs() <= 3.0 * step {
        points.push(first);
    }
}
