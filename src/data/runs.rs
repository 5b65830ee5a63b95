//! From the files of a measurement to what is fitted.

use super::error::FileError;
use super::limits::SAMPLES;
use super::sweep::{RunColumns, Sweep};
use super::table::{Known, Table, TableValues};
use crate::study::{Observation, Sample, Setup};
use std::path::{Path, PathBuf};
use thiserror::Error;
use trunnion_codegen::algebra::{Monomial, Poly, Rational, at};
use trunnion_codegen::basis::Coordinate;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::directions;

/// The readings' column of a run with a file of its own, without the unit.
const READING: &str = "dr";
/// The readings' columns of a file with all three displacements.
const CHANNELS: [&str; 3] = ["dx", "dy", "dz"];
/// How the runs of three displacements end.
const ENDINGS: [&str; 3] = ["-x", "-y", "-z"];

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

/// The files of every run of a model: one for each time that it was measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunFiles(Vec<(RunId, Source)>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Source {
    file: PathBuf,
    /// The column of its readings without the unit.
    column: &'static str,
}

impl RunFiles {
    /// Files by the names of their runs; a run that was measured several times, or in both directions, has several. Three
    /// displacements may be in one file with the columns `dx`, `dy`, `dz`: `low` for the runs `low-x`, `low-y`, `low-z`.
    ///
    /// # Errors
    /// [`ObservationsError`] for a run that is unknown or missing.
    pub fn new<P: AsRef<Path>>(setup: &Setup, given: &[(&str, P)]) -> Result<Self, ObservationsError> {
        let mut files = Vec::new();
        for (run, file) in given {
            let channels: Vec<RunId> = ENDINGS.iter().filter_map(|end| setup.run(&format!("{run}{end}"))).collect();
            let runs = match setup.run(run) {
                Some(run) => vec![(run, READING)],
                None if channels.len() == CHANNELS.len() => channels.into_iter().zip(CHANNELS).collect(),
                None => return Err(ObservationsError::unknown_run(setup, run)),
            };
            files
                .extend(runs.into_iter().map(|(run, column)| (run, Source { file: file.as_ref().to_owned(), column })));
        }
        // In the model's order; each run's in the order they were given.
        files.sort_by_key(|(run, _)| *run);
        let missing = setup.model.runs.keys().find(|run| files.iter().all(|(own, _)| own != run));
        match missing {
            Some(run) => Err(ObservationsError::RunMissing(setup.model.runs[run].name.clone())),
            None => Ok(Self(files)),
        }
    }

    /// The files of a run.
    pub fn files(&self, run: RunId) -> impl Iterator<Item = &Path> {
        self.0.iter().filter(move |(own, _)| *own == run).map(|(_, source)| source.file.as_path())
    }

    /// Reads every run, [`SAMPLES`] in all at most, each with weight 1; the known functions are those of the table, or zero without one.
    ///
    /// # Errors
    /// [`ObservationsError`] for a file that cannot be used, or a known function that no table can give.
    pub fn read(&self, setup: &Setup, table: Option<&Path>) -> Result<Vec<Observation>, ObservationsError> {
        let table = table.map(|file| KnownTable::read(setup, file)).transpose()?;
        let mut read: Vec<Observation> = Vec::with_capacity(self.0.len());
        for (run, source) in &self.0 {
            let before: usize = read.iter().map(|observation| observation.samples.len()).sum();
            read.push(observation(setup, *run, source, SAMPLES - before, table.as_ref())?);
        }
        Ok(read)
    }
}

/// Reads the runs of a model, each with weight 1, from files by their runs' names; the known functions are those of the
/// table, or zero without one.
///
/// # Errors
/// [`ObservationsError`]
pub fn observations<P: AsRef<Path>>(
    setup: &Setup,
    files: &[(&str, P)],
    table: Option<&Path>,
) -> Result<Vec<Observation>, ObservationsError> {
    RunFiles::new(setup, files)?.read(setup, table)
}

fn observation(
    setup: &Setup,
    run: RunId,
    source: &Source,
    most: usize,
    table: Option<&KnownTable>,
) -> Result<Observation, ObservationsError> {
    let (described, derived) = (&setup.model.runs[run], &setup.derivation.runs[run]);
    let others: Vec<&str> = match source.column {
        READING => Vec::new(),
        own => CHANNELS.into_iter().filter(|column| *column != own).collect(),
    };
    let expected = RunColumns {
        angle: setup.model.alphabet.sweep_name(described.sweep),
        reading: source.column,
        others: &others,
        bar_mm: setup.bar(run),
        least: derived.regressors.len() + 1,
        most,
    };
    let sweep = Sweep::read_as(&source.file, &expected)?;
    let known = match table.filter(|_| !derived.known.is_empty()) {
        Some(table) => table.at_samples(setup, run, &sweep)?,
        None => {
            let zero = vec![0.0; derived.known.len()];
            vec![TableValues { values: zero.clone(), stds: zero }; sweep.samples().len()]
        }
    };
    let sweeps: Vec<f64> = sweep.samples().iter().map(|s| s.angle_rad).collect();
    let samples = sweep.samples().iter().zip(directions(&sweeps)).zip(known);
    let samples = samples
        .map(|((s, direction), TableValues { values, stds })| Sample {
            sweep: s.angle_rad,
            direction,
            reading: s.reading_mm,
            known: values,
            known_std: stds,
        })
        .collect();
    Ok(Observation { run, weight: 1.0, samples })
}

/// The known functions that the runs see, and what their table calls the swept angle: as the first run that sees one does.
pub(super) fn known_functions(setup: &Setup) -> Option<(&str, Vec<FunctionId>)> {
    let sees = setup.derivation.runs.iter_enumerated().find(|(_, run)| !run.known.is_empty());
    let angle = setup.model.alphabet.sweep_name(setup.model.runs[sees?.0].sweep);
    Some((angle, setup.known(setup.derivation.runs.keys())))
}

/// The coordinate of an axis that stands, rad or mm.
fn fixed(setup: &Setup, coordinate: &Coordinate) -> Option<f64> {
    let poly = coordinate.poly()?;
    let alphabet = &setup.model.alphabet;
    let moves = |(m, _): &(Monomial, Rational)| {
        alphabet.nominals().any(|(id, _)| m.exponent(id) != 0 && !alphabet.is_constant(id))
    };
    (!poly.terms().iter().any(moves)).then(|| at(poly, alphabet, 0.0, |name| setup.constant(name)))
}

/// The table of all known functions that the runs see.
struct KnownTable {
    table: Table,
    functions: Vec<FunctionId>,
}

impl KnownTable {
    fn read(setup: &Setup, file: &Path) -> Result<Self, ObservationsError> {
        let (angle, functions) = known_functions(setup).unwrap_or(("a", Vec::new()));
        for (run, &f) in setup.model.runs.iter().flat_map(|r| functions.iter().map(move |f| (r, f))) {
            let Some((axis, _)) = setup.model.axis_of(setup.model.functions[f].error) else { continue };
            let own = setup.model.alphabet.sweep_symbols(run.sweep)[0];
            let is_sweep = |c: &Coordinate| c.poly().is_none_or(|p| *p == Poly::nominal(own));
            if !is_sweep(&run.at[axis]) && fixed(setup, &run.at[axis]).is_none() {
                let axis = setup.model.axis(axis).map_or_else(String::new, |axis| axis.name.clone());
                return Err(ObservationsError::TableCoordinate { function: known_name(&setup.model, f), axis });
            }
        }
        let known = |&f: &FunctionId| Known { name: known_name(&setup.model, f), quantity: setup.quantity(f) };
        let table = Table::read(file, angle, &functions.iter().map(known).collect::<Vec<_>>())?;
        Ok(Self { table, functions })
    }

    /// At each sample of a run the values of these functions, mm or rad.
    fn at_samples(&self, setup: &Setup, run: RunId, sweep: &Sweep) -> Result<Vec<TableValues>, FileError> {
        let functions = setup.derivation.runs[run].known.iter();
        // An axis that stands has the table's value where it stands.
        let place = |f: &FunctionId| {
            let (axis, _) = setup.model.axis_of(setup.model.functions[*f].error)?;
            let standing = fixed(setup, &setup.model.runs[run].at[axis]);
            Some((self.functions.iter().position(|own| own == f)?, standing.and_then(|x| self.table.at(x))))
        };
        let places: Vec<(usize, Option<TableValues>)> = functions.filter_map(|(f, _)| place(f)).collect();
        let all = self.table.at_samples(sweep)?.samples;
        let own = |moving: &TableValues, of: fn(&TableValues) -> &[f64]| {
            let one = |(at, standing): &(usize, Option<TableValues>)| {
                of(standing.as_ref().unwrap_or(moving)).get(*at).copied()
            };
            places.iter().filter_map(one).collect()
        };
        Ok(all.iter().map(|t| TableValues { values: own(t, |t| &t.values), stds: own(t, |t| &t.stds) }).collect())
    }
}
