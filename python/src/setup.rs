//! A model with its lengths, ready to evaluate, simulate and fit.

use crate::arguments::{Ranges, estimator, limits, range, size, variance, within};
use crate::errors::{self, Class};
use crate::files::{self, Files};
use crate::fit::Fit;
use crate::model::{Derivation, Model};
use crate::object::object;
use crate::positions::Wanted;
use crate::simulated::Simulated;
use crate::table::{Given, array, complete};
use numpy::{PyArray2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::sync::Arc;
use trunnion::data::limits::SAMPLES;
use trunnion::document;
use trunnion::study::plan::{self, Intended, predict, uniform_std};
use trunnion::study::{self, Arrays, Drawn, How, Simulation, fit_recorded, studies, weigh};
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::quantity::Unit;

/// A model, its derivation, and the lengths of the set-up.
#[pyclass(frozen, module = "trunnion")]
pub struct Setup {
    #[pyo3(get)]
    model: Py<Model>,
    #[pyo3(get)]
    lengths: BTreeMap<String, f64>,
    /// The runs there are, if they are not all of the model's.
    kept: Option<Vec<String>>,
    pub setup: Arc<trunnion::Setup>,
}

impl Setup {
    pub fn of(model: &Bound<'_, Model>, lengths: BTreeMap<String, f64>, kept: Option<Vec<String>>) -> PyResult<Self> {
        let (own, py) = (model.get(), model.py());
        let values: Vec<(&str, f64)> = lengths.iter().map(|(name, mm)| (name.as_str(), *mm)).collect();
        let mut described = own.model().as_ref().clone();
        if let Some(names) = &kept {
            let run = |name: &String| {
                described.runs.position(|run| run.name == *name).ok_or_else(|| errors::unknown_run(&described, name))
            };
            let mut ids = names.iter().map(run).collect::<PyResult<Vec<RunId>>>()?;
            ids.sort_unstable();
            ids.dedup();
            if ids.is_empty() {
                return Err(Class::Data.error("no run is kept\n  expected at least one"));
            }
            let part = py.detach(|| plan::subset(&described, &ids));
            described =
                part.map_err(|e| errors::setup(&own.described, study::SetupError::derivation(&described, &e)))?;
        }
        let setup = py.detach(|| trunnion::Setup::new(described, &values));
        let setup = Arc::new(setup.map_err(|e| errors::setup(&own.described, e))?);
        let name = |name: &str| (name.to_owned(), setup.constant(name));
        let lengths = setup.model.alphabet.constants().map(name).collect();
        Ok(Self { model: model.clone().unbind(), lengths, kept, setup })
    }

    fn run(&self, name: &str) -> PyResult<RunId> {
        self.setup.run(name).ok_or_else(|| errors::unknown_run(&self.setup.model, name))
    }

    fn simulation(
        &self,
        samples: usize,
        noise_um: f64,
        range_deg: Option<(f64, f64)>,
        seed: u64,
        limits: study::ErrorLimits,
    ) -> PyResult<Simulation> {
        let most = SAMPLES / self.setup.model.runs.len().max(1);
        let samples = within("samples", samples, 1..=most)?;
        let noise_um = size("noise_um", noise_um)?;
        let given = range_deg.map(range).transpose()?;
        let simulation = Simulation { seed, samples, noise_um, limits, range_deg: given.unwrap_or((0.0, 360.0)) };
        if given.is_some() {
            let reaches = |run| self.setup.reaches(run, simulation.range()).map_err(|e| Class::Estimate.error(e));
            self.setup.model.runs.keys().try_for_each(reaches)?;
        }
        Ok(simulation)
    }
}

#[pymethods]
impl Setup {
    /// A model with its lengths, mm: `Setup(model, R=150.0)`; those not given take the model's usual ones.
    #[new]
    #[pyo3(signature = (model, /, **lengths))]
    fn new(model: &Bound<'_, Model>, lengths: Option<HashMap<String, f64>>) -> PyResult<Self> {
        Self::of(model, lengths.into_iter().flatten().collect(), None)
    }

    /// A model of the catalogue with its lengths, mm: `Setup.from_catalogue("tilting-table-a", R=150.0)`; those not given take the
    /// model's usual ones.
    #[staticmethod]
    #[pyo3(signature = (name, /, **lengths))]
    fn from_catalogue(py: Python<'_>, name: &str, lengths: Option<HashMap<String, f64>>) -> PyResult<Self> {
        Self::new(&Bound::new(py, Model::from_catalogue(py, name)?)?, lengths)
    }

    /// A model file with its lengths, mm.
    #[staticmethod]
    #[pyo3(signature = (path, /, **lengths))]
    fn from_file(py: Python<'_>, path: PathBuf, lengths: Option<HashMap<String, f64>>) -> PyResult<Self> {
        Self::new(&Bound::new(py, Model::from_file(py, path)?)?, lengths)
    }

    /// The set-up of a project file, or of the folder that it lies in: of the runs that were made. `Project` has their files, too.
    #[staticmethod]
    #[pyo3(signature = (path, /, **lengths))]
    fn from_project<'py>(
        py: Python<'py>,
        path: PathBuf,
        lengths: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        py.import("trunnion")?.getattr("Project")?.call((path,), lengths)?.getattr("setup")
    }

    /// A model file's text, or its tables as a dict, with its lengths, mm.
    #[staticmethod]
    #[pyo3(signature = (description, /, **lengths))]
    fn from_description(description: &Bound<'_, PyAny>, lengths: Option<HashMap<String, f64>>) -> PyResult<Self> {
        Self::new(&Bound::new(description.py(), Model::from_description(description, "description")?)?, lengths)
    }

    #[staticmethod]
    fn _of(model: &Bound<'_, Model>, lengths: BTreeMap<String, f64>, kept: Option<Vec<String>>) -> PyResult<Self> {
        Self::of(model, lengths, kept)
    }

    /// Names of the runs.
    #[getter]
    fn runs(&self) -> Vec<&str> {
        self.setup.model.runs.iter().map(|run| run.name.as_str()).collect()
    }

    /// The estimated functions.
    #[getter]
    fn functions(&self) -> Vec<String> {
        self.setup.estimated().map(|f| self.setup.function_name(f)).collect()
    }

    /// What its runs tell, exact: of a subset's only those.
    fn derive(&self) -> Derivation {
        Derivation::of(self.setup.model.clone(), self.setup.derivation.clone())
    }

    /// The same with only some of its runs, derived anew.
    fn subset(&self, py: Python<'_>, runs: Vec<String>) -> PyResult<Self> {
        runs.iter().try_for_each(|name| self.run(name).map(|_| ()))?;
        Self::of(self.model.bind(py), self.lengths.clone(), Some(runs))
    }

    /// Names of the base parameters that a run sees.
    fn regressors(&self, run: &str) -> PyResult<Vec<&str>> {
        let derivation = &self.setup.derivation;
        let regressors = derivation.runs[self.run(run)?].regressors.iter();
        Ok(regressors.map(|(base, _)| derivation.base[*base].name.as_str()).collect())
    }

    /// Names of a run's known functions, as columns have them without the unit.
    fn known(&self, run: &str) -> PyResult<Vec<String>> {
        let known = self.setup.derivation.runs[self.run(run)?].known.iter();
        Ok(known.map(|(function, _)| known_name(&self.setup.model, *function)).collect())
    }

    /// The rows of a run at values of its sweep.
    ///
    /// `sweeps`: (n,), rad, in the order in which they are visited. Gives (n, p), Fortran order, a column for each of
    /// `regressors(run)`: mm for each unit of its base parameter. The reading, mm, is `rows @ coefficients`, and what known
    /// functions add.
    fn rows<'py>(&self, run: &str, sweeps: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (py, id) = (sweeps.py(), self.run(run)?);
        let sweeps = array(run, "the sweep", sweeps)?;
        let (setup, values) = (&self.setup, sweeps.as_slice()?);
        let columns = setup.derivation.runs[id].regressors.len();
        let rows = PyArray2::zeros(py, [values.len(), columns], true);
        let mut room = rows.readwrite();
        let out = room.as_slice_mut()?;
        py.detach(|| setup.rows(id, values, out)).map_err(|e| Class::Data.error(e))?;
        drop(room);
        Ok(rows)
    }

    /// Draws a machine within the limits of its errors and measures it: exact lengths, nothing linearised.
    ///
    /// `samples` of each run over `range_deg` (without it the full turn, as far as the axes go), uniform noise of ± `noise_um` µm,
    /// limits in µm and µrad (without them the model's, else ±30 µm and ±100 µrad).
    #[pyo3(signature = (*, seed=1, samples=360, noise_um=0.1, range_deg=None, length_um=None, angle_urad=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn simulate(
        &self,
        py: Python<'_>,
        seed: u64,
        samples: usize,
        noise_um: f64,
        range_deg: Option<(f64, f64)>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Simulated> {
        let limits = limits(&self.setup.model, length_um, angle_urad)?;
        let simulation = self.simulation(samples, noise_um, range_deg, seed, limits)?;
        let simulated = py.detach(|| simulation.measure(&self.setup));
        Ok(Simulated { setup: Arc::clone(&self.setup), simulated })
    }

    /// Fits recordings of all runs.
    ///
    /// `runs` maps each run's name to a recording, or to a list of them where it was measured several times: a tuple of two arrays
    /// (n,), the sweep in rad and the reading in mm; a dict of arrays or a frame of pandas, polars or pyarrow whose columns say their
    /// units (`a_deg` or `a_rad`, `dr_um` or `dr_mm`, known functions as `dya_um` with their standard uncertainty as `u_dya_um`); or
    /// the path of a file, then for all runs, with `table` for the known functions and `columns` for what columns are called where they
    /// have other names: `{"a": "Angle [deg]"}`, or with the unit stated `{"dr_um": "Radius"}`.
    ///
    /// `estimator`: "joint" or "two-step". `robust`: weigh readings down that are far off the others (Huber). `weights`: one over the
    /// variance of a run's readings, up to a common factor. `sigma_um`: the standard deviation of a reading, µm, where it is known;
    /// else it is taken from the residuals.
    ///
    /// Samples are in the order in which they were taken. `float64` arrays are read where they lie, and must not change meanwhile:
    /// other threads go on.
    #[pyo3(signature = (runs, /, *, table=None, columns=None, estimator="joint", robust=false, weights=None, sigma_um=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn fit(
        &self,
        py: Python<'_>,
        runs: &Bound<'_, PyAny>,
        table: Option<PathBuf>,
        columns: Option<BTreeMap<String, String>>,
        estimator: &str,
        robust: bool,
        weights: Option<BTreeMap<String, f64>>,
        sigma_um: Option<f64>,
    ) -> PyResult<Fit> {
        let setup = self.setup.as_ref();
        let how = How { estimator: self::estimator(estimator)?, variance: variance(sigma_um)?, robust };
        let weights: Vec<(&str, f64)> = weights.iter().flatten().map(|(run, weight)| (run.as_str(), *weight)).collect();
        let (fit, observations, without_table) = match Given::new(setup, runs)? {
            Given::Files(runs) => {
                let (columns, table) = (files::columns(columns)?, table.as_deref());
                let files = Files { runs: &runs, columns, table, weights: &weights };
                let (fit, observations) = py.detach(|| files.fit(setup, how))?;
                (fit, observations, table.is_none())
            }
            Given::Arrays(_) if columns.is_some() => {
                let told = "columns: of no use with arrays\n  expected columns by their own names: a_deg, dr_um, …";
                return Err(PyTypeError::new_err(told));
            }
            Given::Arrays(_) if table.is_some() => {
                let told = "table: of no use with arrays\n  expected the known functions as columns beside the readings: dya_um, …";
                return Err(PyTypeError::new_err(told));
            }
            Given::Arrays(recorded) => {
                complete(setup, &recorded)?;
                let arrays = recorded.iter().map(|own| own.arrays(setup));
                let mut arrays: Vec<Arrays<'_>> = arrays.collect::<PyResult<_>>()?;
                weigh(setup, &mut arrays, &weights).map_err(|e| Class::Data.error(e))?;
                let fitted = py.detach(|| fit_recorded(setup, &arrays, how).map_err(errors::of_arrays));
                let (fit, observations) = fitted.map_err(|e| errors::estimate(&e))?;
                (fit, observations, !recorded.iter().any(|own| own.has_known()))
            }
        };
        Ok(Fit::new(&self.setup, fit, observations, without_table))
    }

    /// What such runs would give, before anything is measured: rank, condition, the standard deviation of each base parameter, the
    /// largest standard and expanded uncertainty of each estimated function in its unit, from noise alone.
    #[pyo3(signature = (*, samples=360, noise_um=0.1, range_deg=None, estimator="joint"))]
    fn predict<'py>(
        &self,
        py: Python<'py>,
        samples: usize,
        noise_um: f64,
        range_deg: Option<(f64, f64)>,
        estimator: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (from, to) = range(range_deg.unwrap_or((0.0, 360.0)))?;
        let intended = Intended {
            samples: within("samples", samples, 2..=100_000)?,
            range: (Unit::Deg.to_inner(from), Unit::Deg.to_inner(to)),
            sigma: uniform_std(size("noise_um", noise_um)? * Unit::Um.factor()),
        };
        let estimator = self::estimator(estimator)?;
        let predicted = py.detach(|| predict(&self.setup, intended, estimator));
        object(py, &document::prediction(&self.setup, &predicted.map_err(|e| errors::estimate(&e))?))
    }

    /// The positions at which runs are best stopped (`count` of each run, or `in_all`; or the fewest that are `within`, µm or µrad, 95 %
    /// from noise), for all functions or some, beside as many spread evenly: `trunnion plan --positions`. `ranges`: how far axes go in
    /// place of the model's ranges, `{"A": (-45.0, 30.0)}`, degrees or mm; a `ValueError` where low is not below high, a `DataError` of an
    /// axis that the machine has not.
    #[pyo3(signature = (count=None, *, in_all=false, functions=None, within=None, ranges=None, step_deg=5.0, noise_um=0.1))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn positions<'py>(
        &self,
        py: Python<'py>,
        count: Option<usize>,
        in_all: bool,
        functions: Option<Vec<String>>,
        within: Option<Vec<f64>>,
        ranges: Option<Ranges>,
        step_deg: f64,
        noise_um: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        object(py, &Wanted { count, in_all, functions, within, step_deg, noise_um, ranges }.propose(py, &self.setup)?)
    }

    /// How large the error of each estimated function gets over many drawn machines: for each its distribution, from noise, from
    /// linearisation and from both, in its unit. Arguments as of `simulate`.
    #[pyo3(signature = (*, trials=2000, estimator="joint", noise_alone=false, seed=1, samples=360, noise_um=0.1, range_deg=None, length_um=None, angle_urad=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn monte_carlo<'py>(
        &self,
        py: Python<'py>,
        trials: u64,
        estimator: &str,
        noise_alone: bool,
        seed: u64,
        samples: usize,
        noise_um: f64,
        range_deg: Option<(f64, f64)>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let limits = limits(&self.setup.model, length_um, angle_urad)?;
        let simulation = self.simulation(samples, noise_um, range_deg, seed, limits)?;
        let draws = simulation.draws(within("trials", trials, 1..=100_000)?);
        let (drawn, estimator) =
            (if noise_alone { Drawn::NoiseAlone } else { Drawn::Machines }, self::estimator(estimator)?);
        let studies = py.detach(|| studies(&self.setup, draws, drawn, &[estimator], &|| {}));
        let studies = studies.map_err(|e| Class::Estimate.error(e))?;
        object(py, &serde_json::Value::Array(studies.iter().map(document::study).collect()))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.get());
        let arguments = (own.model.bind(py), own.lengths.clone(), own.kept.clone());
        Ok((py.get_type::<Self>().getattr("_of")?, arguments.into_pyobject(py)?))
    }

    fn __repr__(&self) -> String {
        let lengths: Vec<String> = self.lengths.iter().map(|(name, mm)| format!("{name} = {mm} mm")).collect();
        format!("<trunnion.Setup {}: {}; runs {}>", self.setup.model.name, lengths.join(", "), self.runs().join(", "))
    }
}
