//! From the files of a measurement to what is fitted.

use super::called::Columns;
use super::error::{FileError, FileProblem, Need};
use super::imported::instrument_file;
use super::known::{KnownAlong, KnownTable};
use super::limits::SAMPLES;
use super::recorded::Recorded;
use super::refused::ObservationsError;
use super::sweep::{READING, RunColumns};
use crate::study::{Observation, Recording, Setup};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use trunnion_codegen::ids::RunId;

/// The readings' columns of a file with all three displacements.
const CHANNELS: [&str; 3] = ["dx", "dy", "dz"];
/// Those beside each of them.
const OTHERS: [&[&str]; 3] = [&["dy", "dz"], &["dx", "dz"], &["dx", "dy"]];
/// The files of every run of a model: one for each time that it was measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunFiles {
    sources: Vec<(RunId, Source)>,
    columns: Columns,
}

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
        let (mut files, measurements) = (Vec::new(), setup.measurements());
        for (run, file) in given {
            let displaced = measurements.iter().find(|m| m.name == *run && m.is_displacement());
            let runs = match (setup.run(run), displaced) {
                (Some(run), _) => vec![(run, READING)],
                (None, Some(all)) => all.runs.iter().copied().zip(CHANNELS).collect(),
                (None, None) => return Err(ObservationsError::unknown_run(setup, run)),
            };
            files
                .extend(runs.into_iter().map(|(run, column)| (run, Source { file: file.as_ref().to_owned(), column })));
        }
        // In the model's order; each run's in the order they were given.
        files.sort_by_key(|(run, _)| *run);
        let missing = setup.model.runs.keys().find(|run| files.iter().all(|(own, _)| own != run));
        match missing {
            Some(run) => Err(ObservationsError::RunMissing(setup.model.runs[run].name.clone())),
            None => Ok(Self { sources: files, columns: Columns::default() }),
        }
    }

    /// The same files, whose columns have other names.
    ///
    /// # Errors
    /// [`ObservationsError`] for a column that no run has.
    pub fn under(self, setup: &Setup, columns: Columns) -> Result<Self, ObservationsError> {
        let sweeps = setup.model.runs.iter().map(|run| setup.model.alphabet.sweep_name(run.sweep));
        let readings = self.sources.iter().map(|(_, source)| source.column);
        let mut known: Vec<&str> = sweeps.chain(readings).collect();
        known.sort_unstable();
        known.dedup();
        let unknown = columns.names().find(|name| !known.contains(name)).map(str::to_owned);
        match unknown {
            Some(column) => {
                let columns = known.into_iter().map(str::to_owned).collect();
                Err(ObservationsError::UnknownColumn { column, columns })
            }
            None => Ok(Self { columns, ..self }),
        }
    }

    /// The files of a run.
    pub fn files(&self, run: RunId) -> impl Iterator<Item = &Path> {
        self.sources.iter().filter(move |(own, _)| *own == run).map(|(_, source)| source.file.as_path())
    }

    /// Goes through every run once, each with weight 1; the known functions are those of the table, or zero without one. An
    /// instrument's file that holds several runs is as many recordings.
    ///
    /// # Errors
    /// [`ObservationsError`] for a file that cannot be used, or a known function that no table can give.
    pub fn open<'a>(&'a self, setup: &'a Setup, table: Option<&Path>) -> Result<Vec<Recorded<'a>>, ObservationsError> {
        let table = table.map(|file| KnownTable::read(setup, file)).transpose()?.map(Rc::new);
        let mut all = Vec::new();
        for (run, source) in &self.sources {
            all.append(&mut self.recorded(setup, *run, source, table.as_ref())?);
        }
        Ok(all)
    }

    /// A run's file, gone through once.
    fn recorded<'a>(
        &'a self,
        setup: &'a Setup,
        run: RunId,
        source: &Source,
        table: Option<&Rc<KnownTable>>,
    ) -> Result<Vec<Recorded<'a>>, FileError> {
        let (described, derived) = (&setup.model.runs[run], &setup.derivation.runs[run]);
        let together = setup.measured_with(run);
        let columns = RunColumns {
            angle: Some(setup.model.alphabet.sweep_name(described.sweep)),
            reading: source.column,
            others: match CHANNELS.iter().position(|column| *column == source.column) {
                Some(own) => OTHERS[own],
                None => &[],
            },
            names: &self.columns,
            bar_mm: setup.bar(run),
            least: setup.least(&together),
        };
        let table = table.filter(|_| !derived.known.is_empty());
        let known = || table.map_or_else(KnownAlong::default, |table| table.along(setup, run));
        let Some((imported, stamp)) = instrument_file(&source.file)? else {
            return Ok(vec![Recorded::open(setup, run, &source.file, columns, known())?]);
        };
        let about = &imported.about;
        let recorded = |trace| Recorded::imported(setup, run, (&source.file, about, trace), &stamp, columns, known());
        imported.traces.into_iter().map(recorded).collect()
    }

    /// Reads every run into memory, [`SAMPLES`] in all at most.
    ///
    /// # Errors
    /// As [`RunFiles::open`].
    pub fn read(&self, setup: &Setup, table: Option<&Path>) -> Result<Vec<Observation>, ObservationsError> {
        let recorded = self.open(setup, table)?;
        if recorded.iter().map(Recorded::samples).sum::<usize>() > SAMPLES {
            let problem = FileProblem::TooMany { most: SAMPLES, of: Need::Coefficients };
            let file = self.sources.last().map_or_else(PathBuf::new, |(_, source)| source.file.clone());
            return Err(FileError { file, problem }.into());
        }
        let read = |recorded: &Recorded| {
            let mut samples = Vec::with_capacity(recorded.samples());
            recorded.each(&mut |sample| samples.push(sample.clone()))?;
            Ok(Observation { run: recorded.run(), weight: recorded.weight(), samples })
        };
        recorded.iter().map(read).collect()
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
