//! A value over a plane, as colours.

use super::canvas::{Anchor, Canvas, FRAME, Ink, draw};
use super::series::{PlotError, Scale};
use super::ticks::Ticks;

const SIDE: f64 = 420.0;
const LEFT: f64 = 84.0;
const TOP: f64 = 48.0;
const BAR: f64 = 20.0;
const TEXT: f64 = 13.0;
/// Colours of the scale's bar.
const SHADES: u32 = 48;

/// A map of a value on a grid. Colours go through white at zero.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Above the map; may be empty.
    pub title: String,
    /// To the right.
    pub x: Scale,
    /// Upwards.
    pub y: Scale,
    /// What the colours show.
    pub value: Scale,
    /// The cells' middles along x, evenly spaced, rising.
    pub columns: Vec<f64>,
    /// The cells' middles along y, evenly spaced, rising.
    pub rows: Vec<f64>,
    /// A value for each row and in it each column; none leaves the cell grey.
    pub cells: Vec<Vec<Option<f64>>>,
    /// Points marked with their names.
    pub marks: Vec<(String, (f64, f64))>,
}

impl HeatMap {
    /// The map as SVG text.
    ///
    /// # Errors
    /// [`PlotError`] without cells, or with values that cannot be drawn.
    pub fn svg(&self) -> Result<String, PlotError> {
        let none = PlotError::NoPoints { panel: 1 };
        let (xs, ys) = (edges(&self.columns).ok_or(none)?, edges(&self.rows).ok_or(none)?);
        let values: Vec<f64> = self.cells.iter().flatten().flatten().copied().collect();
        if !values.iter().chain([&xs.0, &xs.1, &ys.0, &ys.1]).all(|v| v.abs() < 1e100) {
            return Err(PlotError::NotFinite { panel: 1 });
        }
        let largest = values.iter().map(|v| v.abs()).reduce(f64::max).ok_or(none)?;
        let scale = Ticks::decimal((-largest, largest), 6);
        let at = |x: f64, y: f64| {
            let share = |v: f64, (low, high): (f64, f64)| (v - low) / (high - low);
            (LEFT + SIDE * share(x, (xs.0, xs.1)), TOP + SIDE * (1.0 - share(y, (ys.0, ys.1))))
        };
        draw(((LEFT + SIDE + 130.0) as u32, (TOP + SIDE + 56.0) as u32), |canvas| {
            canvas.text(&self.title, (LEFT + SIDE / 2.0, TOP * 0.5), TEXT + 3.0, Anchor::Centre)?;
            for (&y, row) in self.rows.iter().zip(&self.cells) {
                for (&x, cell) in self.columns.iter().zip(row) {
                    let (dx, dy) = (xs.2 / 2.0, ys.2 / 2.0);
                    let ink = cell.map_or((205, 205, 205), |v| colour(v / scale.range.1));
                    // A little over the edge, so that no gaps shine through.
                    let corners = [
                        (x - dx, y - dy),
                        (x + 1.1 * dx, y - dy),
                        (x + 1.1 * dx, y + 1.1 * dy),
                        (x - dx, y + 1.1 * dy),
                    ];
                    let inside = corners.map(|(x, y)| at(x.min(xs.1), y.min(ys.1)));
                    canvas.area(inside, Ink::fill(ink))?;
                }
            }
            frame(canvas, [at(xs.0, ys.0), at(xs.1, ys.1)])?;
            for (name, (x, y)) in &self.marks {
                let (px, py) = at(*x, *y);
                canvas.line([(px - 5.0, py), (px + 5.0, py)], FRAME)?;
                canvas.line([(px, py - 5.0), (px, py + 5.0)], FRAME)?;
                canvas.text(name, (px + 8.0, py - 8.0), TEXT - 1.0, Anchor::Left)?;
            }
            for tick in inside(&xs) {
                canvas.text(&tick.1, (at(tick.0, ys.0).0, TOP + SIDE + 15.0), TEXT, Anchor::Centre)?;
            }
            for tick in inside(&ys) {
                canvas.text(&tick.1, (LEFT - 8.0, at(xs.0, tick.0).1), TEXT, Anchor::Right)?;
            }
            canvas.text(&self.x.title(), (LEFT + SIDE / 2.0, TOP + SIDE + 37.0), TEXT + 1.0, Anchor::Centre)?;
            canvas.text(&self.y.title(), (20.0, TOP + SIDE / 2.0), TEXT + 1.0, Anchor::Upward)?;
            bar(canvas, &scale, &self.value)
        })
    }
}

/// Outer edges of evenly spaced middles, and their distance.
fn edges(middles: &[f64]) -> Option<(f64, f64, f64)> {
    let (first, last) = (middles.first()?, middles.last()?);
    let step = (last - first) / (middles.len() - 1) as f64;
    (step > 0.0).then_some((first - step / 2.0, last + step / 2.0, step))
}

fn inside(&(low, high, _): &(f64, f64, f64)) -> Vec<(f64, String)> {
    let ticks = Ticks::decimal((low, high), 8);
    let labels = ticks.at.iter().map(|at| (*at, ticks.label(*at)));
    labels.filter(|(at, _)| (low..=high).contains(at)).collect()
}

fn frame(canvas: &Canvas, [(x0, y0), (x1, y1)]: [(f64, f64); 2]) -> Result<(), PlotError> {
    canvas.line([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)], FRAME)
}

fn bar(canvas: &Canvas, scale: &Ticks, value: &Scale) -> Result<(), PlotError> {
    let (x, (low, high)) = (LEFT + SIDE + 24.0, scale.range);
    let at = |v: f64| TOP + SIDE * (1.0 - (v - low) / (high - low));
    for shade in 0..SHADES {
        let value = |k: u32| low + (high - low) * f64::from(k) / f64::from(SHADES);
        let (bottom, top) = (at(value(shade)), (at(value(shade + 1)) - 0.4).max(TOP));
        let middle = (value(shade) + value(shade + 1)) / 2.0;
        canvas.area([(x, bottom), (x + BAR, bottom), (x + BAR, top), (x, top)], Ink::fill(colour(middle / high)))?;
    }
    frame(canvas, [(x, TOP + SIDE), (x + BAR, TOP)])?;
    for tick in &scale.at {
        canvas.text(&scale.label(*tick), (x + BAR + 6.0, at(*tick)), TEXT, Anchor::Left)?;
    }
    canvas.text(&value.title(), (x + BAR + 62.0, TOP + SIDE / 2.0), TEXT + 1.0, Anchor::Upward)
}

/// From blue by white to vermilion for −1 to 1.
fn colour(share: f64) -> (u8, u8, u8) {
    let end = if share < 0.0 { (0.0, 114.0, 178.0) } else { (213.0, 94.0, 0.0) };
    let mix = |end: f64| (255.0 + (end - 255.0) * share.abs().min(1.0)).round() as u8;
    (mix(end.0), mix(end.1), mix(end.2))
}
