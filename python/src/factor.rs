//! What samples have come to: it pickles and merges.

use crate::arguments::{estimator, variance};
use crate::errors::{self, Class};
use crate::fit::Fit;
use crate::setup::Setup;
use crate::table::Given;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use std::collections::BTreeMap;
use trunnion::study::{self, weigh};

/// What the samples of a set-up's runs have come to.
#[pyclass(module = "trunnion")]
pub struct Factor {
    factor: study::Factor,
}

#[pymethods]
impl Factor {
    /// What the samples of runs have come to: of constant size, however many they are. `runs` as of `Setup.fit`, arrays or frames, and
    /// not all need be there; `estimator`: "joint" or "two-step"; `weights` as of `Setup.fit`. There is no robust one: its weights need the residuals of samples.
    #[new]
    #[pyo3(signature = (setup, runs=None, /, *, estimator="joint", weights=None))]
    fn new(
        py: Python<'_>,
        setup: &Setup,
        runs: Option<&Bound<'_, PyAny>>,
        estimator: &str,
        weights: Option<BTreeMap<String, f64>>,
    ) -> PyResult<Self> {
        let factor = study::Factor::new(&setup.setup, self::estimator(estimator)?);
        let mut factor = Self { factor: factor.map_err(|e| errors::estimate(&e))? };
        runs.map_or(Ok(()), |runs| factor.push(py, setup, runs, weights))?;
        Ok(factor)
    }

    /// The estimate of all samples that it has taken, with its report and budget; `sigma_um` as of `Setup.fit`.
    ///
    /// What only samples tell is not there: `report()["recordings"]` is None, and warnings know neither single residuals far out nor the
    /// mistake that explains a misfit. Known functions that were zero all along count as no table.
    #[pyo3(signature = (setup, /, *, sigma_um=None))]
    fn solve(&self, py: Python<'_>, setup: &Setup, sigma_um: Option<f64>) -> PyResult<Fit> {
        let variance = variance(sigma_um)?;
        let solved = py.detach(|| self.factor.solve(&setup.setup, variance));
        let (fit, observations) = solved.map_err(|e| errors::factor(&e))?;
        Ok(Fit::new(&setup.setup, fit, observations, self.factor.without_table()))
    }

    /// From what `to_bytes` gives; bytes of anything else, damaged or of another version, are refused.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        study::Factor::from_bytes(bytes).map(|factor| Self { factor }).map_err(|e| Class::Factor.error(e))
    }

    /// As bytes: the same factor gives the same.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.factor.to_bytes())
    }

    /// Samples taken.
    #[getter]
    fn samples(&self) -> u64 {
        self.factor.samples()
    }

    /// How the runs are combined.
    #[getter]
    fn estimator(&self) -> String {
        self.factor.estimator().to_string()
    }

    /// Takes samples of runs of the set-up that it was made of; `runs` as of `Setup.fit`, arrays or frames, `weights`, too. All or none.
    #[pyo3(signature = (setup, runs, *, weights=None))]
    fn push(
        &mut self,
        py: Python<'_>,
        setup: &Setup,
        runs: &Bound<'_, PyAny>,
        weights: Option<BTreeMap<String, f64>>,
    ) -> PyResult<()> {
        let setup = setup.setup.as_ref();
        let Given::Arrays(recorded) = Given::new(setup, runs)? else {
            let told = "runs: files\n  expected arrays or frames: read the files first";
            return Err(PyTypeError::new_err(told));
        };
        let mut arrays = recorded.iter().map(|own| own.arrays(setup)).collect::<PyResult<Vec<_>>>()?;
        let weights: Vec<(&str, f64)> = weights.iter().flatten().map(|(run, weight)| (run.as_str(), *weight)).collect();
        weigh(setup, &mut arrays, &weights).map_err(|e| Class::Data.error(e))?;
        // All or none.
        let mut whole = self.factor.clone();
        let pushed = py.detach(|| arrays.iter().try_for_each(|own| whole.push(setup, own)).map_err(errors::of_arrays));
        pushed.map_err(|e| errors::factor(&e))?;
        self.factor = whole;
        Ok(())
    }

    /// Takes all samples of another of the same set-up; also `a + b` and `sum(factors)`.
    fn merge(&mut self, other: &Bound<'_, Self>) -> PyResult<()> {
        // One that is this one itself cannot be borrowed a second time: there is none.
        let other = other.try_borrow()?;
        self.factor.merge(&other.factor).map_err(|e| errors::factor(&e))
    }

    fn __add__(&self, other: &Bound<'_, Self>) -> PyResult<Self> {
        let mut sum = self.factor.clone();
        sum.merge(&other.try_borrow()?.factor).map_err(|e| errors::factor(&e))?;
        Ok(Self { factor: sum })
    }

    /// For `sum`, which begins with 0.
    fn __radd__(&self, zero: u8) -> PyResult<Self> {
        match zero {
            0 => Ok(Self { factor: self.factor.clone() }),
            _ => Err(PyTypeError::new_err("a factor is added to a factor alone")),
        }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let bytes = slf.try_borrow()?.to_bytes(py);
        Ok((py.get_type::<Self>().getattr("from_bytes")?, (bytes,).into_pyobject(py)?))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.extract::<PyRef<'_, Self>>().is_ok_and(|other| self.factor.to_bytes() == other.factor.to_bytes())
    }

    fn __repr__(&self) -> String {
        format!("<trunnion.Factor, {}: {} samples>", self.factor.estimator(), self.factor.samples())
    }
}
