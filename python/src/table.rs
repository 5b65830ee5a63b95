//! Runs as a program has them: pairs of arrays, frames whose columns say their units, files.

use crate::errors::{self, Class};
use numpy::{PyReadonlyArray1, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString, PyTuple};
use std::path::PathBuf;
use trunnion::Setup;
use trunnion::data::ObservationsError;
use trunnion::study::{Arrays, Column, KnownColumn};
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::quantity::Unit;

/// Units of an angle's columns, and of a deviation's.
const SWEEP: &[Unit] = &[Unit::Deg, Unit::Rad];
const LENGTH: &[Unit] = &[Unit::Um, Unit::Mm];
const ANGLE: &[Unit] = &[Unit::Urad, Unit::Rad];

/// Numbers of Python's with their unit, borrowed for as long as they are used.
pub struct Numbers<'py> {
    values: PyReadonlyArray1<'py, f64>,
    unit: Unit,
}

impl Numbers<'_> {
    fn column(&self) -> PyResult<Column<'_>> {
        Ok(Column { values: self.values.as_slice()?, unit: self.unit })
    }
}

/// One recording in arrays.
pub struct Recorded<'py> {
    run: RunId,
    sweep: Numbers<'py>,
    reading: Numbers<'py>,
    known: Vec<(String, Numbers<'py>, Option<Numbers<'py>>)>,
}

impl Recorded<'_> {
    /// As the library takes it; nothing is copied.
    pub fn arrays(&self, setup: &Setup) -> PyResult<Arrays<'_>> {
        let mut known = Vec::new();
        for (name, values, std) in &self.known {
            let std = std.as_ref().map(Numbers::column).transpose()?;
            known.push(KnownColumn { name, values: values.column()?, std });
        }
        let arrays = Arrays::new(setup, self.run, self.sweep.column()?, self.reading.column()?, &known);
        arrays.map_err(|e| Class::Data.error(e))
    }

    pub fn run(&self) -> RunId {
        self.run
    }

    pub fn has_known(&self) -> bool {
        !self.known.is_empty()
    }
}

/// What is fitted.
pub enum Given<'py> {
    /// Files by the names of their runs.
    Files(Vec<(String, PathBuf)>),
    /// Arrays.
    Arrays(Vec<Recorded<'py>>),
}

impl<'py> Given<'py> {
    /// Of a mapping from the names of runs to what was recorded, a list where a run was measured several times.
    pub fn new(setup: &Setup, runs: &Bound<'py, PyAny>) -> PyResult<Self> {
        let not = |_| PyTypeError::new_err("runs: not a mapping\n  expected {\"RUN\": (sweep_rad, reading_mm), …}");
        let (mut files, mut arrays) = (Vec::new(), Vec::new());
        for item in runs.call_method0("items").map_err(not)?.try_iter()? {
            let (name, value): (String, Bound<'py, PyAny>) = item?.extract()?;
            let several = match value.cast::<PyList>() {
                Ok(list) => list.iter().collect(),
                Err(_) => vec![value],
            };
            for one in several {
                if one.is_instance_of::<PyString>() || one.hasattr("__fspath__")? {
                    files.push((name.clone(), one.extract::<PathBuf>()?));
                } else {
                    arrays.extend(recorded(setup, &name, &one)?);
                }
            }
        }
        match (files.is_empty(), arrays.is_empty()) {
            (true, true) => Err(Class::Data.error("no run is given\n  expected one for each run of the model")),
            (false, false) => Err(PyTypeError::new_err("runs: files and arrays\n  expected all of one kind")),
            (false, true) => Ok(Self::Files(files)),
            (true, false) => {
                // In the model's order; each run's in the order they were given, as of files.
                arrays.sort_by_key(|recorded| recorded.run);
                Ok(Self::Arrays(arrays))
            }
        }
    }
}

/// Whether every run has a recording.
pub fn complete(setup: &Setup, recorded: &[Recorded<'_>]) -> PyResult<()> {
    let missing = setup.model.runs.keys().find(|run| recorded.iter().all(|own| own.run != *run));
    let error = |run: RunId| ObservationsError::RunMissing(setup.model.runs[run].name.clone());
    missing.map_or(Ok(()), |run| Err(errors::observations(&error(run))))
}

/// A recording of a run, or of the three that read displacements at once.
fn recorded<'py>(setup: &Setup, name: &str, value: &Bound<'py, PyAny>) -> PyResult<Vec<Recorded<'py>>> {
    if let Some(run) = setup.run(name) {
        return Ok(vec![one(setup, name, run, "dr", value)?]);
    }
    let channels = [("x", "dx"), ("y", "dy"), ("z", "dz")];
    let runs: Vec<_> =
        channels.iter().filter_map(|(end, dr)| Some((setup.run(&format!("{name}-{end}"))?, *dr))).collect();
    if runs.len() == channels.len() {
        return runs.into_iter().map(|(run, reading)| one(setup, name, run, reading, value)).collect();
    }
    let runs = setup.model.runs.iter().map(|run| run.name.clone()).collect();
    Err(errors::observations(&ObservationsError::UnknownRun { run: name.to_owned(), runs }))
}

fn one<'py>(setup: &Setup, name: &str, run: RunId, dr: &str, value: &Bound<'py, PyAny>) -> PyResult<Recorded<'py>> {
    if let Ok(pair) = value.cast::<PyTuple>() {
        let [sweep, reading] = pair.iter().collect::<Vec<_>>().try_into().map_err(|_| {
            Class::Data.error(format!("run `{name}`: a tuple of {}\n  expected (sweep_rad, reading_mm)", pair.len()))
        })?;
        let numbers = |what: &str, values, unit| Ok::<_, PyErr>(Numbers { values: array(name, what, &values)?, unit });
        let (sweep, reading) = (numbers("the sweep", sweep, Unit::Rad)?, numbers("the reading", reading, Unit::Mm)?);
        return Ok(Recorded { run, sweep, reading, known: Vec::new() });
    }
    let frame = Frame::new(name, value)?;
    let angle = setup.model.alphabet.sweep_name(setup.model.runs[run].sweep);
    let mut known = Vec::new();
    for (function, _) in &setup.derivation.runs[run].known {
        let stem = known_name(&setup.model, *function);
        let units = if setup.quantity(*function).inner() == Unit::Mm { LENGTH } else { ANGLE };
        if let Some(values) = frame.column(&stem, units)? {
            let std = frame.column(&format!("u_{stem}"), units)?;
            known.push((stem, values, std));
        }
    }
    Ok(Recorded { run, sweep: frame.wanted(angle, SWEEP)?, reading: frame.wanted(dr, LENGTH)?, known })
}

/// Columns by their names: a dict of arrays, a frame of pandas or polars, a table of pyarrow.
struct Frame<'a, 'py> {
    run: &'a str,
    names: Vec<String>,
    frame: &'a Bound<'py, PyAny>,
}

impl<'a, 'py> Frame<'a, 'py> {
    fn new(run: &'a str, frame: &'a Bound<'py, PyAny>) -> PyResult<Self> {
        let not = |_| {
            PyTypeError::new_err(format!(
                "run `{run}`: neither arrays nor columns\n  expected (sweep_rad, reading_mm), or a frame or dict with columns such as a_deg, dr_um"
            ))
        };
        let names = match (frame.getattr_opt("column_names")?, frame.getattr_opt("columns")?) {
            (Some(names), _) | (None, Some(names)) => names,
            (None, None) => frame.call_method0("keys").map_err(not)?,
        };
        let names = names.try_iter()?.map(|name| Ok(name?.str()?.to_string())).collect::<PyResult<_>>()?;
        Ok(Self { run, names, frame })
    }

    /// A column by its name without the unit.
    fn column(&self, stem: &str, units: &[Unit]) -> PyResult<Option<Numbers<'py>>> {
        let named = units.iter().map(|unit| (format!("{stem}_{unit}"), *unit));
        let mut found = named.filter(|(name, _)| self.names.contains(name));
        let Some((name, unit)) = found.next() else { return Ok(None) };
        if let Some((second, _)) = found.next() {
            let told = format!("run `{}`: both {name} and {second}\n  expected one of them", self.run);
            return Err(Class::Data.error(told));
        }
        Ok(Some(Numbers { values: array(self.run, &name, &self.frame.get_item(&name)?)?, unit }))
    }

    fn wanted(&self, stem: &str, units: &[Unit]) -> PyResult<Numbers<'py>> {
        self.column(stem, units)?.ok_or_else(|| {
            let names: Vec<String> = units.iter().map(|unit| format!("{stem}_{unit}")).collect();
            let found = self.names.join(", ");
            Class::Data.error(format!("run `{}`: no column {}\n  found {found}", self.run, names.join(" or ")))
        })
    }
}

/// One-dimensional numbers as they are, or as a copy where they have another type or lie apart.
pub fn array<'py>(of: &str, what: &str, value: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let array = numbers(of, what, value)?;
    let shape = array.cast::<PyUntypedArray>()?.shape();
    if shape.len() != 1 {
        return Err(Class::Data.error(format!("run `{of}`: {what} has the shape {shape:?}\n  expected one dimension")));
    }
    array.extract()
}

/// Numbers of any shape, as `float64` in C order.
pub fn numbers<'py>(of: &str, what: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let np = value.py().import("numpy")?;
    let array = match np.getattr("ma")?.call_method1("isMaskedArray", (value,))?.extract()? {
        // What is masked is no number.
        true => value.call_method1("astype", ("float64",))?.call_method1("filled", (f64::NAN,))?,
        false => np.call_method1("asarray", (value,))?,
    };
    let float = np.getattr("float64")?;
    let (from, kind) = (array.getattr("dtype")?, "same_kind");
    if !np.call_method1("can_cast", (&from, &float, kind))?.extract::<bool>()? {
        return Err(PyTypeError::new_err(format!("{of}: {what} has the type {from}\n  expected real numbers")));
    }
    // A scalar stays one.
    np.call_method1("require", (array, float, "C"))
}
