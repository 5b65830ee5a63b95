//! Descriptions and what is derived from them.

use crate::arguments::{Ranges, Stated, instrument, limits, ranged, size, within};
use crate::compared::Compared;
use crate::errors::{self, Class};
use crate::object::object;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::sync::Arc;
use trunnion::data::read_text;
use trunnion::document;
use trunnion::study::plan::design::{Asked, Measured, design, estimated};
use trunnion::study::plan::uniform_std;
use trunnion::study::write_ranges;
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::c::Precision;
use trunnion_codegen::emit::rust::{self, Support};
use trunnion_codegen::emit::{c99, equations, numpy};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::model as described;
use trunnion_codegen::problems::{Described, Named};
use trunnion_codegen::quantity::Unit;

/// Names of the catalogue's models.
#[pyfunction]
pub fn models() -> Vec<&'static str> {
    catalogue::MODELS.iter().map(|(name, _)| *name).collect()
}

/// A description of a machine, its runs, and what is assumed of its errors.
#[pyclass(frozen, module = "trunnion")]
pub struct Model {
    pub described: Arc<Described>,
    derivation: Py<Derivation>,
}

impl Model {
    fn new(py: Python<'_>, name: String, text: String) -> PyResult<Self> {
        Self::of(py, Described { model: Named { name, text }, stated: None })
    }

    pub fn of(py: Python<'_>, described: Described) -> PyResult<Self> {
        let derived = py.detach(|| described.derive());
        let (model, derivation) = derived.map_err(|found| errors::problems(&described, &found))?;
        let derivation = Py::new(py, Derivation::of(model, derivation))?;
        Ok(Self { described: Arc::new(described), derivation })
    }

    pub fn model(&self) -> &Arc<described::Model> {
        &self.derivation.get().model
    }
}

#[pymethods]
impl Model {
    /// A model of the catalogue, by its name.
    #[staticmethod]
    pub fn from_catalogue(py: Python<'_>, name: &str) -> PyResult<Self> {
        let known = || format!("no model `{name}` in the catalogue\n  expected one of {}", models().join(", "));
        let text = catalogue::source(name).ok_or_else(|| Class::Model.error(known()))?;
        Self::new(py, name.to_owned(), text.to_owned())
    }

    /// A model file.
    #[staticmethod]
    pub fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let name = path.display().to_string();
        let text = py.detach(|| read_text(&path));
        let text = text.map_err(|e| Class::Model.placed(format!("{name}: {e}"), Some(name.clone()), None, None))?;
        Self::new(py, name, text)
    }

    /// A model file's text, or its tables as a dict.
    #[staticmethod]
    #[pyo3(signature = (description, /, name="description"))]
    pub fn from_description(description: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        let py = description.py();
        let text = match description.cast::<PyString>() {
            Ok(text) => text.to_string(),
            Err(_) => py.import("trunnion._description")?.call_method1("toml", (description,))?.extract()?,
        };
        Self::new(py, name.to_owned(), text)
    }

    #[staticmethod]
    fn _of(py: Python<'_>, name: String, text: String, stated: Option<(String, String)>) -> PyResult<Self> {
        let stated = stated.map(|(name, text)| Named { name, text });
        Self::of(py, Described { model: Named { name, text }, stated })
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.model().name
    }

    /// One line for people.
    #[getter]
    fn title(&self) -> &str {
        &self.model().title
    }

    /// The equations for reading.
    #[getter]
    fn text(&self) -> &str {
        &self.described.model.text
    }

    /// Names of its runs.
    #[getter]
    fn runs(&self) -> Vec<&str> {
        self.model().runs.iter().map(|run| run.name.as_str()).collect()
    }

    /// Names of the set-up's lengths.
    #[getter]
    fn lengths(&self) -> Vec<&str> {
        self.model().alphabet.constants().collect()
    }

    /// The equations, base parameters and kernel, exact.
    fn derive(&self, py: Python<'_>) -> Py<Derivation> {
        self.derivation.clone_ref(py)
    }

    /// Searches the runs for these estimated functions: the fewest placings of the balls, then the fewest runs, among the model's own
    /// and those that its machine allows. `within`: the expanded uncertainty of 95 % from all sources, µrad or µm, one for all or one
    /// for each. `ranges`: how far axes go in place of the model's ranges, `{"A": (-30.0, 120.0)}`, degrees or mm; a `ValueError` where low
    /// is not below high, a `DataError` of an axis that the machine has not. `model_file` of a proposal is ready for the model file.
    #[pyo3(signature = (functions, /, *, within=None, lengths=None, ranges=None, samples=360, noise_um=0.1, instrument=None, length_um=None, angle_urad=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn plan<'py>(
        &self,
        py: Python<'py>,
        functions: Vec<String>,
        within: Option<Vec<f64>>,
        lengths: Option<BTreeMap<String, f64>>,
        ranges: Option<Ranges>,
        samples: usize,
        noise_um: f64,
        instrument: Option<Stated>,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let model = &*ranged(self.model(), ranges)?;
        let refused = |e| Class::Estimate.error(e);
        let within = within.unwrap_or_default();
        if !matches!(within.len(), 0 | 1) && within.len() != functions.len() {
            let told = format!(
                "within: {} numbers for {} functions\n  expected one, or one for each",
                within.len(),
                functions.len()
            );
            return Err(Class::Estimate.error(told));
        }
        let mut asked = Vec::new();
        for (at, name) in functions.into_iter().enumerate() {
            let function = estimated(model, &name).map_err(refused)?;
            let unit = model.alphabet.error_quantity(model.functions[function].error).deviation();
            let own = within.get(at).or(within.first());
            asked.push((
                name,
                own.map(|own| crate::arguments::within("within", *own, 1e-9..=1e6))
                    .transpose()?
                    .map(|own| unit.to_inner(own)),
            ));
        }
        let measured = Measured {
            lengths: lengths.unwrap_or_default().into_iter().collect(),
            samples: self::within("samples", samples, 2..=100_000)?,
            range: (0.0, TAU),
            sigma: uniform_std(size("noise_um", noise_um)? * Unit::Um.factor()),
            limits: limits(model, length_um, angle_urad)?,
            instrument: self::instrument(model, instrument)?.0,
        };
        let asked = Asked { functions: asked, measured };
        let mut draft = self.described.draft().unwrap_or_default();
        write_ranges(model, &mut draft);
        let found = py.detach(|| design(&draft, model, &asked, &|_| {}));
        object(py, &document::design(model, &found.map_err(refused)?))
    }

    /// What its runs would give, before anything is measured, with one bar or another (`radius`, mm), over one range or another
    /// (`range_deg`) and without some (`without`: lists of runs that are left out together; each in turn if none is given); which
    /// are enough; what they confound, and which runs of the catalogue would help. Runs go as far as the ranges of their axes let them:
    /// the model's, or those of `ranges`, `{"A": (-30.0, 120.0)}`, degrees or mm; a `ValueError` where low is not below high, a
    /// `DataError` of an axis that the machine has not. From noise alone: `trunnion plan`.
    #[pyo3(signature = (*, radius=None, lengths=None, ranges=None, range_deg=None, without=None, samples=360, noise_um=0.1, estimator="joint", length_um=None, angle_urad=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn compare<'py>(
        &self,
        py: Python<'py>,
        radius: Option<Vec<f64>>,
        lengths: Option<BTreeMap<String, f64>>,
        ranges: Option<Ranges>,
        range_deg: Option<Vec<(f64, f64)>>,
        without: Option<Vec<Vec<String>>>,
        samples: usize,
        noise_um: f64,
        estimator: &str,
        length_um: Option<f64>,
        angle_urad: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let model = ranged(self.model(), ranges)?;
        let limits = limits(&model, length_um, angle_urad)?;
        let (estimator, lengths) = (crate::arguments::estimator(estimator)?, lengths.unwrap_or_default());
        let compared = Compared { radius, lengths, range_deg, without, samples, noise_um, estimator, limits };
        object(py, &compared.overview(py, &self.described, &model)?)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let Described { model: Named { name, text }, stated } = slf.get().described.as_ref();
        let stated = stated.as_ref().map(|Named { name, text }| (name, text));
        Ok((py.get_type::<Self>().getattr("_of")?, (name, text, stated).into_pyobject(py)?))
    }

    fn __repr__(&self) -> String {
        format!("<trunnion.Model {}: {}>", self.name(), self.title())
    }
}

/// What follows exactly from a description.
#[pyclass(frozen, module = "trunnion")]
pub struct Derivation {
    pub model: Arc<described::Model>,
    derivation: Arc<trunnion_codegen::identify::Derivation>,
}

#[pymethods]
impl Derivation {
    /// Number of base parameters that are not coefficients of an estimated function.
    #[getter]
    fn rank(&self) -> usize {
        self.derivation.rank()
    }

    /// The base parameters: each name with its definition.
    #[getter]
    fn base<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for base in &self.derivation.base {
            all.set_item(&base.name, equations::definition(&self.model, &self.derivation, base))?;
        }
        Ok(all)
    }

    /// Directions that change no reading: each parameter with its exact factor.
    #[getter]
    fn kernel<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        object(py, &self.json()["kernel"])
    }

    /// What cannot be told apart, in words.
    #[getter]
    fn confounded(&self) -> Vec<String> {
        let groups = self.derivation.groups();
        groups.iter().map(|group| equations::group(&self.model, &self.derivation, group)).collect()
    }

    /// Of each estimated function how far it is determined: True or the words.
    #[getter]
    fn functions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for determination in &self.derivation.functions {
            let error = self.model.functions[determination.function].error;
            let name = self.model.notation.function(self.model.alphabet.error_name(error));
            match determination.extent() {
                Extent::Determined => all.set_item(name, true)?,
                _ => all.set_item(
                    name,
                    equations::extent(&self.model, &self.derivation, determination, equations::Style::Pretty),
                )?,
            }
        }
        Ok(all)
    }

    /// Errors that no run sees at first order.
    #[getter]
    fn unseen(&self) -> Vec<&str> {
        self.derivation.unseen.iter().map(|error| self.model.alphabet.error_name(*error)).collect()
    }

    fn text(&self) -> String {
        equations::text(&self.model, &self.derivation)
    }

    /// The equations for a paper: `align` of amsmath.
    fn latex(&self) -> String {
        equations::latex(&self.model, &self.derivation)
    }

    /// Everything for a program: what `trunnion derive --emit json` prints.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        object(py, &self.json())
    }

    /// Source code: "rust", "c" or "numpy".
    fn source(&self, language: &str) -> PyResult<String> {
        let (model, derivation) = (&self.model, &self.derivation);
        let known = [("rust", 0), ("c", 1), ("numpy", 2)];
        let printed = match crate::arguments::word("language", language, &known)? {
            0 => rust::model_source(model, derivation, &Support::of_solver()),
            1 => c99::sources(model, derivation, Precision::Double).map(|sources| sources.single()),
            _ => numpy::model_source(model, derivation),
        };
        printed.map_err(|e| Class::Model.error(format!("the derived row is wrong: {e}")))
    }

    fn _repr_latex_(&self) -> String {
        equations::latex_equations(&self.model, &self.derivation)
    }

    fn __str__(&self) -> String {
        self.text()
    }

    fn __repr__(&self) -> String {
        format!("<trunnion.Derivation of {}: rank {}>", self.model.name, self.rank())
    }
}

impl Derivation {
    pub fn of(model: described::Model, derivation: trunnion_codegen::identify::Derivation) -> Self {
        Self { model: Arc::new(model), derivation: Arc::new(derivation) }
    }

    fn json(&self) -> serde_json::Value {
        equations::json(&self.model, &self.derivation)
    }
}
