//! `trunnion derive`: equations, base parameters and source code of a model.

use super::model::load;
use super::{Refused, print};
use clap::{Args, ValueEnum};
use trunnion_codegen::emit::c::Real;
use trunnion_codegen::emit::{c99, equations, model};
use trunnion_codegen::identify::derive;

/// Arguments of `derive`.
#[derive(Debug, Args)]
pub struct Derive {
    /// A name from the catalogue, or a model file.
    model: String,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Emit::Text)]
    emit: Emit,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Emit {
    /// Equations for reading.
    Text,
    /// Equations for a paper.
    Latex,
    /// Regressors as Rust for `core` and `num-traits`.
    Rust,
    /// Regressors and a streaming solver as C99, in one file.
    C,
    /// Regressors as a Python module on NumPy.
    Numpy,
    /// Everything for a program.
    Json,
}

impl Derive {
    /// Derives and prints.
    pub fn run(self) -> Result<(), Refused> {
        let description = load(&self.model)?;
        let derivation = derive(&description).map_err(|e| Refused::derive(&description, &e))?;
        print(&match self.emit {
            Emit::Text => equations::text(&description, &derivation),
            Emit::Latex => equations::latex(&description, &derivation),
            Emit::Rust => model::rust_source(&description, &derivation)?,
            Emit::C => c99::sources(&description, &derivation, Real::Double)?.single(),
            Emit::Numpy => model::numpy_source(&description, &derivation)?,
            Emit::Json => format!("{:#}\n", equations::json(&description, &derivation)),
        })
    }
}
