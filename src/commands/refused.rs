//! Why a command was refused: one message, exit code 2.

use super::output::OutputError;
use super::pair::pair;
use super::seen::seen;
use std::path::PathBuf;
use thiserror::Error;
use trunnion::circular::{CircularError, TraceError};
use trunnion::data::{
    FileError, FileProblem, NativeError, ObservationsError, PositionsProblem, RadiusError, SourceError, TextError,
    WriteError,
};
use trunnion::export::{GridError, NoAxis, NoPivots, NoPlace};
use trunnion::history::HistoryError;
use trunnion::import::Wrong;
use trunnion::plot::PlotError;
use trunnion::report::ReportError;
use trunnion::study::plan::design::DesignError;
use trunnion::study::plan::positions::PositionsError;
use trunnion::study::{EstimateError, LARGEST, OutOfRange, SetupError, StudyError, WeightError};
use trunnion_codegen::emit::hal::ComponentError;
use trunnion_codegen::graph::Unbound;

/// Why a command was refused. What the library says stands, but for the remedies that are options here.
#[derive(Debug, Error)]
pub enum Refused {
    #[error(transparent)]
    Exechon(#[from] super::exechon::ExechonRefused),
    #[error("{}", observations(.0))]
    Observations(#[from] ObservationsError),
    #[error("{}", file(.0, ""))]
    File(#[from] FileError),
    #[error("{}", file(.0, "trunnion import with "))]
    Run(FileError),
    #[error(transparent)]
    Native(#[from] NativeError),
    #[error(transparent)]
    Radius(#[from] RadiusError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Plot(#[from] PlotError),
    #[error(transparent)]
    Circular(#[from] CircularError),
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    Trace(PathBuf, TraceError),
    #[error(
        "{file}: {what}\n  expected one run in each direction, or one: `trunnion import` divides a file, --cw and --ccw take its parts",
        file = .0.display(),
        what = .1
    )]
    Paths(PathBuf, String),
    #[error("{file}: {what}\n  expected one run, in one direction: a file of both is given without --cw and --ccw", file = .0.display(), what = .1)]
    OnePath(PathBuf, String),
    #[error("no length of the ball-bar\n  expected --radius MM, or a .b5r that says it")]
    NoLength,
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error("{}", setup(.0))]
    Setup(#[from] SetupError),
    #[error("{}", estimate(.0))]
    Estimate(#[from] EstimateError),
    #[error("{}", study(.0))]
    Study(#[from] StudyError),
    #[error("the derived row is wrong: {0}")]
    Unbound(#[from] Unbound),
    #[error(transparent)]
    Component(#[from] ComponentError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error(transparent)]
    Source(#[from] SourceError),
    #[error(
        "no MODEL, and no trunnion.toml in this folder\n  expected a name from `trunnion models`, a model file, or a project"
    )]
    NoModel,
    #[error("no --out\n  expected the folder to be made, or a project, whose plan and programs are then written anew")]
    NoFolder,
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    History(PathBuf, HistoryError),
    #[error("--function {0}: not in the first report\n  expected one of {1}")]
    NoSuchFunction(String, String),
    #[error(
        "no run\n  expected --run NAME=FILE for each run that was made, or [run.NAME] with its files in the project"
    )]
    NoRuns,
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    Text(PathBuf, TextError),
    #[error("this model cannot be used\n{0}")]
    Model(String),
    #[error("--{option} {given}: not {pair}{range}\n  expected for example --{option} {example}")]
    NotAPair { option: &'static str, pair: &'static str, given: String, range: &'static str, example: &'static str },
    #[error("--set {0}: given twice\n  expected each length once")]
    LengthTwice(String),
    #[error("--set {0}: this is the length of the bar\n  expected it as --radius alone")]
    SetBar(String),
    #[error("the model has no run `{0}`\n  expected {1}")]
    UnknownRun(String, String),
    #[error("--weight {0}: not a run with a weight from 1e-9 to 1e9\n  expected for example --weight tilting=2")]
    Weight(String),
    #[error("--weight: run `{0}` is given twice\n  expected a run's weight once")]
    WeightTwice(String),
    #[error("{0}")]
    OutOfRange(#[from] OutOfRange),
    #[error("--range {0}: not an axis of the model, or given twice\n  expected once one of {1}")]
    RangeOf(String, String),
    #[error("--instrument {0}: not known\n  expected {1}, or its values by --instrument-um and --instrument-share")]
    Instrument(String, String),
    #[error(
        "--within {0}: not one number, nor one for each of the {1} functions\n  expected for example --for EAA,ECC --within 5,2"
    )]
    Within(String, usize),
    #[error("{}", design(.0))]
    Design(#[from] DesignError),
    #[error("{}", positions(.0))]
    Positions(#[from] PositionsError),
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    PositionsFile(PathBuf, PositionsProblem),
    #[error("{file}: {what}", file = .0.display(), what = .1)]
    PositionsOf(PathBuf, &'static str),
    #[error("--samples {0}: too many\n  expected at most {1} for each of {2} runs")]
    Samples(u32, usize, usize),
    #[error("--function {0}: no function that this model estimates\n  expected one of {1}")]
    NotEstimated(String, String),
    #[error(
        "{name} is {words}: there is no value of it to export\n  expected runs that determine it (`trunnion plan` looks for them), \
         or what is known beforehand as [assume] in the model file{example}"
    )]
    NotDetermined { name: String, words: String, example: String },
    #[error("no --function\n  expected one of {0}")]
    Which(String),
    #[error("{0}: none of them is determined\n  expected runs that determine one (`trunnion plan` looks for them)")]
    NothingDetermined(String),
    #[error(
        "model {0}: estimates no location errors\n  expected one that does, with `estimate = [\"EX0C\"]`, as those of `trunnion models` with a touch probe"
    )]
    NoLocations(String),
    #[error("{0}: its axis rests in all runs\n  expected a run in which it moves")]
    NeverMoves(String),
    #[error("--format {0}: {1} is {2}")]
    NoPlace(&'static str, String, NoPlace),
    #[error(
        "--both-directions: {0}\n  expected every run in which the axis moves measured there and back, ball and bar untouched, and a \
         format with a place for both"
    )]
    NotBoth(String),
    #[error("--{0} has no effect on {1}: {2}\n  expected it left out")]
    Idle(&'static str, &'static str, &'static str),
    #[error("{0}")]
    Pivots(#[from] NoPivots),
    #[error(
        "{0} is a location error: the same everywhere\n  expected --format volcomp or etalon, or `trunnion pivots`"
    )]
    IsLocation(String),
    #[error("{0}")]
    Grid(#[from] GridError),
    #[error(transparent)]
    NoAxis(#[from] NoAxis),
    #[error("--{option} {given}: measured was {measured}\n  expected to stay within it: nothing is known beyond")]
    NotMeasured { option: &'static str, given: String, measured: String },
    #[error("--{0} {1}: {2}")]
    Option(&'static str, String, &'static str),
}

impl Refused {
    /// What a terminal shows. A model's problems have its colours; what they quote is visible already.
    pub fn message(&self) -> String {
        let message = self.to_string();
        if let Self::Model(_) = self { message } else { seen(&message) }
    }

    /// A refused weight of those given.
    pub fn weight(error: &WeightError, given: &[String]) -> Self {
        match error {
            WeightError::UnknownRun { run, runs } => Self::UnknownRun(run.clone(), runs.join(", ")),
            WeightError::Twice(run) => Self::WeightTwice(run.clone()),
            WeightError::OutOfRange(run, _) => {
                let of_run = |given: &&String| pair(given).is_some_and(|(name, _)| name == run);
                Self::Weight(given.iter().find(of_run).unwrap_or(run).clone())
            }
            other => Self::Weight(other.to_string()),
        }
    }
}

fn observations(error: &ObservationsError) -> String {
    match error {
        ObservationsError::UnknownColumn { .. } => format!("--columns: {error}"),
        ObservationsError::RunMissing(run) => format!("run `{run}` is not given\n  expected --run {run}=FILE.csv"),
        other => other.to_string(),
    }
}

/// The options that state what an instrument's file does not say.
fn stated_by(what: &Wrong) -> Option<&'static str> {
    match what {
        Wrong::NoUnit(_) | Wrong::FeatureUnit(_) => Some("--unit mm or --unit um"),
        Wrong::NoEnds(_) => Some("--range-deg"),
        _ => None,
    }
}

fn file(error: &FileError, command: &str) -> String {
    match &error.problem {
        FileProblem::Header { .. } => {
            format!("{error}\n  a column may have another name: --columns a=\"Angle [deg]\",dr_um=\"Radius\"")
        }
        FileProblem::Import(problem) => {
            let option = stated_by(problem.what());
            option.map_or_else(|| error.to_string(), |option| format!("{error} ({command}{option})"))
        }
        _ => error.to_string(),
    }
}

fn design(error: &DesignError) -> String {
    match error {
        DesignError::Setup(error) => setup(error),
        DesignError::Estimate(error) => estimate(error),
        other => other.to_string(),
    }
}

fn positions(error: &PositionsError) -> String {
    match error {
        PositionsError::Estimate(error) => estimate(error),
        other => other.to_string(),
    }
}

fn setup(error: &SetupError) -> String {
    match error {
        SetupError::NoValue(name) => {
            format!("the constant {name} has no value\n  expected --radius or --set {name}=MM")
        }
        other => other.to_string(),
    }
}

fn study(error: &StudyError) -> String {
    match error {
        StudyError::Estimate(error) => estimate(error),
        other => other.to_string(),
    }
}

fn estimate(error: &EstimateError) -> String {
    match error {
        EstimateError::NoFirstStep => {
            "two-step needs a run that does not see an estimated function\n  use --estimator joint".to_owned()
        }
        EstimateError::TooManyCoefficients(count) => format!(
            "{count} coefficients where at most {LARGEST} can be fitted together\n  leave runs out or use simpler functions"
        ),
        other => other.to_string(),
    }
}
