//! An estimate with its covariance, and what a report says of it.

use crate::arguments::{Stated, instrument, limits};
use crate::errors::Class;
use crate::object::object;
use crate::table::{Given, array};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::sync::Arc;
use trunnion::data::MachineAtHand;
use trunnion::document;
use trunnion::study::{self, Observation, coefficient_unit, report_on};
use trunnion_codegen::emit::equations;
use trunnion_codegen::ids::FunctionId;

/// A function's values and their standard uncertainties.
type Curve<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// An estimate of the base parameters.
#[pyclass(frozen, module = "trunnion")]
pub struct Fit {
    setup: Arc<trunnion::Setup>,
    fit: study::Fit,
    /// Those that stand for all samples.
    observations: Vec<Observation>,
    without_table: bool,
    /// What is told of the machine at hand.
    machine: MachineAtHand,
}

impl Fit {
    pub fn new(
        setup: &Arc<trunnion::Setup>,
        fit: study::Fit,
        observations: Vec<Observation>,
        without_table: bool,
    ) -> Self {
        let machine = MachineAtHand::default();
        Self { setup: Arc::clone(setup), fit, observations, without_table, machine }
    }

    /// The same with what is told of the machine at hand.
    pub fn of_machine(self, machine: &MachineAtHand) -> Self {
        Self { machine: machine.clone(), ..self }
    }

    fn function_id(&self, name: &str) -> PyResult<FunctionId> {
        let names: Vec<String> = self.setup.estimated().map(|f| self.setup.function_name(f)).collect();
        let error = || format!("`{name}` is not estimated\n  expected one of {}", names.join(", "));
        self.setup
            .estimated()
            .find(|f| self.setup.function_name(*f) == name)
            .ok_or_else(|| Class::Estimate.error(error()))
    }

    fn report_value(
        &self,
        py: Python<'_>,
        instrument: Option<Stated>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<serde_json::Value> {
        let (setup, observations) = (&self.setup, &self.observations);
        let limits = limits(&setup.model, length_um, angle_urad)?;
        let (instrument, name) = self::instrument(&setup.model, instrument)?;
        let report = py.detach(|| {
            let report = report_on(setup, observations, &self.fit, limits, &instrument, self.without_table)?;
            let mut told = document::report(setup, &report);
            told["instrument"]["name"] = name.into();
            document::at_hand(&mut told, &self.machine);
            Ok(told)
        });
        report.map_err(|e: study::SetupError| Class::Model.error(e))
    }
}

#[pymethods]
impl Fit {
    /// How the runs were combined.
    #[getter]
    fn estimator(&self) -> String {
        self.fit.estimator.to_string()
    }

    /// Names of the base parameters, in the order of the coefficients.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.fit.base.iter().map(|b| self.setup.derivation.base[*b].name.as_str()).collect()
    }

    /// What each coefficient is in physical parameters.
    #[getter]
    fn definitions(&self) -> Vec<String> {
        let derivation = &self.setup.derivation;
        let definition = |b| equations::definition(&self.setup.model, derivation, &derivation.base[b]);
        self.fit.base.iter().map(|b| definition(*b)).collect()
    }

    /// The unit of each coefficient.
    #[getter]
    fn units(&self) -> Vec<String> {
        self.fit.base.iter().map(|b| coefficient_unit(&self.setup, *b)).collect()
    }

    /// The estimate, (p,): `uncertainties.correlated_values(fit.coefficients, fit.covariance)`.
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.fit.values.as_slice())
    }

    /// Its covariance from the scatter of the readings, (p, p).
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let covariance = &self.fit.covariance;
        // Symmetric: rows are columns.
        PyArray1::from_slice(py, covariance.as_slice()).reshape([covariance.nrows(), covariance.ncols()])
    }

    /// The standard deviation of each coefficient from the scatter of the readings, (p,).
    #[getter]
    fn std<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.fit.covariance.diagonal().iter().map(|variance| variance.max(0.0).sqrt()))
    }

    /// Of the residuals.
    #[getter]
    fn degrees_of_freedom(&self) -> u32 {
        self.fit.degrees_of_freedom
    }

    /// Condition number of the design, columns scaled.
    #[getter]
    fn condition(&self) -> f64 {
        self.fit.separation.condition
    }

    /// Root mean square of the residuals of each recording, mm; of a factor those of each run together.
    #[getter]
    fn rms<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.fit.rms)
    }

    /// Of each estimated function what its numbers are of.
    #[getter]
    fn functions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for seen in self.fit.functions() {
            all.set_item(self.setup.function_name(seen.function()), seen.told(&self.setup).words)?;
        }
        Ok(all)
    }

    /// An estimated function, or the sum it is seen in, at coordinates of its axis (n,), rad or mm: values and their standard
    /// deviations from the scatter of the readings, rad or mm.
    fn function<'py>(&self, py: Python<'py>, name: &str, at: &Bound<'py, PyAny>) -> PyResult<Curve<'py>> {
        let function = self.function_id(name)?;
        let at = array(name, "the coordinate", at)?;
        let points = at.as_slice()?;
        let values =
            py.detach(|| points.iter().map(|x| self.fit.function(&self.setup, function, *x)).collect::<Vec<_>>());
        let (values, stds): (Vec<f64>, Vec<f64>) = values.into_iter().unzip();
        Ok((PyArray1::from_vec(py, values), PyArray1::from_vec(py, stds)))
    }

    /// Whether it is of a factor: `report` then has None for `recordings` (traces and histograms of residuals), and its warnings know
    /// neither single residuals far out nor the mistake that explains a misfit.
    #[getter]
    fn of_factor(&self) -> bool {
        self.fit.of_factor
    }

    /// Readings less what the estimate makes of them, mm: for each run a list of arrays, one for each of its recordings. `runs` as of
    /// `fit`, arrays or frames; of a factor, too, whose samples are at hand.
    fn residuals<'py>(&self, py: Python<'py>, runs: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let Given::Arrays(recorded) = Given::new(&self.setup, runs)? else {
            return Err(PyTypeError::new_err("runs: files\n  expected arrays or frames"));
        };
        let all = PyDict::new(py);
        for own in &recorded {
            let arrays = own.arrays(&self.setup)?;
            let residuals = py.detach(|| self.fit.residuals(&self.setup, &arrays));
            let name = &self.setup.model.runs[own.run()].name;
            let list = match all.get_item(name)? {
                Some(list) => list,
                None => {
                    all.set_item(name, PyList::empty(py))?;
                    all.as_any().get_item(name)?
                }
            };
            list.call_method1("append", (PyArray1::from_vec(py, residuals),))?;
        }
        Ok(all)
    }

    /// Everything of the fit with its uncertainty: what `trunnion fit --json` prints but `made`, what it says of itself. `instrument`:
    /// "QC20-W", or values in place of the model's as in its `[instrument]`: `{"constant_um": 0.5, "proportional": 0.001}`; limits of the machine's errors in µm and µrad, without them the model's.
    #[pyo3(signature = (*, instrument=None, length_um=None, angle_urad=None))]
    fn report<'py>(
        &self,
        py: Python<'py>,
        instrument: Option<Stated>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let report = self.report_value(py, instrument, length_um, angle_urad)?;
        object(py, &report)
    }

    /// What a function's uncertainty is made of where it is largest: the lines of the budget with their standard uncertainties in the
    /// function's unit, and the rows of `inputs`.
    #[pyo3(signature = (function, /, *, instrument=None, length_um=None, angle_urad=None))]
    fn budget<'py>(
        &self,
        py: Python<'py>,
        function: &str,
        instrument: Option<Stated>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.function_id(function)?;
        let report = self.report_value(py, instrument, length_um, angle_urad)?;
        let curves = report["functions"].as_array().into_iter().flatten();
        let largest = curves.filter(|curve| curve["name"] == function).map(|curve| &curve["largest"]).next();
        object(py, largest.unwrap_or(&serde_json::Value::Null))
    }

    fn __repr__(&self) -> String {
        format!(
            "<trunnion.Fit of {}, {}: {} coefficients, condition {:.1}>",
            self.setup.model.name,
            self.fit.estimator,
            self.fit.base.len(),
            self.fit.separation.condition
        )
    }
}
