//! Pictures as SVG text: line charts of one or more stacked panels, the polar picture usual for ball-bar tests, maps of a
//! value over a plane, and sketches to scale.
//!
//! The same values give the same text, byte for byte. Numbers are in the units of the axes' labels (degrees, µm, µrad):
//! converting is the caller's. In titles, labels and names `_{xa}` is a subscript. Colours are told apart by readers who
//! see red and green alike (Okabe and Ito).

mod canvas;
mod dark;
mod line;
mod map;
mod polar;
mod series;
mod sketch;
mod ticks;

pub use canvas::MADE;
pub use dark::dark_style;
pub use line::{Chart, Panel};
pub use map::HeatMap;
pub use polar::{PolarChart, Rim};
pub use series::{Mark, PlotError, Scale, Series, Tone};
pub use sketch::{Label, Sketch};
