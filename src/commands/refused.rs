//! Why a command was refused: one message, exit code 2.

use std::io;
use std::path::PathBuf;
use thiserror::Error;
use trunnion::data::{FileError, RadiusError, WriteError};
use trunnion::plot::PlotError;
use trunnion::study::{FitError, LARGEST, Setup, SetupError};
use trunnion_codegen::graph::Unbound;
use trunnion_codegen::identify::DeriveError;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::{Model, Problem};
use trunnion_codegen::problems::of_derivation;

/// Why a command was refused.
#[derive(Debug, Error)]
pub enum Refused {
    #[error(transparent)]
    Exechon(#[from] super::exechon::Failed),
    #[error(transparent)]
    File(#[from] FileError),
    #[error(transparent)]
    Radius(#[from] RadiusError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Plot(#[from] PlotError),
    #[error("standard output: {0}")]
    Output(io::ErrorKind),
    #[error("{file}: {problem}\n  expected a directory that can be written, or a name for a new one", file = .0.display(), problem = .1)]
    Directory(PathBuf, io::ErrorKind),
    #[error("no model `{0}` in the catalogue and no such file\n  expected a model file or one of {1}")]
    NoSuchModel(String, String),
    #[error("{file}: {problem}\n  expected a model file or one of {names}", file = .0.display(), problem = .1, names = .2)]
    Unreadable(PathBuf, io::ErrorKind, String),
    #[error("this model cannot be used\n{0}")]
    Model(String),
    #[error("{0}")]
    Setup(String),
    #[error("--{option} {given}: not {pair}\n  expected for example --{option} {example}")]
    NotAPair { option: &'static str, pair: &'static str, given: String, example: &'static str },
    #[error("--set {0}: given twice\n  expected each length once")]
    LengthTwice(String),
    #[error("--set {0}: this is the length of the bar\n  expected it as --radius alone")]
    SetBar(String),
    #[error("run `{0}` is given twice\n  expected each run of the model once")]
    RunTwice(String),
    #[error("the model has no run `{0}`\n  expected {1}")]
    UnknownRun(String, String),
    #[error("run `{0}` is not given\n  expected --run {0}=FILE.csv")]
    RunMissing(String),
    #[error("--weight {0}: not a run with a weight from 1e-9 to 1e9\n  expected for example --weight tilting=2")]
    Weight(String),
    #[error("--weight: run `{0}` is given twice\n  expected a run's weight once")]
    WeightTwice(String),
    #[error("--{0} {1}: cannot be simulated\n  {2}")]
    Option(&'static str, String, &'static str),
    #[error("{0}")]
    Fit(String),
    #[error("the model estimates no function\n  expected a name in `estimate = […]` of the model file")]
    NothingEstimated,
    #[error(
        "function {0} depends on axis {1}, which is not the swept angle; tables over other coordinates are not read yet"
    )]
    TableCoordinate(String, String),
}

impl From<Unbound> for Refused {
    fn from(e: Unbound) -> Self {
        Self::Setup(e.to_string())
    }
}

impl Refused {
    /// A failed set-up in words.
    pub fn setup(model: &Model, e: &SetupError) -> Self {
        Self::Setup(match e {
            SetupError::Derive(e) => derive(model, e),
            SetupError::NoValue(name) => {
                format!("the constant {name} has no value\n  expected --radius or --set {name}=MM")
            }
            SetupError::NotALength(name, value) => {
                format!("{name} = {value} mm is not a length\n  expected a positive number of mm")
            }
            SetupError::NotAConstant(name) => {
                let constants: Vec<&str> = model.alphabet.constants().collect();
                format!("the model has no constant `{name}`\n  expected {}", constants.join(", "))
            }
            SetupError::Unbound(e) => format!("the derived row is wrong: {e}"),
        })
    }

    /// A failed derivation in words.
    pub fn derive(model: &Model, e: &DeriveError) -> Self {
        Self::Setup(derive(model, e))
    }

    /// A failed fit in words; `files` names the file of each run.
    pub fn fit(setup: &Setup, files: &dyn Fn(RunId) -> String, e: &FitError) -> Self {
        let list = |runs: &[RunId]| runs.iter().map(|&r| files(r)).collect::<Vec<_>>().join(", ");
        Self::Fit(match e {
            FitError::TooFewSamples { runs, samples, needed } => {
                format!(
                    "{}: {samples} samples where at least {needed} are needed\n  measure at more angles",
                    list(runs)
                )
            }
            FitError::Confounded { runs, base } => {
                let names: Vec<&str> = base.iter().map(|&b| setup.derivation.base[b].name.as_str()).collect();
                format!(
                    "{}: these samples cannot tell {} apart\n  measure at more angles over a longer arc, or leave terms out of the bases under [function]",
                    list(runs),
                    names.join(", ")
                )
            }
            FitError::NotFinite => {
                "a value is too large for the arithmetic\n  check the readings, the table and their units".to_owned()
            }
            FitError::NoFirstStep => {
                "two-step needs a run that does not see an estimated function\n  use --estimator joint".to_owned()
            }
            FitError::TooManyCoefficients(n) => {
                format!(
                    "{n} coefficients where at most {LARGEST} can be fitted together\n  use --estimator two-step or simpler functions"
                )
            }
        })
    }
}

fn derive(model: &Model, e: &DeriveError) -> String {
    let told = |p: &Problem| match p.kind.help() {
        Some(help) => format!("{}\n  {help}", p.kind),
        None => p.kind.to_string(),
    };
    of_derivation(model, e).iter().map(told).collect::<Vec<_>>().join("\n")
}
