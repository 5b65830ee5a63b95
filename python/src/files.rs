//! Files of runs: read, weighed, fitted.

use crate::errors::{self, Class};
use pyo3::PyResult;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trunnion::Setup;
use trunnion::data::{Columns, RunFiles};
use trunnion::study::{Failed, Fit, How, Observation, fit_recorded, weigh};

/// Files by the names of their runs, and how they are read.
pub struct Files<'a> {
    pub runs: &'a [(String, PathBuf)],
    /// What columns are called where they have other names.
    pub columns: Columns,
    pub table: Option<&'a Path>,
    pub weights: &'a [(&'a str, f64)],
}

impl Files<'_> {
    /// The fit, and the observations that stand for all samples.
    pub fn fit(self, setup: &Setup, how: How) -> PyResult<(Fit, Vec<Observation>)> {
        let Self { runs, columns, table, weights } = self;
        let given: Vec<_> = runs.iter().map(|(run, file)| (run.as_str(), file)).collect();
        let files = RunFiles::new(setup, &given).and_then(|files| files.under(setup, columns));
        let files = files.map_err(|e| errors::observations(&e))?;
        let mut recorded = files.open(setup, table).map_err(|e| errors::observations(&e))?;
        weigh(setup, &mut recorded, weights).map_err(|e| Class::Data.error(e))?;
        fit_recorded(setup, &recorded, how).map_err(|failed| match failed {
            Failed::Estimate(e) => errors::estimate(&e),
            Failed::Recording(e) => errors::file(&e),
        })
    }
}

/// Columns of files by their names here.
pub fn columns(given: Option<BTreeMap<String, String>>) -> PyResult<Columns> {
    Columns::try_from(given.unwrap_or_default()).map_err(|e| Class::Data.error(e))
}
