//! The MODEL argument and the lengths of its set-up.

use super::Refused;
use super::number;
use super::pair::pair;
use super::reported::read;
use clap::Args;
use serde_json::Value;
use std::io::{ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};
use trunnion::data::{Radius, Stamp, TextError, read_text};
use trunnion::study::{Setup, bars};
use trunnion_codegen::catalogue;
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Place and text of a model by its catalogue name or from a file.
pub fn source(name: &str) -> Result<(String, String), Refused> {
    Ok(match catalogue::source(name) {
        Some(source) => (name.to_owned(), source.to_owned()),
        None => {
            let path = Path::new(name);
            let source = read_text(path).map_err(|e| {
                let names = catalogue::MODELS.iter().map(|(n, _)| *n).collect::<Vec<_>>().join(", ");
                match e {
                    TextError::Unreadable(ErrorKind::NotFound) => Refused::NoSuchModel(name.to_owned(), names),
                    TextError::Unreadable(kind) => Refused::Unreadable(path.to_owned(), kind, names),
                    other => Refused::Text(path.to_owned(), other),
                }
            })?;
            (path.display().to_string(), source)
        }
    })
}

/// Reads a model by its catalogue name or from a file.
pub fn load(name: &str) -> Result<Model, Refused> {
    let (place, source) = source(name)?;
    let colour = if std::io::stderr().is_terminal() { Colour::On } else { Colour::Off };
    let derived = read_and_derive(&source);
    Ok(derived.map_err(|problems| Refused::Model(render(&place, &source, &problems, colour)))?.0)
}

/// A model and the lengths of its set-up.
#[derive(Debug, Args)]
pub struct ModelArguments {
    /// A name from the catalogue, or a model file.
    pub model: String,
    /// Nominal length of the ball-bar, mm; without it the model file's usual one.
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = millimetres)]
    pub radius: Option<f64>,
    /// Another length of the set-up, mm, where it is not the model file's usual one.
    #[arg(long = "set", value_name = "NAME=MM")]
    pub lengths: Vec<String>,
}

impl ModelArguments {
    /// The files that are read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        vec![PathBuf::from(&self.model)]
    }

    /// What is said of it as a file that was read.
    pub fn read(&self) -> Value {
        match catalogue::source(&self.model) {
            Some(source) => read("model, built in", &self.model, Stamp::of(source.as_bytes()).ok()),
            None => read("model", &self.model, Stamp::of_file(Path::new(&self.model))),
        }
    }

    /// The model with its lengths, after a change.
    pub fn setup(&self, change: impl FnOnce(&mut Model) -> Result<(), Refused>) -> Result<Setup, Refused> {
        let radius = self.radius.map(Radius::new).transpose()?;
        let mut model = load(&self.model)?;
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

fn millimetres(text: &str) -> Result<f64, &'static str> {
    text.trim().parse().map_err(|_| "not a number\n  expected the nominal length of the bar in mm, e.g. 150")
}
