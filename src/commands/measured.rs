//! What is measured and how it is fitted, for every command that fits: files and options, or the project's.

use super::model::{ModelArguments, texts};
use super::output::say;
use super::pair::pair;
use super::reported::read;
use super::stated::{InstrumentArguments, LimitArguments};
use super::{Refused, seen};
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use trunnion::data::{
    self, Columns, FileError, MachineAtHand, ObservationsError, Project, Recorded, RunFiles, Source, Stamp,
};
use trunnion::study::plan::subset;
use trunnion::study::{
    Estimator, Failed, Fit, How, Instrument, Observation, Recording, Report, Setup, SetupError, Sources, fit_recorded,
    report_on, weigh,
};
use trunnion_codegen::model::Model;

/// Model, runs and how they are fitted.
#[derive(Debug, Args)]
pub struct MeasuredArguments {
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

/// What is to be fitted.
pub struct Measured<'a> {
    arguments: &'a MeasuredArguments,
    source: Source,
    /// The runs' files as they are named.
    given: Vec<(String, PathBuf)>,
    files: RunFiles,
    /// The known functions.
    table: Option<PathBuf>,
    /// The model and the lengths of its set-up.
    pub setup: Setup,
    /// How it is fitted.
    pub how: How,
    instrument: Instrument,
}

impl MeasuredArguments {
    /// The model and the names of the files.
    pub fn measured(&self) -> Result<Measured<'_>, Refused> {
        let source = self.model.source()?;
        // What is asked for by name stands alone.
        let project = source.project.as_ref().filter(|_| self.runs.is_empty());
        let given = self.files(project)?;
        let setup = self.model.setup(&source, |model| made(model, &given))?;
        let columns = self.columns.clone().or(project.map(|project| project.columns.clone())).unwrap_or_default();
        let files = RunFiles::new(&setup, &named(&given))?.under(&setup, columns)?;
        let project = source.project.as_ref();
        let table = self.table.clone().or(project.and_then(|project| project.table.clone()));
        let robust = self.robust == Some(Robust::Huber) || project.is_some_and(|project| project.robust);
        let estimator = self.estimator.map(Estimator::from).or(project.and_then(|project| project.estimator));
        let how = How { estimator: estimator.unwrap_or(Estimator::Joint), robust, ..How::default() };
        let instrument = self.instrument.instrument(&setup.model)?;
        Ok(Measured { arguments: self, source, given, files, table, setup, how, instrument })
    }

    /// The runs' files: those given, else the project's.
    fn files(&self, project: Option<&Project>) -> Result<Vec<(String, PathBuf)>, Refused> {
        let split = |given| pair(given).filter(|(_, file)| !file.is_empty());
        let not = |given: &String| Refused::NotAPair {
            option: "run",
            pair: "NAME=FILE",
            given: given.clone(),
            range: "",
            example: "tilting=run1.csv",
        };
        let given = self.runs.iter().map(|given| match split(given) {
            Some((name, file)) => Ok((name.to_owned(), PathBuf::from(file))),
            None => Err(not(given)),
        });
        let of_project = project.into_iter().flat_map(Project::files);
        let of_project = of_project.map(|(name, file)| Ok((name.to_owned(), file.to_owned())));
        let files: Vec<_> = given.chain(of_project).collect::<Result<_, _>>()?;
        if files.is_empty() { Err(Refused::NoRuns) } else { Ok(files) }
    }

    /// The weights given, and the project's of other runs.
    fn weights<'a>(&'a self, model: &'a Model, project: Option<&'a Project>) -> Result<Vec<(&'a str, f64)>, Refused> {
        let split = |given| pair(given).and_then(|(name, weight)| Some((name, weight.parse().ok()?)));
        let given = self.weights.iter().map(|given| split(given).ok_or_else(|| Refused::Weight(given.clone())));
        let given: Vec<(&str, f64)> = given.collect::<Result<_, _>>()?;
        let of_project = project.into_iter().flat_map(|project| project.weights(model));
        let others: Vec<_> = of_project.filter(|(run, _)| given.iter().all(|(name, _)| name != run)).collect();
        Ok([given, others].concat())
    }
}

impl Measured<'_> {
    /// Goes through the files, and says what of an instrument's file is not taken as it is.
    pub fn open(&self) -> Result<Vec<Recorded<'_>>, Refused> {
        let (setup, table) = (&self.setup, self.table.as_deref());
        let project = self.source.project.as_ref().filter(|_| self.arguments.runs.is_empty());
        let weights = self.arguments.weights(&setup.model, project)?;
        let mut recorded = self.files.open(setup, table).map_err(|refused| match refused {
            // A table of known functions has the names of its model.
            ObservationsError::File(error) if table.is_none_or(|table| *table != error.file) => Refused::Run(error),
            other => other.into(),
        })?;
        for (file, trace) in recorded.iter().filter_map(Recorded::trace) {
            say(format_args!("note: {}: {}", seen(&file.display().to_string()), trace.in_words()));
        }
        weigh(setup, &mut recorded, &weights).map_err(|e| Refused::weight(&e, &self.arguments.weights))?;
        Ok(recorded)
    }

    /// The fit, and the observations that stand for all samples.
    pub fn fit(&self, recorded: &[Recorded]) -> Result<(Fit, Vec<Observation>), Refused> {
        let setup = &self.setup;
        let file = |run: &str| {
            let files = |run| self.files.files(run).map(|file| file.display().to_string()).collect::<Vec<_>>();
            setup.run(run).map_or_else(|| run.to_owned(), |run| files(run).join(", "))
        };
        fit_recorded(setup, recorded, self.how).map_err(|failed| match failed {
            Failed::Estimate(e) => Refused::from(e.rename(file)),
            Failed::Recording(e) => Self::unreadable(e),
        })
    }

    /// A file that could be read before and cannot now.
    pub fn unreadable(error: FileError) -> Refused {
        ObservationsError::from(error).into()
    }

    /// What is said of a fit.
    pub fn report(&self, fit: &Fit, observations: &[Observation]) -> Result<Report, Refused> {
        let limits = self.arguments.limits.limits(&self.setup);
        Ok(report_on(&self.setup, observations, fit, limits, &self.instrument, self.table.is_none())?)
    }

    /// What a fit's uncertainty is made of.
    pub fn sources<'b>(&'b self, fit: &'b Fit, observations: &'b [Observation]) -> Sources<'b> {
        let limits = self.arguments.limits.limits(&self.setup);
        Sources::new(&self.setup, observations, fit, limits, &self.instrument, self.table.is_none())
    }

    /// The name of the instrument whose published errors are taken.
    pub fn instrument(&self) -> Option<String> {
        self.arguments.instrument.name(&self.setup.model)
    }

    /// What the project tells of the machine at hand.
    pub fn machine(&self) -> Option<&MachineAtHand> {
        self.source.project.as_ref().map(|project| &project.machine)
    }

    /// The files that no output may replace.
    pub fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        let named = self.given.iter().map(|(_, file)| file.clone()).chain(self.table.clone());
        self.source.inputs().into_iter().chain(named)
    }

    /// The files that were read, each once.
    pub fn files_read(&self, recorded: &[Recorded]) -> Vec<Value> {
        let mut runs: Vec<(&Recorded, Vec<&str>)> = Vec::new();
        for own in recorded {
            let run = self.setup.model.runs[own.run()].name.as_str();
            match runs.iter_mut().find(|(other, _)| other.file() == own.file()) {
                Some((_, names)) if names.contains(&run) => {}
                Some((_, names)) => names.push(run),
                None => runs.push((own, vec![run])),
            }
        }
        let named = |file: &Path| file.display().to_string();
        let run = |(own, names): (&Recorded, Vec<&str>)| {
            let mut file = read(&format!("run {}", names.join(", ")), &named(own.file()), Some(own.stamp().clone()));
            if !own.about().is_empty() {
                file["says"] =
                    own.about().iter().map(|(name, words)| json!({ "name": name, "words": words })).collect();
            }
            file
        };
        // No run may see a known function.
        let known = |file| recorded.iter().find_map(Recorded::table).cloned().or_else(|| Stamp::of_file(file));
        let table = self.table.as_deref().map(|file| read("known functions", &named(file), known(file)));
        texts(&self.source).into_iter().chain(runs.into_iter().map(run)).chain(table).collect()
    }
}

fn named(given: &[(String, PathBuf)]) -> Vec<(&str, &Path)> {
    given.iter().map(|(name, file)| (name.as_str(), file.as_path())).collect()
}

/// Keeps the runs that were made; with a name that no run has, all, which is told where the files are read.
fn made(model: &mut Model, given: &[(String, PathBuf)]) -> Result<(), Refused> {
    let names: Vec<&str> = given.iter().map(|(name, _)| name.as_str()).collect();
    let (kept, left) = data::made(model, &names);
    if left.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = left.iter().map(|run| model.runs[*run].name.as_str()).collect();
    say(format_args!("note: fitted without {}, which no file is given for", names.join(", ")));
    *model = subset(model, &kept).map_err(|e| SetupError::derivation(model, &e))?;
    Ok(())
}
