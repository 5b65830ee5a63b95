//! A drawing to scale.

use super::canvas::{Anchor, draw};
use super::line::{draw_mark, legend};
use super::series::{Extent, PlotError, Series};

const WIDTH: f64 = 620.0;
const MARGIN: f64 = 40.0;
const TITLE: f64 = 40.0;
const LEGEND: f64 = 28.0;
const TEXT: f64 = 13.0;

/// A name beside a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The name.
    pub text: String,
    /// The point.
    pub at: (f64, f64),
}

/// Lines in a plane with one scale for both axes; y upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    /// Above the drawing; may be empty.
    pub title: String,
    /// Drawn in this order.
    pub series: Vec<Series>,
    /// Drawn last.
    pub labels: Vec<Label>,
}

impl Sketch {
    /// The drawing as SVG text.
    ///
    /// # Errors
    /// [`PlotError`] without points or with values that cannot be drawn.
    pub fn svg(&self) -> Result<String, PlotError> {
        let extent = Extent::of(&self.series, 1)?;
        let (across, up) = (extent.x.1 - extent.x.0, extent.y.1 - extent.y.0);
        let scale = (WIDTH - 2.0 * MARGIN) / across.max(0.6 * up).max(1e-9);
        let top = TITLE + LEGEND + TEXT;
        let height = top + up * scale + MARGIN;
        let left = (WIDTH - across * scale) / 2.0;
        let at = |(x, y): (f64, f64)| (left + (x - extent.x.0) * scale, top + (extent.y.1 - y) * scale);
        draw((WIDTH as u32, height as u32), |canvas| {
            canvas.text(&self.title, (WIDTH / 2.0, TITLE * 0.5), TEXT + 3.0, Anchor::Centre)?;
            legend(canvas, &self.series, (MARGIN, TITLE + LEGEND / 3.0))?;
            self.series.iter().try_for_each(|series| draw_mark(canvas, series, at))?;
            self.labels.iter().try_for_each(|label| {
                let (x, y) = at(label.at);
                canvas.text(&label.text, (x + 7.0, y - 9.0), TEXT, Anchor::Left)
            })
        })
    }
}
