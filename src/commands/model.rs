//! The MODEL argument and the lengths of its set-up.

use super::Refused;
use clap::Args;
use std::io::IsTerminal;
use std::path::Path;
use trunnion::data::Radius;
use trunnion::study::Setup;
use trunnion_codegen::catalogue;
use trunnion_codegen::model::{Model, ReadingKind};
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Place and text of a model by its catalogue name or from a file.
pub fn source(name: &str) -> Result<(String, String), Refused> {
    Ok(match catalogue::source(name) {
        Some(source) => (name.to_owned(), source.to_owned()),
        None => {
            let path = Path::new(name);
            let source = std::fs::read_to_string(path).map_err(|e| {
                let names = catalogue::MODELS.iter().map(|(n, _)| *n).collect::<Vec<_>>().join(", ");
                match e.kind() {
                    std::io::ErrorKind::NotFound => Refused::NoSuchModel(name.to_owned(), names),
                    kind => Refused::Unreadable(path.to_owned(), kind, names),
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
    /// Nominal length of the ball-bar, mm.
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = millimetres)]
    pub radius: f64,
    /// Another length of the set-up, mm.
    #[arg(long = "set", value_name = "NAME=MM")]
    pub lengths: Vec<String>,
}

impl ModelArguments {
    /// The model with its lengths.
    pub fn setup(&self) -> Result<(Setup, Radius), Refused> {
        let radius = Radius::new(self.radius)?;
        let model = load(&self.model)?;
        let values = lengths(&model, radius, &self.lengths)?;
        let values: Vec<(&str, f64)> = values.iter().map(|(n, mm)| (n.as_str(), *mm)).collect();
        let setup = Setup::new(model.clone(), &values).map_err(|e| Refused::setup(&model, &e))?;
        Ok((setup, radius))
    }
}

/// Every length of the set-up that is given: the bar's, and those of `--set`.
pub fn lengths(model: &Model, radius: Radius, given: &[String]) -> Result<Vec<(String, f64)>, Refused> {
    let bars: Vec<String> = model.runs.iter().filter_map(|r| bar(model, &r.reading)).collect();
    let mut values: Vec<(String, f64)> = Vec::new();
    for given in given {
        let pair = given.split_once('=').and_then(|(name, mm)| Some((name, mm.parse().ok()?)));
        let not = || Refused::NotAPair { option: "set", pair: "NAME=MM", given: given.clone(), example: "H=80" };
        let (name, mm) = pair.ok_or_else(not)?;
        if bars.iter().any(|bar| bar == name) {
            return Err(Refused::SetBar(given.clone()));
        }
        if values.iter().any(|(n, _)| n == name) {
            return Err(Refused::LengthTwice(given.clone()));
        }
        values.push((name.to_owned(), mm));
    }
    for name in &bars {
        if values.iter().all(|(n, _)| n != name) {
            values.push((name.clone(), radius.mm()));
        }
    }
    Ok(values)
}

/// True if a run of the model reads the length of a bar, so that its radius matters.
pub fn has_bar(model: &Model) -> bool {
    model.runs.iter().any(|r| bar(model, &r.reading).is_some())
}

/// The constant that is a run's bar.
fn bar(model: &Model, reading: &ReadingKind) -> Option<String> {
    match reading {
        ReadingKind::BarLength(id) => Some(model.alphabet.nominal_name(*id)),
        ReadingKind::Displacement(_) => None,
    }
}

fn millimetres(text: &str) -> Result<f64, &'static str> {
    text.trim().parse().map_err(|_| "not a number\n  expected the nominal length of the bar in mm, e.g. 150")
}
