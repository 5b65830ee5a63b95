//! What runs would tell, before anything is measured: predicted uncertainty, subsets of the runs, and which run of
//! another model would separate what these runs confound.

mod added;
mod axes;
mod comparison;
pub mod design;
mod overview;
pub mod positions;
mod prediction;
mod subset;

pub use added::{Addition, additions};
pub use axes::{LargestValuation, RotaryAxis, rotary_axes};
pub use comparison::{Compared, Comparison, Refusal, compare};
pub use overview::{Overview, RADII, RANGES_DEG};
pub use prediction::{Intended, Largest, Predicted, Prediction, Valuation, predict, predict_at, uniform_std};
pub use subset::subset;
