//! Why a command of the parallel machine was refused.

use crate::commands::output::OutputError;
use std::path::PathBuf;
use thiserror::Error;
use trunnion::data::WriteError;
use trunnion::exechon::{
    CompensationError, ExperimentError, InputError, MachineFileError, NcError, PictureError, PlanError,
};
use trunnion::plot::PlotError;
use trunnion::report::ReportError;

/// Why a command was refused.
#[derive(Debug, Error)]
pub enum ExechonRefused {
    #[error("{file}: {problem}", file = .0.display(), problem = .1)]
    Machine(PathBuf, MachineFileError),
    #[error(transparent)]
    Input(#[from] InputError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Plot(#[from] PlotError),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error("{0}\n  expected a ring within the workspace, and at least 7 touches")]
    Compensation(#[from] CompensationError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Nc(#[from] NcError),
    #[error("{0}\n  expected a machine that reaches the paper's positions")]
    Experiment(#[from] ExperimentError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("--{0}: {1}")]
    Option(&'static str, &'static str),
}
