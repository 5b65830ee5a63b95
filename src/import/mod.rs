//! Files of instruments: from a text to runs with what is known of them. Nothing here opens a file.
//!
//! [`b5r()`] reads tests of Renishaw Ballbar 20; [`by_passes`] divides the samples of a table. What is no part of the circle is
//! marked, not thrown away: [`Trace::kept`] is the rest. [`data::import`](crate::data::import()) reads the files themselves.

mod arc;
mod b5r;
mod error;
mod feed;
mod passes;
mod picture;
mod table;
mod trace;
mod unit;
mod xml;

pub use arc::Arc;
pub use b5r::b5r;
pub use error::{FEWEST, ImportProblem, Inconclusive, NoArc, Wrong};
pub use picture::trace_picture;
pub use table::by_passes;
pub use trace::{About, AnglesFrom, Cut, Feature, Imported, Stated, Trace, TraceSample, UnitFrom};
