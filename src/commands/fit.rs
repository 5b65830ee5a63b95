//! `trunnion fit`: errors and their uncertainty from measurement files.

use super::model::ModelArguments;
use super::output::{print, say};
use super::pair::pair;
use super::reported::{ReportArguments, read};
use super::stated::{InstrumentArguments, LimitArguments};
use super::{Refused, document};
use clap::{ArgGroup, Args, ValueEnum};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trunnion::data::{ObservationsError, Recorded, RunFiles, Stamp, curve_files};
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
    /// made in.
    ///
    /// Three displacements may be in one file with the columns dx, dy, dz: `low=FILE` for the runs low-x, low-y, low-z.
    #[arg(long = "run", value_name = "NAME=FILE", required = true)]
    runs: Vec<String>,
    /// The known functions over the swept angle; without it they are taken as zero.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// How the runs are combined.
    #[arg(long, value_enum, default_value_t = Combine::Joint)]
    estimator: Combine,
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
        let given = self.files()?;
        let setup = self.model.setup(|model| made(model, &given))?;
        let files = RunFiles::new(&setup, &given)?;
        let weights = self.weights()?;
        let (limits, instrument) = (self.limits.limits(&setup), self.instrument.instrument(&setup.model)?);
        let mut recorded = files.open(&setup, self.table.as_deref())?;
        weigh(&setup, &mut recorded, &weights).map_err(|e| Refused::weight(&e, &self.weights))?;
        let file = |run: &str| {
            let files = |run| files.files(run).map(|file| file.display().to_string()).collect::<Vec<_>>();
            setup.run(run).map_or_else(|| run.to_owned(), |run| files(run).join(", "))
        };
        let robust = self.robust == Some(Robust::Huber);
        let how = How { estimator: self.estimator.into(), robust, ..How::default() };
        let fitted = fit_recorded(&setup, &recorded, how);
        let (fitted, observations) = fitted.map_err(|failed| match failed {
            Failed::Estimate(e) => Refused::from(e.rename(file)),
            Failed::Recording(e) => ObservationsError::from(e).into(),
        })?;
        let report = report_on(&setup, &observations, &fitted, limits, &instrument, self.table.is_none())?;
        for warning in &report.warnings {
            say(format_args!("warning: {warning}"));
        }
        let named = given.iter().map(|(_, file)| PathBuf::from(file)).chain(self.table.clone());
        let guard = self.report.guard(self.model.inputs().into_iter().chain(named));
        let mut out = if self.json { String::new() } else { report.to_string() };
        let mut html = None;
        if self.json || self.report.is_wanted() {
            let mut document = document::report(&setup, &report);
            document["instrument"]["name"] = self.instrument.name(&setup.model).into();
            document["made"] = self.report.made(&self.read(&setup, &recorded)?);
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

    /// The files that were read, each once.
    fn read(&self, setup: &Setup, recorded: &[Recorded]) -> Result<Vec<Value>, ObservationsError> {
        let mut files = vec![self.model.read()];
        let mut runs: Vec<(&Path, String, &Recorded)> = Vec::new();
        for own in recorded {
            let run = &setup.model.runs[own.run()].name;
            match runs.iter_mut().find(|(file, ..)| *file == own.file()) {
                Some((_, names, _)) => *names = format!("{names}, {run}"),
                None => runs.push((own.file(), format!("run {run}"), own)),
            }
        }
        for (file, role, own) in runs {
            files.push(read(&role, &file.display().to_string(), Some(own.stamp()?)));
        }
        let table = self.table.iter();
        files.extend(table.map(|file| read("known functions", &file.display().to_string(), Stamp::of_file(file))));
        Ok(files)
    }

    fn files(&self) -> Result<Vec<(&str, &str)>, Refused> {
        let split = |given| pair(given).filter(|(_, file)| !file.is_empty());
        let not = |given: &String| Refused::NotAPair {
            option: "run",
            pair: "NAME=FILE",
            given: given.clone(),
            range: "",
            example: "tilting=run1.csv",
        };
        self.runs.iter().map(|given| split(given).ok_or_else(|| not(given))).collect()
    }

    fn weights(&self) -> Result<Vec<(&str, f64)>, Refused> {
        let split = |given| pair(given).and_then(|(name, weight)| Some((name, weight.parse().ok()?)));
        self.weights.iter().map(|given| split(given).ok_or_else(|| Refused::Weight(given.clone()))).collect()
    }
}

/// Keeps the runs that were made; with a name that no run has, all, which is told where the files are read.
fn made(model: &mut Model, given: &[(&str, &str)]) -> Result<(), Refused> {
    let is = |run: &str, name: &str| {
        run == name || run.strip_suffix(['x', 'y', 'z']).is_some_and(|r| r.strip_suffix('-') == Some(name))
    };
    let of = |name: &str| model.runs.iter().any(|run| is(&run.name, name));
    if !given.iter().all(|(name, _)| of(name)) {
        return Ok(());
    }
    let made = |run: &str| given.iter().any(|(name, _)| is(run, name));
    let (kept, left): (Vec<RunId>, Vec<RunId>) = model.runs.keys().partition(|run| made(&model.runs[*run].name));
    if left.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = left.iter().map(|run| model.runs[*run].name.as_str()).collect();
    say(format_args!("note: fitted without {}, which no file is given for", names.join(", ")));
    *model = subset(model, &kept).map_err(|e| SetupError::derivation(model, &e))?;
    Ok(())
}
