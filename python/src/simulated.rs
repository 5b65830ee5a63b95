//! A drawn machine and what was read on it.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;
use trunnion::study::{self, Sample};
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::kinematics::ErrorValues;

use crate::errors::Class;
use crate::table::array;

/// A machine drawn at random, and its noisy readings.
#[pyclass(frozen, module = "trunnion")]
pub struct Simulated {
    pub setup: Arc<trunnion::Setup>,
    pub simulated: study::Simulated,
}

#[pymethods]
impl Simulated {
    /// Every run as columns: what `fit` takes.
    #[getter]
    fn runs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let model = &self.setup.model;
        for observation in &self.simulated.observations {
            let columns = PyDict::new(py);
            let run = &model.runs[observation.run];
            let put = |name: String, of: &dyn Fn(&Sample) -> f64| {
                columns.set_item(name, PyArray1::from_iter(py, observation.samples.iter().map(of)))
            };
            put(format!("{}_rad", model.alphabet.sweep_name(run.sweep)), &|sample| sample.sweep)?;
            put("dr_mm".to_owned(), &|sample| sample.reading)?;
            for (at, (function, _)) in self.setup.derivation.runs[observation.run].known.iter().enumerate() {
                let unit = self.setup.quantity(*function).inner();
                let value = |sample: &Sample| sample.known.get(at).copied().unwrap_or(0.0);
                put(format!("{}_{unit}", known_name(model, *function)), &value)?;
            }
            all.set_item(&run.name, columns)?;
        }
        Ok(all)
    }

    /// The true base parameters by name.
    #[getter]
    fn truth<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (base, value) in self.setup.derivation.base.iter().zip(self.simulated.machine.base(&self.setup)) {
            all.set_item(&base.name, value)?;
        }
        Ok(all)
    }

    /// True values of an estimated function at coordinates of its axis, rad or mm: in rad or mm.
    fn function<'py>(&self, name: &str, at: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let names: Vec<String> = self.setup.estimated().map(|f| self.setup.function_name(f)).collect();
        let error =
            || Class::Estimate.error(format!("`{name}` is not estimated\n  expected one of {}", names.join(", ")));
        let function = self.setup.estimated().find(|f| self.setup.function_name(*f) == name).ok_or_else(error)?;
        let error = self.setup.model.functions[function].error;
        let points = array(name, "the coordinate", at)?;
        let values = points.as_slice()?.iter().map(|x| self.simulated.machine.value(error, *x));
        Ok(PyArray1::from_iter(at.py(), values))
    }
}
