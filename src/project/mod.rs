//! What a measurement begins with: a project file with comments, and a measuring plan.
//!
//! The project file is read by [`data::Project`](crate::data::Project); here it is written.

mod plan;
mod toml;

pub use plan::plan;
pub use toml::project;

use crate::program::Control;
use crate::study::plan::Prediction;
use crate::study::{Path, Setup};
use trunnion_codegen::ids::RunId;

/// A measurement as it is planned.
#[derive(Clone, Copy, Debug)]
pub struct Planned<'a> {
    /// The model with its lengths.
    pub setup: &'a Setup,
    /// What the project file names it: a name of the catalogue, a file.
    pub model: &'a str,
    /// What the runs give where a reading's standard deviation is 1 µm.
    pub prediction: &'a Prediction,
    /// How the axes move in each run.
    pub paths: &'a [(RunId, Path)],
}

impl Planned<'_> {
    fn name(&self, run: RunId) -> &str {
        &self.setup.model.runs[run].name
    }

    /// The files of a run's readings: there, and back.
    fn readings(&self, run: RunId) -> [String; 2] {
        ["there", "back"].map(|way| format!("{}-{way}.csv", self.name(run)))
    }
}

/// The file of a run's program.
pub fn program_file(run: &str, control: Control) -> String {
    format!("{run}.{}.{}", control.name(), control.ending())
}
