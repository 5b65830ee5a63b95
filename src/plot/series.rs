//! What is drawn: series with a mark and a colour.

use thiserror::Error;
use trunnion_codegen::quantity::Unit;

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A panel without a single point.
    #[error("panel {panel} has no points\n  expected at least one sample")]
    NoPoints {
        /// The panel, counted from 1.
        panel: usize,
    },
    /// A value that is NaN, infinite, or too large for a range to be finite.
    #[error(
        "panel {panel} has values that cannot be drawn: not finite, or too large\n  expected smaller errors or a smaller range"
    )]
    NotFinite {
        /// The panel, counted from 1.
        panel: usize,
    },
    /// The drawing library refuses.
    #[error("the picture cannot be drawn\n  expected fewer points, or no picture")]
    Backend,
}

/// What an axis of a picture shows, in which unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scale {
    /// What it shows.
    pub label: String,
    /// Its unit, if it has one; an axis in degrees has ticks at parts of a turn.
    pub unit: Option<Unit>,
}

impl Scale {
    /// An axis.
    pub fn new(label: &str, unit: Unit) -> Self {
        Self { label: label.to_owned(), unit: Some(unit) }
    }

    /// An axis without a unit.
    pub fn plain(label: &str) -> Self {
        Self { label: label.to_owned(), unit: None }
    }

    /// An axis in parts of a hundred.
    pub fn percent(label: &str) -> Self {
        Self::plain(&format!("{label} / %"))
    }

    pub(crate) fn title(&self) -> String {
        match self.unit {
            Some(unit) => format!("{} / {}", self.label, unit.symbol()),
            None => self.label.clone(),
        }
    }
}

/// One line or band.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend; without one it is not there.
    pub name: String,
    /// Its colour.
    pub tone: Tone,
    /// How it is drawn, through which points.
    pub mark: Mark,
}

/// How a series is drawn; points in the order they are joined.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A line through (x, y).
    Line(Vec<(f64, f64)>),
    /// A dashed line through (x, y).
    Dashed(Vec<(f64, f64)>),
    /// A line through (x, y) that begins at a dot and ends in a head; not in the legend.
    Arrow(Vec<(f64, f64)>),
    /// The area between lower and upper values: (x, lower, upper).
    Band(Vec<(f64, f64, f64)>),
}

/// Colours that stay apart for colour-blind readers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// For what is estimated, or the first run.
    Blue,
    /// For the second run.
    Vermilion,
    /// For a third.
    Green,
    /// For a fourth.
    Purple,
    /// For the truth.
    Black,
}

impl Tone {
    pub(crate) const fn rgb(self) -> (u8, u8, u8) {
        match self {
            Tone::Blue => (0, 114, 178),
            Tone::Vermilion => (213, 94, 0),
            Tone::Green => (0, 158, 115),
            Tone::Purple => (204, 121, 167),
            Tone::Black => (0, 0, 0),
        }
    }
}

impl Mark {
    /// Every (x, y) it touches.
    pub(crate) fn points(&self) -> Vec<(f64, f64)> {
        match self {
            Mark::Line(points) | Mark::Dashed(points) | Mark::Arrow(points) => points.clone(),
            Mark::Band(points) => points.iter().flat_map(|(x, low, high)| [(*x, *low), (*x, *high)]).collect(),
        }
    }
}

/// Smallest and largest of x and of y over some series.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub x: (f64, f64),
    pub y: (f64, f64),
}

/// Values beyond this make steps and spans overflow.
const LARGEST: f64 = 1e100;

impl Extent {
    pub(crate) fn of(series: &[Series], panel: usize) -> Result<Self, PlotError> {
        let points: Vec<_> = series.iter().flat_map(|series| series.mark.points()).collect();
        if !points.iter().all(|(x, y)| x.abs() <= LARGEST && y.abs() <= LARGEST) {
            return Err(PlotError::NotFinite { panel });
        }
        let first = points.first().ok_or(PlotError::NoPoints { panel })?;
        let widen = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let start = Extent { x: (first.0, first.0), y: (first.1, first.1) };
        Ok(points.iter().fold(start, |e, (x, y)| Extent { x: widen(e.x, *x), y: widen(e.y, *y) }))
    }

    pub(crate) fn join(self, other: Self) -> Self {
        let join = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
        Extent { x: join(self.x, other.x), y: join(self.y, other.y) }
    }
}
