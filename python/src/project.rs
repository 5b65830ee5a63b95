//! A measurement of a machine as a project file has it.

use crate::arguments::{estimator, variance};
use crate::errors::{self, Class};
use crate::files::Files;
use crate::fit::Fit;
use crate::model::Model;
use crate::setup::Setup;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use trunnion::data::{self, Source, made};
use trunnion::study::{Estimator, How};

/// A project file, trunnion.toml: a model with what is stated over it, the runs that were made with their files, how they are fitted.
#[pyclass(frozen, module = "trunnion")]
pub struct Project {
    /// The model with the runs that files are given for, and its lengths.
    #[pyo3(get)]
    setup: Py<Setup>,
    project: data::Project,
}

#[pymethods]
impl Project {
    /// The project of a file, or of a folder with a trunnion.toml; lengths in place of its own, mm: `Project("bench", R=150.0)`.
    #[new]
    #[pyo3(signature = (path, /, **lengths))]
    pub fn new(py: Python<'_>, path: PathBuf, lengths: Option<HashMap<String, f64>>) -> PyResult<Self> {
        let source = py.detach(|| Source::of_project(&path)).map_err(|e| errors::source(&e))?;
        let (described, project) = (source.described, source.project.unwrap_or_default());
        let model = Bound::new(py, Model::of(py, described)?)?;
        let kept = {
            let described = model.get().model();
            let names: Vec<&str> = project.files().map(|(name, _)| name).collect();
            let (kept, left) = made(described, &names);
            // A project without files is one that nothing was measured for yet.
            let some = !left.is_empty() && !names.is_empty();
            some.then(|| kept.into_iter().map(|run| described.runs[run].name.clone()).collect())
        };
        let setup = Setup::of(&model, lengths.into_iter().flatten().collect(), kept)?;
        Ok(Self { setup: Py::new(py, setup)?, project })
    }

    /// The files of each run that was made.
    #[getter]
    fn runs(&self) -> BTreeMap<&str, Vec<PathBuf>> {
        self.project.runs.iter().map(|run| (run.name.as_str(), run.files.clone())).collect()
    }

    /// The file of the known functions, if there is one.
    #[getter]
    fn table(&self) -> Option<PathBuf> {
        self.project.table.clone()
    }

    /// How the runs are combined.
    #[getter]
    fn estimator(&self) -> String {
        self.project.estimator.unwrap_or(Estimator::Joint).to_string()
    }

    /// Whether readings far off the others are weighed down.
    #[getter]
    fn robust(&self) -> bool {
        self.project.robust
    }

    /// The weights of runs that have one.
    #[getter]
    fn weights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let setup = &self.setup.get().setup;
        self.project.weights(&setup.model).try_for_each(|(run, weight)| all.set_item(run, weight))?;
        Ok(all)
    }

    /// What is told of the machine at hand: name, serial, operator, date, note, those that are.
    #[getter]
    fn machine<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let told = self.project.machine.told().into_iter().filter_map(|(key, value)| Some((key, value?)));
        told.into_iter().try_for_each(|(key, value)| all.set_item(key, value))?;
        Ok(all)
    }

    /// Fits its runs as `trunnion fit` does in its folder: the same to the last bit. `estimator`, `robust` and `weights` stand in for
    /// the project's own (weights run by run); `sigma_um`: the standard deviation of a reading, µm, where it is known.
    #[pyo3(signature = (*, estimator=None, robust=None, weights=None, sigma_um=None))]
    fn fit(
        &self,
        py: Python<'_>,
        estimator: Option<&str>,
        robust: Option<bool>,
        weights: Option<BTreeMap<String, f64>>,
        sigma_um: Option<f64>,
    ) -> PyResult<Fit> {
        let (setup, project) = (&self.setup.get().setup, &self.project);
        if project.runs.is_empty() {
            return Err(Class::Data.error("the project has no run\n  expected [run.NAME] with its files"));
        }
        let given = estimator.map(self::estimator).transpose()?.or(project.estimator);
        let how = How {
            estimator: given.unwrap_or(Estimator::Joint),
            variance: variance(sigma_um)?,
            robust: robust.unwrap_or(project.robust),
        };
        let mut all: BTreeMap<&str, f64> = project.weights(&setup.model).collect();
        all.extend(weights.iter().flatten().map(|(run, weight)| (run.as_str(), *weight)));
        let weights: Vec<(&str, f64)> = all.into_iter().collect();
        let runs: Vec<_> = project.files().map(|(run, file)| (run.to_owned(), file.to_owned())).collect();
        let table = project.table.as_deref();
        let (fit, observations) = py.detach(|| {
            Files { runs: &runs, columns: project.columns.clone(), table, weights: &weights }.fit(setup, how)
        })?;
        Ok(Fit::new(setup, fit, observations, table.is_none()).of_machine(&project.machine))
    }

    fn __repr__(&self) -> String {
        let runs: Vec<&str> = self.project.runs.iter().map(|run| run.name.as_str()).collect();
        format!("<trunnion.Project of {}: runs {}>", self.setup.get().setup.model.name, runs.join(", "))
    }
}
