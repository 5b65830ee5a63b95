//! Line charts: panels one below the other over a common x axis.

use std::f64::consts::FRAC_PI_6;

use super::canvas::{Anchor, Canvas, FRAME, GRID, Ink, ZERO, draw, width as width_of};
use super::series::{Extent, Mark, PlotError, Scale, Series, Tone};
use super::ticks::Ticks;
use trunnion_codegen::quantity::Unit;

const LEFT: f64 = 78.0;
const RIGHT: f64 = 24.0;
const TITLE: f64 = 40.0;
const LEGEND: f64 = 26.0;
const BOTTOM: f64 = 50.0;
/// How large a chart is.
#[derive(Clone, Copy)]
struct Size {
    width: f64,
    /// Of the first panel.
    first: f64,
    /// Of those below it.
    other: f64,
}

const LARGE: Size = Size { width: 760.0, first: 270.0, other: 150.0 };
const SMALL: Size = Size { width: 500.0, first: 165.0, other: 110.0 };
const TEXT: f64 = 13.0;

/// A line chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Above the panels; may be empty.
    pub title: String,
    /// The common x axis.
    pub x: Scale,
    /// From top to bottom.
    pub panels: Vec<Panel>,
}

/// One panel of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Its y axis.
    pub y: Scale,
    /// Drawn in this order, later ones on top.
    pub series: Vec<Series>,
}

/// A panel's place on the sheet and its axes.
struct Frame<'a> {
    width: f64,
    x: &'a Ticks,
    y: Ticks,
    top: f64,
    height: f64,
}

impl Frame<'_> {
    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let across = LEFT + share(x, self.x.range) * (self.width - LEFT - RIGHT);
        (across, self.top + (1.0 - share(y, self.y.range)) * self.height)
    }
}

impl Chart {
    /// The chart as SVG text.
    ///
    /// # Errors
    /// [`PlotError`] for a panel without points or with values that cannot be drawn.
    pub fn svg(&self) -> Result<String, PlotError> {
        self.drawn(LARGE)
    }

    /// The same for half the width of a page.
    ///
    /// # Errors
    /// The same.
    pub fn small_svg(&self) -> Result<String, PlotError> {
        self.drawn(SMALL)
    }

    fn drawn(&self, Size { width, first, other }: Size) -> Result<String, PlotError> {
        let extents = (1..).zip(&self.panels).map(|(at, panel)| Extent::of(&panel.series, at));
        let extents = extents.collect::<Result<Vec<_>, _>>()?;
        let all = extents.iter().copied().reduce(Extent::join).ok_or(PlotError::NoPoints { panel: 1 })?;
        let x = if self.x.unit == Some(Unit::Deg) { Ticks::degrees(all.x) } else { Ticks::decimal(all.x, 8) };
        let mut top = if self.title.is_empty() { 8.0 } else { TITLE };
        let mut frames = Vec::new();
        for (at, extent) in extents.iter().enumerate() {
            let (height, most) = if at == 0 { (first, 6) } else { (other, 4) };
            top += LEGEND;
            frames.push(Frame { width, x: &x, y: Ticks::decimal(extent.y, most), top, height });
            top += height + 12.0;
        }
        let bottom = top - 12.0;
        draw((width as u32, (bottom + BOTTOM) as u32), |canvas| {
            if !self.title.is_empty() {
                canvas.text(&self.title, (width / 2.0, TITLE * 0.55), TEXT + 3.0, Anchor::Centre)?;
            }
            for (frame, panel) in frames.iter().zip(&self.panels) {
                axes(canvas, frame, &panel.y)?;
                legend(canvas, &panel.series, (LEFT, frame.top - LEGEND / 2.0))?;
                panel.series.iter().try_for_each(|series| draw_mark(canvas, series, |point| frame.at(point)))?;
            }
            for tick in &x.at {
                let across = LEFT + (tick - x.range.0) / (x.range.1 - x.range.0) * (width - LEFT - RIGHT);
                canvas.text(&x.label(*tick), (across, bottom + 15.0), TEXT, Anchor::Centre)?;
            }
            let middle = (LEFT + width - RIGHT) / 2.0;
            canvas.text(&self.x.title(), (middle, bottom + 37.0), TEXT + 1.0, Anchor::Centre)
        })
    }
}

fn axes(canvas: &Canvas, frame: &Frame, y: &Scale) -> Result<(), PlotError> {
    let ((x0, x1), (y0, y1)) = (frame.x.range, frame.y.range);
    for tick in &frame.x.at {
        canvas.line([frame.at((*tick, y0)), frame.at((*tick, y1))], GRID)?;
    }
    for tick in &frame.y.at {
        let ink = if *tick == 0.0 { ZERO } else { GRID };
        let (left, right) = (frame.at((x0, *tick)), frame.at((x1, *tick)));
        canvas.line([left, right], ink)?;
        canvas.text(&frame.y.label(*tick), (left.0 - 8.0, left.1), TEXT, Anchor::Right)?;
    }
    canvas.line([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)].map(|corner| frame.at(corner)), FRAME)?;
    canvas.text(&y.title(), (20.0, frame.top + frame.height / 2.0), TEXT + 1.0, Anchor::Upward)
}

/// Names with a sample of their line, in a row.
pub(crate) fn legend(canvas: &Canvas, series: &[Series], (mut x, y): (f64, f64)) -> Result<(), PlotError> {
    for Series { name, tone, mark } in series.iter().filter(|series| !series.name.is_empty()) {
        let end = x + 26.0;
        match mark {
            Mark::Line(_) => canvas.line([(x, y), (end, y)], Ink::line(*tone))?,
            Mark::Dashed(_) => canvas.dashed([(x, y), (end, y)], Ink::line(*tone))?,
            Mark::Band(_) => {
                let corners = [(x, y - 5.0), (end, y - 5.0), (end, y + 5.0), (x, y + 5.0)];
                canvas.area(corners, Ink::band(*tone))?;
            }
            Mark::Arrow(_) => continue,
        }
        canvas.text(name, (end + 7.0, y), TEXT, Anchor::Left)?;
        x = end + 7.0 + width_of(name, TEXT) + 22.0;
    }
    Ok(())
}

/// One series, its points put on the sheet by `at`.
pub(crate) fn draw_mark(
    canvas: &Canvas,
    series: &Series,
    at: impl Fn((f64, f64)) -> (f64, f64),
) -> Result<(), PlotError> {
    match &series.mark {
        Mark::Line(points) => canvas.line(points.iter().map(|point| at(*point)), Ink::line(series.tone)),
        Mark::Dashed(points) => canvas.dashed(points.iter().map(|point| at(*point)), Ink::line(series.tone)),
        Mark::Arrow(points) => {
            let points: Vec<_> = points.iter().map(|point| at(*point)).collect();
            arrow(canvas, &points, series.tone)
        }
        Mark::Band(points) => {
            let upper = points.iter().map(|(x, _, high)| at((*x, *high)));
            let lower = points.iter().rev().map(|(x, low, _)| at((*x, *low)));
            canvas.area(upper.chain(lower), Ink::band(series.tone))
        }
    }
}

/// Radius of an arrow's dot; length of its head, which is as wide.
const DOT: f64 = 4.0;
const HEAD: f64 = 13.0;

fn arrow(canvas: &Canvas, points: &[(f64, f64)], tone: Tone) -> Result<(), PlotError> {
    let (Some(&(x, y)), Some(&(tip_x, tip_y))) = (points.first(), points.last()) else { return Ok(()) };
    let dot = (0..12).map(|k| (x + DOT * (f64::from(k) * FRAC_PI_6).cos(), y + DOT * (f64::from(k) * FRAC_PI_6).sin()));
    canvas.area(dot, Ink::solid(tone))?;
    // The head is as long as the line is that it stands for: neighbours alone would turn it by their scatter.
    let behind = points.iter().rev().find(|(x, y)| (tip_x - x).hypot(tip_y - y) >= HEAD);
    let Some(&(back_x, back_y)) = behind else { return Ok(()) };
    let length = (tip_x - back_x).hypot(tip_y - back_y);
    let (u, v) = (HEAD * (tip_x - back_x) / length, HEAD * (tip_y - back_y) / length);
    let corner = |side: f64| (tip_x - u - side * v / 2.0, tip_y - v + side * u / 2.0);
    canvas.line(points.iter().copied(), Ink::thick(tone))?;
    canvas.area([(tip_x, tip_y), corner(1.0), corner(-1.0)], Ink::solid(tone))
}
