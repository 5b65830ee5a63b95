//! Why files are no measurement of a model.

use super::error::FileError;
use crate::study::Setup;
use thiserror::Error;

/// Why files are no measurement of a model.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObservationsError {
    /// A file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The model has no such run.
    #[error("the model has no run `{run}`\n  expected {}", .runs.join(", "))]
    UnknownRun {
        /// The name given.
        run: String,
        /// The runs of the model.
        runs: Vec<String>,
    },
    /// A run has no file.
    #[error("run `{0}` is not given\n  expected a file for every run of the model")]
    RunMissing(String),
    /// A name is given to a column that the files do not have.
    #[error("no file has a column {column:?}\n  expected names for {}", .columns.join(", "))]
    UnknownColumn {
        /// The column.
        column: String,
        /// The columns of the files.
        columns: Vec<String>,
    },
    /// A known function is one of a coordinate that the files do not have.
    #[error(
        "function {function} depends on axis {axis}, which is not the swept angle; tables over other coordinates are not read\n  expected a fit without --table, or a model in which it is assumed or estimated"
    )]
    TableCoordinate {
        /// Its name in a table.
        function: String,
        /// The axis' name.
        axis: String,
    },
}

impl ObservationsError {
    pub(crate) fn unknown_run(setup: &Setup, run: &str) -> Self {
        let runs = setup.model.runs.iter().map(|run| run.name.clone()).collect();
        Self::UnknownRun { run: run.to_owned(), runs }
    }
}
