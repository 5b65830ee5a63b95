//! The MODEL argument and the lengths of its set-up.

use super::Refused;
use super::number;
use super::pair::pair;
use super::reported::read;
use clap::Args;
use serde_json::Value;
use std::io::IsTerminal;
use std::path::Path;
use trunnion::data::{PROJECT, Radius, Source, Stamp};
use trunnion::study::{Setup, bars};
use trunnion_codegen::catalogue;
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::{Colour, Named};

/// What is said of a source's texts as files that were read.
pub fn texts(source: &Source) -> Vec<Value> {
    let Named { name, text } = &source.described.model;
    let model = match catalogue::source(name) {
        Some(_) => read("model, built in", name, Stamp::of(text.as_bytes()).ok()),
        None => read("model", name, Stamp::of_file(Path::new(name))),
    };
    let project = source.described.stated.as_ref();
    let project = project.map(|own| read("project", &own.name, Stamp::of_file(Path::new(&own.name))));
    [model].into_iter().chain(project).collect()
}

/// The model of a source.
pub fn described(source: &Source) -> Result<Model, Refused> {
    let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let colour = if std::io::stderr().is_terminal() && !plain { Colour::On } else { Colour::Off };
    let derived = source.described.derive();
    Ok(derived.map_err(|problems| Refused::Model(source.described.render(&problems, colour)))?.0)
}

/// A model by its catalogue name or from a file, a project by its file or folder; the project of this folder without a name.
pub fn source(name: Option<&str>) -> Result<Source, Refused> {
    let here = Path::new(PROJECT);
    Ok(match name {
        Some(name) => Source::named(name)?,
        None if here.exists() => Source::of_project(here)?,
        None => return Err(Refused::NoModel),
    })
}

/// A model and the lengths of its set-up.
#[derive(Debug, Args)]
pub struct ModelArguments {
    /// A name from the catalogue, a model file, or a project; without it the project of this folder, trunnion.toml.
    pub model: Option<String>,
    /// Nominal length of the ball-bar, mm; without it the model file's usual one.
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = millimetres)]
    pub radius: Option<f64>,
    /// Another length of the set-up, mm, where it is not the model file's usual one.
    #[arg(long = "set", value_name = "NAME=MM")]
    pub lengths: Vec<String>,
}

impl ModelArguments {
    /// What describes the model.
    pub fn source(&self) -> Result<Source, Refused> {
        source(self.model.as_deref())
    }

    /// The described model with its lengths, after a change.
    pub fn setup(
        &self,
        source: &Source,
        change: impl FnOnce(&mut Model) -> Result<(), Refused>,
    ) -> Result<Setup, Refused> {
        let radius = self.radius.map(Radius::new).transpose()?;
        let mut model = described(source)?;
        change(&mut model)?;
        setup(model, radius, &self.lengths)
    }
}

/// A model with the length of its bar and those of `--set`.
pub fn setup(model: Model, radius: Option<Radius>, given: &[String]) -> Result<Setup, Refused> {
    let values = lengths(&model, radius, given)?;
    let values: Vec<(&str, f64)> = values.iter().map(|(name, mm)| (name.as_str(), *mm)).collect();
    Ok(Setup::new(model, &values)?)
}

/// Every length that is given: the bar's, and those of `--set`.
pub fn lengths(model: &Model, radius: Option<Radius>, given: &[String]) -> Result<Vec<(String, f64)>, Refused> {
    let bars = radius.into_iter().flat_map(|radius| bars(model).into_iter().map(move |bar| (bar, radius.mm())));
    Ok(others(model, given)?.into_iter().chain(bars).collect())
}

/// The lengths of `--set`, none of them a bar's.
pub fn others(model: &Model, given: &[String]) -> Result<Vec<(String, f64)>, Refused> {
    let bars = bars(model);
    let mut values: Vec<(String, f64)> = Vec::new();
    for given in given {
        let split = pair(given).and_then(|(name, mm)| Some((name, number::position(mm).ok()?)));
        let not = || Refused::NotAPair {
            option: "set",
            pair: "NAME=MM",
            given: given.clone(),
            range: " from -100000 to 100000",
            example: "H=80",
        };
        let (name, mm) = split.ok_or_else(not)?;
        if bars.iter().any(|bar| bar == name) {
            return Err(Refused::SetBar(given.clone()));
        }
        if values.iter().any(|(n, _)| n == name) {
            return Err(Refused::LengthTwice(given.clone()));
        }
        values.push((name.to_owned(), mm));
    }
    Ok(values)
}

/// The nominal length of the bar, mm; which lengths it may have is told where it is used.
pub fn millimetres(text: &str) -> Result<f64, &'static str> {
    text.trim().parse().map_err(|_| "not a number\n  expected the nominal length of the bar in mm, e.g. 150")
}
