//! `trunnion derive`: equations, base parameters and source code of a model.

use super::Refused;
use super::model::{described, setup, source};
use super::output::print;
use super::predicted::{Measuring, prediction};
use clap::{ArgGroup, Args, ValueEnum};
use trunnion::data::Radius;
use trunnion::study::SetupError;
use trunnion_codegen::emit::c::Precision;
use trunnion_codegen::emit::rust::{self, Support};
use trunnion_codegen::emit::{c99, equations, hal, numpy};
use trunnion_codegen::problems::derivation;

/// Arguments of `derive`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("predicted").args(["samples", "noise_um", "estimator"]).multiple(true).requires("radius"))]
pub struct DeriveArguments {
    /// A name from the catalogue, a model file, or a project; without it the project of this folder, trunnion.toml.
    model: Option<String>,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Emit::Text)]
    emit: Emit,
    /// With the text: what the runs would give with a bar of this nominal length, mm.
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// Another length of the set-up, mm.
    #[arg(long = "set", value_name = "NAME=MM", requires = "radius")]
    lengths: Vec<String>,
    /// Range of the sweeps, degrees.
    #[arg(long, value_name = "A:B", default_value = "0:360", requires = "radius", value_parser = super::predicted::range, allow_hyphen_values = true)]
    range_deg: (f64, f64),
    #[command(flatten)]
    measuring: Measuring,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// Equations for reading.
    Text,
    /// Equations for a paper.
    Latex,
    /// Regressors and estimators as a Rust module for `core` and `trunnion-solver`.
    Rust,
    /// Regressors and a streaming solver as C99, in one file.
    C,
    /// Regressors and solver as a LinuxCNC component, for halcompile.
    Hal,
    /// Regressors as a Python module on NumPy.
    Numpy,
    /// Everything for a program.
    Json,
}

impl DeriveArguments {
    /// Derives and prints.
    pub fn run(self) -> Result<(), Refused> {
        if let Some(radius) = self.radius.filter(|_| self.emit != Emit::Text) {
            let told = "of no use here\n  expected it with --emit text, or not at all";
            return Err(Refused::Option("radius", radius.to_string(), told));
        }
        let description = described(&source(self.model.as_deref())?)?;
        let derivation = derivation(&description).map_err(SetupError::Description)?;
        let predicted = match (self.radius, self.emit) {
            (Some(mm), Emit::Text) => {
                let setup = setup(description.clone(), Some(Radius::new(mm)?), &self.lengths)?;
                prediction(&setup, self.range_deg, &self.measuring)?
            }
            _ => String::new(),
        };
        Ok(print(&match self.emit {
            Emit::Text => equations::text(&description, &derivation) + &predicted,
            Emit::Latex => equations::latex(&description, &derivation),
            Emit::Rust => rust::model_source(&description, &derivation, &Support::of_solver())?,
            Emit::C => c99::sources(&description, &derivation, Precision::Double)?.single(),
            Emit::Hal => hal::component(&description, &derivation)?.source,
            Emit::Numpy => numpy::model_source(&description, &derivation)?,
            Emit::Json => format!("{:#}\n", equations::json(&description, &derivation)),
        })?)
    }
}
