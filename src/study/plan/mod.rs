//! What runs would tell, before anything is measured: predicted uncertainty, subsets of the runs, and which run of
//! another model would separate what these runs confound.

mod added;
mod prediction;
mod subset;

pub use added::{Addition, additions};
pub use prediction::{Intended, Largest, Predicted, Prediction, predict};
pub use subset::subset;
