//! The project file, `trunnion.toml`: a measurement of a machine, with all that a command would otherwise be told by options.
//!
//! What it states of the machine and the instrument (`[lengths]`, `[limits]`, `[instrument]`, `[assume]`, `[axis.A] range`) is put
//! over the model file's own, which reads it ([`Described`](trunnion_codegen::problems::Described)); here is the rest.

use super::called::Columns;
use super::date::iso_date;
use super::made::is_of;
use super::positions::{Positions, Stated, lines};
use crate::study::{Estimator, MOST_WEIGHT};
use serde::de::{Error as _, IgnoredAny};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;
use toml::Spanned;
use trunnion_codegen::model::Model;

/// Its name in a folder.
pub const PROJECT: &str = "trunnion.toml";

/// No length is larger, mm.
const MOST_MM: f64 = 1e5;

/// What a project file says of files, and how they are fitted. Paths are resolved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Project {
    /// A name of the catalogue, or a file.
    pub model: String,
    /// What is told of the machine at hand.
    pub machine: MachineAtHand,
    /// How the runs are combined.
    pub estimator: Option<Estimator>,
    /// Whether readings far off the others are weighed down.
    pub robust: bool,
    /// The known functions.
    pub table: Option<PathBuf>,
    /// What the columns of the runs' files are called where they have other names.
    pub columns: Columns,
    /// Where the runs are probed.
    pub positions: Option<Positions>,
    /// How far the centres of the sphere and of the probe's ball are apart at a touch, mm.
    pub touch_mm: Option<f64>,
    /// The runs that were made, by their names.
    pub runs: Vec<ProjectRun>,
}

/// The machine that was measured, as a report names it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MachineAtHand {
    /// Its name.
    pub name: Option<String>,
    /// Its serial number.
    pub serial: Option<String>,
    /// Who measured.
    pub operator: Option<String>,
    /// When it was measured, a date of ISO 8601.
    #[serde(default, deserialize_with = "dated")]
    pub date: Option<String>,
    /// Anything else.
    pub note: Option<String>,
}

/// A date; an empty text is none.
fn dated<'de, D: Deserializer<'de>>(text: D) -> Result<Option<String>, D::Error> {
    let date = String::deserialize(text)?;
    let no_date = || D::Error::custom(format!("{date:?} is no date such as 2026-04-01 or 2026-04-01T08:00:00"));
    if date.trim().is_empty() { Ok(None) } else { iso_date(&date).ok_or_else(no_date).map(Some) }
}

/// A run that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectRun {
    /// Its name in the model.
    pub name: String,
    /// A file for each time that it was made.
    pub files: Vec<PathBuf>,
    /// The weight of its samples.
    pub weight: Option<f64>,
}

/// What is wrong with a project file, without its name.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProjectError {
    /// Not TOML, or not these keys.
    #[error("line {line}: {message}\n  expected the keys that `trunnion new` writes")]
    Format {
        /// Counted from 1.
        line: usize,
        /// What the reader says.
        message: String,
    },
    /// A weight that no run has.
    #[error("line {line}: weight = {weight:?} is out of range\n  expected a number from 1e-9 to 1e9")]
    Weight {
        /// Counted from 1.
        line: usize,
        /// The weight.
        weight: f64,
    },
    /// A distance that no ball and sphere are at when they touch.
    #[error("line {line}: touch_mm = {mm:?} is out of range\n  expected a length above 0 and up to 100000, mm")]
    Touch {
        /// Counted from 1.
        line: usize,
        /// The distance.
        mm: f64,
    },
    /// A run of no files.
    #[error("line {line}: no file\n  expected files = [\"run.csv\"], or no [run.…] where the run was not made")]
    NoFile {
        /// Counted from 1.
        line: usize,
    },
}

impl MachineAtHand {
    /// Each with its name.
    pub fn told(&self) -> [(&'static str, Option<&str>); 5] {
        let Self { name, serial, operator, date, note } = self;
        [("name", name), ("serial", serial), ("operator", operator), ("date", date), ("note", note)]
            .map(|(key, value)| (key, value.as_deref()))
    }
}

impl ProjectError {
    /// Where, counted from 1.
    pub fn line(&self) -> usize {
        match self {
            Self::Format { line, .. }
            | Self::Weight { line, .. }
            | Self::Touch { line, .. }
            | Self::NoFile { line } => *line,
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    model: String,
    #[serde(default)]
    machine: MachineAtHand,
    #[serde(default)]
    fit: Fit,
    #[serde(default)]
    columns: Columns,
    positions_deg: Option<Stated>,
    #[serde(default)]
    probe: Probe,
    #[serde(default)]
    run: BTreeMap<String, Run>,
    // Read with the model.
    #[serde(rename = "lengths")]
    _lengths: Option<IgnoredAny>,
    #[serde(rename = "limits")]
    _limits: Option<IgnoredAny>,
    #[serde(rename = "instrument")]
    _instrument: Option<IgnoredAny>,
    #[serde(rename = "assume")]
    _assume: Option<IgnoredAny>,
    #[serde(rename = "axis")]
    _axis: Option<IgnoredAny>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fit {
    estimator: Option<Estimator>,
    robust: Option<Robust>,
    table: Option<PathBuf>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Probe {
    touch_mm: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Robust {
    Huber,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Run {
    files: Spanned<Vec<PathBuf>>,
    weight: Option<Spanned<f64>>,
}

impl Project {
    /// Whether a text is a project's: TOML that names its model. A model file names itself.
    pub fn is_one(text: &str) -> bool {
        #[derive(Deserialize)]
        struct Named {
            model: Option<IgnoredAny>,
        }
        toml::from_str::<Named>(text).is_ok_and(|file| file.model.is_some())
    }

    /// Reads a project file's text; `folder` is where it lies.
    ///
    /// # Errors
    /// [`ProjectError`]
    pub fn read(text: &str, folder: &Path) -> Result<Self, ProjectError> {
        let line = lines(text);
        let file: File = toml::from_str(text).map_err(|e| {
            let line = line(e.span().map_or(0, |span| span.start));
            ProjectError::Format { line, message: e.message().lines().collect::<Vec<_>>().join(", ") }
        })?;
        let run = |(name, run): (String, Run)| {
            if run.files.get_ref().is_empty() {
                return Err(ProjectError::NoFile { line: line(run.files.span().start) });
            }
            let weight = run.weight.map(|weight| {
                let (at, weight) = (weight.span().start, weight.into_inner());
                let within = (1.0 / MOST_WEIGHT..=MOST_WEIGHT).contains(&weight);
                if within { Ok(weight) } else { Err(ProjectError::Weight { line: line(at), weight }) }
            });
            let files = run.files.into_inner().into_iter().map(|file| folder.join(file)).collect();
            Ok(ProjectRun { name, files, weight: weight.transpose()? })
        };
        let touch = |given: Spanned<f64>| {
            let (at, mm) = (given.span().start, given.into_inner());
            // NaN is within nothing.
            if mm > 0.0 && mm <= MOST_MM { Ok(mm) } else { Err(ProjectError::Touch { line: line(at), mm }) }
        };
        Ok(Self {
            touch_mm: file.probe.touch_mm.map(touch).transpose()?,
            model: file.model,
            machine: file.machine,
            estimator: file.fit.estimator,
            robust: matches!(file.fit.robust, Some(Robust::Huber)),
            columns: file.columns,
            table: file.fit.table.map(|table| folder.join(table)),
            positions: file.positions_deg.map(|stated| Positions::of(stated, text)),
            runs: file.run.into_iter().map(run).collect::<Result<_, _>>()?,
        })
    }

    /// Each file with the name of its run.
    pub fn files(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.runs.iter().flat_map(|run| run.files.iter().map(|file| (run.name.as_str(), file.as_path())))
    }

    /// The weights of a model's runs, where one is stated.
    pub fn weights<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = (&'a str, f64)> {
        self.runs.iter().flat_map(|own| {
            let runs = model.runs.iter().filter(|run| is_of(&run.name, &own.name));
            runs.filter_map(|run| Some((run.name.as_str(), own.weight?)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Project, ProjectError> {
        Project::read(text, Path::new("a folder"))
    }

    #[test]
    fn a_project_names_its_model_and_its_files() {
        let text = "model = \"m\"\n[columns]\na = \"Angle [deg]\"\n[machine]\nserial = \"7\"\n[fit]\nestimator = \"two-step\"\nrobust = \"huber\"\ntable = \"t.csv\"\n\
            [run.tilting]\nfiles = [\"a.csv\", \"b.csv\"]\nweight = 2\n[axis.A]\nrange = [0, 1]\n[lengths]\nR_mm = 3\n\
            [positions_deg]\na = [1, 2]\n";
        assert!(Project::is_one(text) && !Project::is_one("name = \"m\""));
        let project = read(text).unwrap();
        assert_eq!((project.model.as_str(), project.machine.serial.as_deref()), ("m", Some("7")));
        assert_eq!((project.estimator, project.robust), (Some(Estimator::TwoStep), true));
        let folder = Path::new("a folder");
        assert_eq!(project.table, Some(folder.join("t.csv")));
        assert_eq!(project.columns, "a=Angle [deg]".parse().unwrap());
        assert!(project.positions.is_some());
        let files = ["a.csv", "b.csv"].map(|file| folder.join(file)).to_vec();
        assert_eq!(project.runs, [ProjectRun { name: "tilting".to_owned(), files, weight: Some(2.0) }]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let cases = [
            ("model = \"m\"\n[fitt]\n", "line 2: unknown field `fitt`"),
            ("\n[fit]\n", "missing field `model`"),
            ("model = 3\n", "line 1: invalid type"),
            ("model = \"m\"\n[run.t]\nfiles = []\n", "line 3: no file"),
            ("model = \"m\"\n[run.t]\nfiles = [\"a\"]\nweight = -1\n", "line 4: weight = -1.0"),
            ("model = \"m\"\n[machine]\ndate = \"gestern\"\n", "line 3: \"gestern\" is no date such as 2026-04-01"),
            ("model = \"m\"\n[machine]\ndate = \"01.04.2026\"\n", "line 3: "),
            ("model = \"m\"\n[columns]\na = \"\"\n", "line 2: "),
            ("model = \"m\"\n[positions_deg]\na = [1,\n\"2\"]\n", "line 4: invalid type"),
            ("model = \"m\"\n[fit]\nestimator = \"both\"\n", "line 3: unknown variant"),
        ];
        for (text, told) in cases {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(told), "{text}: {error}");
        }
    }
}
