//! What a measurement begins with: a project file with comments, and a measuring plan.
//!
//! The project file is read by [`data::Project`](crate::data::Project); here it is written.

mod plan;
mod toml;

pub use plan::plan;
pub use toml::project;

use crate::program::Control;
use crate::study::plan::Prediction;
use crate::study::{Measurement, Path, Setup};

/// A measurement as it is planned.
#[derive(Clone, Copy, Debug)]
pub struct Planned<'a> {
    /// The model with its lengths.
    pub setup: &'a Setup,
    /// What the project file names it: a name of the catalogue, a file.
    pub model: &'a str,
    /// What the runs give where a reading's standard deviation is 1 µm.
    pub prediction: &'a Prediction,
    /// How the axes move in each measurement.
    pub paths: &'a [(Measurement, Path)],
    /// Readings of each that the prediction is for, where these are as many of each.
    pub samples: Option<usize>,
    /// How far the centres of a sphere and of a touch probe's ball are apart at a touch, mm, where one finds the other at each position.
    pub touch_mm: Option<f64>,
    /// The files of readings that a project names already, by the measurement.
    pub named: &'a [(String, Vec<String>)],
}

impl Planned<'_> {
    /// The files of a measurement's readings: those that are named, or there, and back; one of a probe's.
    fn readings(&self, measurement: &Measurement) -> Vec<String> {
        let name = &measurement.name;
        if let Some((_, files)) = self.named.iter().find(|(own, _)| own == name) {
            return files.clone();
        }
        if self.is_probed(measurement) {
            return vec![format!("{name}.csv")];
        }
        ["there", "back"].map(|way| format!("{name}-{way}.csv")).into()
    }

    fn is_probed(&self, measurement: &Measurement) -> bool {
        self.touch_mm.is_some() && measurement.is_displacement()
    }
}

/// The file of a run's program.
pub fn program_file(run: &str, control: Control) -> String {
    format!("{run}.{}.{}", control.name(), control.ending())
}
