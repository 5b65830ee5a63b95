//! The parallel machine, for as many poses as there are.

use crate::arguments::word;
use crate::errors::{self, Class};
use crate::table::numbers;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use trunnion::exechon::{ALONG, Coordinates, Path, PointError, SolvedPose, read_machine};
use trunnion_solver::exechon::{Joints, Machine, Tilted};

/// A parallel machine of Exechon type.
#[pyclass(frozen, module = "trunnion")]
pub struct Exechon {
    machine: Machine<f64>,
}

/// What becomes of a pose that the machine cannot have.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Unreachable {
    Raise,
    Nan,
}

const FRAMES: &[(&str, Coordinates)] = &[("machine", Coordinates::Machine), ("base", Coordinates::Base)];
const TILTED: &[(&str, Tilted)] = &[("projected", Tilted::Projected), ("carried", Tilted::Carried)];
const UNREACHABLE: &[(&str, Unreachable)] = &[("raise", Unreachable::Raise), ("nan", Unreachable::Nan)];

#[pymethods]
impl Exechon {
    /// The built-in machine (XT700), or that of a machine file.
    #[new]
    #[pyo3(signature = (file=None))]
    fn new(file: Option<PathBuf>) -> PyResult<Self> {
        let name = file.as_deref().map_or_else(|| "built in".to_owned(), |file| file.display().to_string());
        let machine = read_machine(file.as_deref()).map_err(|e| errors::machine(&name, &e))?;
        Ok(Self { machine })
    }

    /// Struts and axes of tool points (n, 3), mm, and tool directions (n, 3) of length 1 (without them that at home), each from the
    /// pose before.
    ///
    /// Gives `struts` (n, 3) in mm, `a`, `c` and `drm` (the dependent rotation) (n,) in rad, `iterations` (n,). `frame`: "machine" or
    /// "base"; `tilted`: "projected" or "carried"; `unreachable`: "raise", or "nan" for poses that the machine cannot have.
    #[pyo3(signature = (points, directions=None, *, frame="machine", tilted="projected", unreachable="raise"))]
    fn ik<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        directions: Option<&Bound<'py, PyAny>>,
        frame: &str,
        tilted: &str,
        unreachable: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let solved = self.poses(py, points, directions, frame, tilted, unreachable, |solved| {
            let joints = solved.pose.joints;
            let [l1, l2, l3] = joints.struts;
            [l1, l2, l3, joints.a, joints.c, solved.rotation, f64::from(solved.pose.iterations)]
        })?;
        let all = PyDict::new(py);
        all.set_item("struts", rows::<7, 3>(py, &solved, 0)?)?;
        for (at, name) in [(3, "a"), (4, "c"), (5, "drm"), (6, "iterations")] {
            all.set_item(name, PyArray1::from_iter(py, solved.iter().map(|row| row[at])))?;
        }
        Ok(all)
    }

    /// The dependent rotation of poses, (n,), rad; arguments as of `ik`.
    #[pyo3(signature = (points, directions=None, *, frame="machine", tilted="projected", unreachable="raise"))]
    fn drm<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        directions: Option<&Bound<'py, PyAny>>,
        frame: &str,
        tilted: &str,
        unreachable: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let solved = self.poses(py, points, directions, frame, tilted, unreachable, |solved| [solved.rotation])?;
        Ok(PyArray1::from_iter(py, solved.iter().map(|[rotation]| *rotation)))
    }

    /// Tool points and directions of struts (n, 3), mm, and axes (n,), rad. Gives `points` (n, 3) in mm, `directions` (n, 3), `drm`
    /// (n,) in rad.
    #[pyo3(signature = (struts, a, c, *, frame="machine", tilted="projected", unreachable="raise"))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn fk<'py>(
        &self,
        py: Python<'py>,
        struts: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
        c: &Bound<'py, PyAny>,
        frame: &str,
        tilted: &str,
        unreachable: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let struts = triples("struts", struts)?;
        let (struts, rows_of) =
            (struts.as_slice()?.as_chunks::<3>().0, |name, value| each(name, value, struts.as_array().nrows()));
        let (a, c) = (rows_of("a", a)?, rows_of("c", c)?);
        let (a, c) = (a.as_slice()?, c.as_slice()?);
        let path = Path::new(&self.machine, word("frame", frame, FRAMES)?, word("tilted", tilted, TILTED)?);
        let unreachable = word("unreachable", unreachable, UNREACHABLE)?;
        let solved = py.detach(|| {
            let joints = struts.iter().zip(a.iter().zip(c)).map(|(&struts, (&a, &c))| Joints { struts, a, c });
            collected(unreachable, joints.map(|joints| path.forward(&joints)), |solved| {
                let ([x, y, z], [i, j, k]) = (solved.point, solved.direction);
                [x, y, z, i, j, k, solved.rotation]
            })
        })?;
        let all = PyDict::new(py);
        all.set_item("points", rows::<7, 3>(py, &solved, 0)?)?;
        all.set_item("directions", rows::<7, 3>(py, &solved, 3)?)?;
        all.set_item("drm", PyArray1::from_iter(py, solved.iter().map(|row| row[6])))?;
        Ok(all)
    }
}

impl Exechon {
    #[expect(clippy::too_many_arguments, reason = "those of its callers")]
    fn poses<'py, const N: usize>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        directions: Option<&Bound<'py, PyAny>>,
        frame: &str,
        tilted: &str,
        unreachable: &str,
        of: impl Fn(&SolvedPose) -> [f64; N] + Send + Sync,
    ) -> PyResult<Vec<[f64; N]>> {
        let points = triples("points", points)?;
        let points = points.as_slice()?.as_chunks::<3>().0;
        let directions = directions.map(|directions| triples("directions", directions)).transpose()?;
        let directions = directions.as_ref().map(|directions| directions.as_slice()).transpose()?;
        let directions = directions.map(|directions| directions.as_chunks::<3>().0);
        if let Some(directions) = directions.filter(|directions| directions.len() != points.len()) {
            let told = format!("{} directions for {} points\n  expected one for each", directions.len(), points.len());
            return Err(Class::Data.error(told));
        }
        let mut path = Path::new(&self.machine, word("frame", frame, FRAMES)?, word("tilted", tilted, TILTED)?);
        let along = match path.coordinates() {
            Coordinates::Machine => ALONG,
            Coordinates::Base => self.machine.frame().direction_to_base(ALONG),
        };
        let unreachable = word("unreachable", unreachable, UNREACHABLE)?;
        py.detach(|| {
            let direction = |at: usize| directions.map_or(along, |directions| directions[at]);
            let solved = points.iter().enumerate().map(|(at, &point)| path.inverse(point, direction(at)));
            collected(unreachable, solved, of)
        })
    }
}

fn collected<const N: usize>(
    unreachable: Unreachable,
    solved: impl ExactSizeIterator<Item = Result<SolvedPose, PointError>>,
    of: impl Fn(&SolvedPose) -> [f64; N],
) -> PyResult<Vec<[f64; N]>> {
    let mut all = Vec::with_capacity(solved.len());
    for (row, solved) in solved.enumerate() {
        match solved {
            Ok(solved) => all.push(of(&solved)),
            // What is no pose at all is a mistake, not a place out of reach.
            Err(PointError::Kinematics(_) | PointError::Rotation(_)) if unreachable == Unreachable::Nan => {
                all.push([f64::NAN; N]);
            }
            Err(error) => return Err(errors::pose(&error, row)),
        }
    }
    Ok(all)
}

/// `W` numbers of each row from one on.
fn rows<'py, const N: usize, const W: usize>(
    py: Python<'py>,
    all: &[[f64; N]],
    from: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_iter(py, all.iter().flat_map(|row| row.iter().skip(from).take(W).copied()));
    Ok(flat.reshape([all.len(), W])?.into_any())
}

fn triples<'py>(what: &str, value: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray2<'py, f64>> {
    let array = numbers("poses", what, value)?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    match shape.as_slice() {
        [_, 3] => Ok(array.extract()?),
        _ => Err(Class::Data.error(format!("{what} have the shape {shape:?}\n  expected (n, 3)"))),
    }
}

fn each<'py>(what: &str, value: &Bound<'py, PyAny>, rows: usize) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let array = numbers("poses", what, value)?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    match shape.as_slice() {
        [n] if *n == rows => Ok(array.extract()?),
        _ => Err(Class::Data.error(format!("{what} has the shape {shape:?}\n  expected ({rows},), one for each pose"))),
    }
}
