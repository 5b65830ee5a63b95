//! Pictures as SVG text: line charts of one or more stacked panels, and the polar picture usual for ball-bar tests.
//!
//! The same values give the same text, byte for byte. Numbers are in the units of the axes' labels (degrees, µm, µrad):
//! converting is the caller's. In titles, labels and names `_{xa}` is a subscript. Colours are told apart by readers who
//! see red and green alike (Okabe and Ito).

mod canvas;
mod line;
mod polar;
mod series;
mod ticks;

pub use line::{Chart, Panel};
pub use polar::PolarChart;
pub use series::{Axis, PlotError, Series, Shape, Tone};
