//! `trunnion fit`: errors and their uncertainty from measurement files.

use super::model::{ModelArguments, Source};
use super::output::{print, say};
use super::pair::pair;
use super::reported::{ReportArguments, read};
use super::stated::{InstrumentArguments, LimitArguments};
use super::{Refused, seen};
use clap::{ArgGroup, Args, ValueEnum};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trunnion::data::{Columns, ObservationsError, Project, Recorded, RunFiles, Stamp, curve_files};
use trunnion::document;
use trunnion::report as page;
use trunnion::study::plan::subset;
use trunnion::study::{
    Estimator, Failed, How, Recording, Setup, SetupError, StudyError, fit_recorded, report_on, weigh,
};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::Model;

/// Arguments of `fit`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("written").args(["report", "csv"]).multiple(true))]
pub struct FitArguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Measurements of a run; once for each run that was made, and again for each time that it was made or direction that it was
    /// made in; without it those of the project.
    ///
    /// A table (CSV), or an instrument's file that needs nothing stated (.b5r; else `trunnion import` it).
    /// Three displacements may be in one file with the columns dx, dy, dz: `low=FILE` for the runs low-x, low-y, low-z.
    #[arg(long = "run", value_name = "NAME=FILE")]
    runs: Vec<String>,
    /// What columns of these files are called where they have other names: a="Angle [deg]",dr="Radius [µm]"; or, with the unit
    /// stated, dr_um="Radius".
    #[arg(long, value_name = "NAME=TEXT,…")]
    columns: Option<Columns>,
    /// The known functions over the swept angle; without it the project's, else they are taken as zero.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// How the runs are combined; without it as the project says, else joint.
    #[arg(long, value_enum)]
    estimator: Option<Combine>,
    /// Weigh readings down that are far off the others (those beyond 1.345 robust standard deviations, by Huber's weights).
    #[arg(long, value_enum, value_name = "HOW")]
    robust: Option<Robust>,
    /// Weight of a run's samples: one over the variance of its readings, up to a common factor (between runs fitted in one
    /// step: the two steps of two-step do not weigh each other).
    #[arg(long = "weight", value_name = "NAME=W")]
    weights: Vec<String>,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    instrument: InstrumentArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Writes each estimated function into this directory: a CSV file with its uncertainty.
    #[arg(long, value_name = "DIR")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArguments,
}

/// An estimator's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Combine {
    /// All runs at once.
    Joint,
    /// The runs without an estimated function first, the paper's way.
    TwoStep,
}

/// A robust estimator's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Robust {
    /// Huber's.
    Huber,
}

impl From<Combine> for Estimator {
    fn from(c: Combine) -> Self {
        match c {
            Combine::Joint => Self::Joint,
            Combine::TwoStep => Self::TwoStep,
        }
    }
}

impl FitArguments {
    /// Reads, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        let source = self.model.source()?;
        // What is asked for by name stands alone.
        let project = source.project.as_ref().filter(|_| self.runs.is_empty());
        let given = self.files(project)?;
        let setup = self.model.setup(&source, |model| made(model, &given))?;
        let columns = self.columns.clone().or(project.map(|project| project.columns.clone())).unwrap_or_default();
        let files = RunFiles::new(&setup, &given)?.under(&setup, columns)?;
        let weights = self.weights(&setup.model, project)?;
        let (limits, instrument) = (self.limits.limits(&setup), self.instrument.instrument(&setup.model)?);
        let project = source.project.as_ref();
        let table = self.table.as_deref().or(project.and_then(|project| project.table.as_deref()));
        let mut recorded = files.open(&setup, table).map_err(|refused| match refused {
            // A table of known functions has the names of its model.
            ObservationsError::File(error) if table.is_none_or(|table| *table != error.file) => Refused::Run(error),
            other => other.into(),
        })?;
        for (file, trace) in recorded.iter().filter_map(Recorded::trace) {
            let told: Vec<String> = trace.told().into_iter().map(|(what, words)| format!("{what}: {words}")).collect();
            say(format_args!("note: {}: {}", seen(&file.display().to_string()), told.join("; ")));
        }
        weigh(&setup, &mut recorded, &weights).map_err(|e| Refused::weight(&e, &self.weights))?;
        let file = |run: &str| {
            let files = |run| files.files(run).map(|file| file.display().to_string()).collect::<Vec<_>>();
            setup.run(run).map_or_else(|| run.to_owned(), |run| files(run).join(", "))
        };
        let robust = self.robust == Some(Robust::Huber) || project.is_some_and(|project| project.robust);
        let estimator = self.estimator.map(Estimator::from).or(project.and_then(|project| project.estimator));
        let how = How { estimator: estimator.unwrap_or(Estimator::Joint), robust, ..How::default() };
        let fitted = fit_recorded(&setup, &recorded, how);
        let (fitted, observations) = fitted.map_err(|failed| match failed {
            Failed::Estimate(e) => Refused::from(e.rename(file)),
            Failed::Recording(e) => ObservationsError::from(e).into(),
        })?;
        let report = report_on(&setup, &observations, &fitted, limits, &instrument, table.is_none())?;
        for warning in &report.warnings {
            say(format_args!("warning: {warning}"));
        }
        let named = given.iter().map(|(_, file)| PathBuf::from(file)).chain(table.map(Path::to_owned));
        let guard = self.report.guard(source.inputs().into_iter().chain(named));
        let mut out = if self.json { String::new() } else { report.to_string() };
        let mut html = None;
        if self.json || self.report.is_wanted() {
            let mut document = document::report(&setup, &report);
            document["instrument"]["name"] = self.instrument.name(&setup.model).into();
            if let Some(project) = project {
                document::at_hand(&mut document, &project.machine);
            }
            document["made"] = self.report.made(&files_read(&source, &setup, &recorded, table));
            html = self.report.is_wanted().then(|| page::fit(&document, &setup, &report)).transpose()?;
            if self.json {
                out = format!("{document:#}\n");
            }
        }
        if let Some(directory) = &self.csv {
            let files = curve_files(&report, directory)?;
            if files.iter().next().is_none() {
                return Err(StudyError::NothingEstimated.into());
            }
            files.write(directory, &guard)?;
        }
        self.report.write(&guard, html)?;
        Ok(print(&out)?)
    }

    /// The runs' files: those given, else the project's.
    fn files<'a>(&'a self, project: Option<&'a Project>) -> Result<Vec<(&'a str, &'a Path)>, Refused> {
        let split = |given| pair(given).filter(|(_, file)| !file.is_empty());
        let not = |given: &String| Refused::NotAPair {
            option: "run",
            pair: "NAME=FILE",
            given: given.clone(),
            range: "",
            example: "tilting=run1.csv",
        };
        let given = self.runs.iter().map(|given| match split(given) {
            Some((name, file)) => Ok((name, Path::new(file))),
            None => Err(not(given)),
        });
        let runs = project.into_iter().flat_map(|project| &project.runs);
        let of_project = runs.flat_map(|run| run.files.iter().map(|file| Ok((run.name.as_str(), file.as_path()))));
        let files: Vec<_> = given.chain(of_project).collect::<Result<_, _>>()?;
        if files.is_empty() { Err(Refused::NoRuns) } else { Ok(files) }
    }

    /// The weights given, and the project's of other runs.
    fn weights<'a>(&'a self, model: &'a Model, project: Option<&'a Project>) -> Result<Vec<(&'a str, f64)>, Refused> {
        let split = |given| pair(given).and_then(|(name, weight)| Some((name, weight.parse().ok()?)));
        let given = self.weights.iter().map(|given| split(given).ok_or_else(|| Refused::Weight(given.clone())));
        let given: Vec<(&str, f64)> = given.collect::<Result<_, _>>()?;
        let of_project = project.into_iter().flat_map(|project| &project.runs).flat_map(|own| {
            let runs = model.runs.iter().filter(|run| is_of(&run.name, &own.name));
            runs.filter_map(|run| Some((run.name.as_str(), own.weight?)))
        });
        let others: Vec<_> = of_project.filter(|(run, _)| given.iter().all(|(name, _)| name != run)).collect();
        Ok([given, others].concat())
    }
}

/// The files that were read, each once.
fn files_read(source: &Source, setup: &Setup, recorded: &[Recorded], table: Option<&Path>) -> Vec<Value> {
    let mut runs: Vec<(&Path, Vec<&str>)> = Vec::new();
    for own in recorded {
        let run = setup.model.runs[own.run()].name.as_str();
        match runs.iter_mut().find(|(file, _)| *file == own.file()) {
            Some((_, names)) if names.contains(&run) => {}
            Some((_, names)) => names.push(run),
            None => runs.push((own.file(), vec![run])),
        }
    }
    let runs = runs.into_iter().map(|(file, names)| (file, format!("run {}", names.join(", "))));
    let table = table.map(|file| (file, "known functions".to_owned()));
    let named = runs.chain(table);
    let read = named.map(|(file, role)| read(&role, &file.display().to_string(), Stamp::of_file(file)));
    source.read().into_iter().chain(read).collect()
}

/// Whether a run is that of a name, or one of its three displacements.
fn is_of(run: &str, name: &str) -> bool {
    run == name || run.strip_suffix(['x', 'y', 'z']).is_some_and(|r| r.strip_suffix('-') == Some(name))
}

/// Keeps the runs that were made; with a name that no run has, all, which is told where the files are read.
fn made(model: &mut Model, given: &[(&str, &Path)]) -> Result<(), Refused> {
    let of = |name: &str| model.runs.iter().any(|run| is_of(&run.name, name));
    if !given.iter().all(|(name, _)| of(name)) {
        return Ok(());
    }
    let made = |run: &str| given.iter().any(|(name, _)| is_of(run, name));
    let (kept, left): (Vec<RunId>, Vec<RunId>) = model.runs.keys().partition(|run| made(&model.runs[*run].name));
    if left.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = left.iter().map(|run| model.runs[*run].name.as_str()).collect();
    say(format_args!("note: fitted without {}, which no file is given for", names.join(", ")));
    *model = subset(model, &kept).map_err(|e| SetupError::derivation(model, &e))?;
    Ok(())
}
