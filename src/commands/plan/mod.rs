//! `trunnion plan`: what intended runs would tell, before anything is measured.

mod json;
mod text;

use super::fit::Combine;
use super::model::{has_bar, lengths, load, source};
use super::predicted::{self, Measuring};
use super::{Refused, estimate, print};
use clap::Args;
use trunnion::data::Radius;
use trunnion::study::plan::{Addition, Prediction, additions, predict, subset};
use trunnion::study::{FitError, Setup};
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::equations;
use trunnion_codegen::identify::{Derivation, derive};
use trunnion_codegen::ids::{BaseId, RunId};
use trunnion_codegen::model::{Model, read_draft};

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct Plan {
    /// A name from the catalogue, or a model file.
    model: String,
    /// Nominal lengths of the ball-bar to compare, mm; 100, 150 and 300 if none is given.
    #[arg(long, value_name = "MM", value_delimiter = ',', num_args = 1.., allow_negative_numbers = true)]
    radius: Vec<f64>,
    /// Another length of the set-up, mm.
    #[arg(long = "set", value_name = "NAME=MM")]
    lengths: Vec<String>,
    /// Ranges of the sweeps to compare, degrees; the full turn, -20:200 and -90:90 if none is given.
    #[arg(long, value_name = "A:B", num_args = 1.., value_parser = predicted::range, allow_hyphen_values = true)]
    range_deg: Vec<(f64, f64)>,
    /// A run to leave out, several joined by commas to leave them out together; each run in turn if none is given.
    #[arg(long, value_name = "RUN", num_args = 1..)]
    without: Vec<String>,
    #[command(flatten)]
    measuring: Measuring,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// All there is to say.
struct Found<'a> {
    model: &'a Model,
    derivation: &'a Derivation,
    lines: Vec<Line>,
    /// The confounded groups in words.
    described: Vec<String>,
    /// Runs of the catalogue that fit the machine.
    tried: usize,
    added: Vec<Addition>,
}

/// One line of the comparison.
struct Line {
    radius: Option<f64>,
    range: (f64, f64),
    without: Vec<String>,
    outcome: Outcome,
}

/// What a subset of runs over a range gives.
enum Outcome {
    Predicted { setup: Box<Setup>, prediction: Prediction },
    Refused(String),
}

const RADII: [f64; 3] = [100.0, 150.0, 300.0];
const RANGES: [(f64, f64); 3] = [(0.0, 360.0), (-20.0, 200.0), (-90.0, 90.0)];

impl Plan {
    /// Compares, prints.
    pub fn run(self) -> Result<(), Refused> {
        let model = load(&self.model)?;
        let (_, text_of_model) = source(&self.model)?;
        let derivation = derive(&model).map_err(|e| Refused::derive(&model, &e))?;
        let lines = self.compare(&model)?;
        // The model has just been read, so its draft can be.
        let draft = read_draft(&text_of_model).unwrap_or_default();
        let (tried, added) = additions(&draft, &model, &derivation, catalogue::MODELS);
        let described: Vec<String> =
            derivation.groups().iter().map(|g| equations::group(&model, &derivation, g)).collect();
        let found = Found { model: &model, derivation: &derivation, lines, described, tried, added };
        print(&match self.json {
            true => format!("{:#}\n", json::json(&self, &found)),
            false => text::text(&self, &found),
        })
    }

    /// Every combination asked for.
    fn compare(&self, model: &Model) -> Result<Vec<Line>, Refused> {
        let names: Vec<&str> = model.runs.iter().map(|r| r.name.as_str()).collect();
        let given = |text: &String| {
            let one = |name: &str| match names.contains(&name.trim()) {
                true => Ok(name.trim().to_owned()),
                false => Err(Refused::UnknownRun(name.to_owned(), names.join(", "))),
            };
            text.split(',').map(one).collect::<Result<Vec<String>, Refused>>()
        };
        let mut omitted = vec![Vec::new()];
        match self.without.is_empty() {
            true if names.len() > 1 => omitted.extend(names.iter().map(|n| vec![(*n).to_owned()])),
            true => {}
            false => omitted.extend(self.without.iter().map(given).collect::<Result<Vec<_>, _>>()?),
        }
        let radii: Vec<f64> = match (has_bar(model), self.radius.is_empty()) {
            (true, true) => RADII.to_vec(),
            (true, false) => self.radius.clone(),
            // Without a bar the radius means nothing; one line says it all.
            (false, _) => vec![RADII[0]],
        };
        let ranges = if self.range_deg.is_empty() { RANGES.to_vec() } else { self.range_deg.clone() };
        let mut lines = Vec::new();
        for &mm in &radii {
            let values = lengths(model, Radius::new(mm)?, &self.lengths)?;
            for without in &omitted {
                let kept = model.runs.iter_enumerated().filter(|(_, run)| without.iter().all(|w| *w != run.name));
                let kept: Vec<RunId> = kept.map(|(id, _)| id).collect();
                let setup = self.setup(model, &kept, &values)?;
                for &range in &ranges {
                    let outcome = match &setup {
                        Ok(setup) => self.outcome(setup, range)?,
                        Err(why) => Outcome::Refused(why.clone()),
                    };
                    lines.push(Line { radius: has_bar(model).then_some(mm), range, without: without.clone(), outcome });
                }
            }
        }
        Ok(lines)
    }

    /// The model with some of its runs; why not, if these have no measurement model.
    fn setup(&self, model: &Model, kept: &[RunId], values: &[(String, f64)]) -> Result<Result<Setup, String>, Refused> {
        if kept.is_empty() {
            return Ok(Err("no run is left".to_owned()));
        }
        let part = match subset(model, kept) {
            Ok(part) => part,
            Err(e) => return Ok(Err(Refused::derive(model, &e).to_string())),
        };
        let values: Vec<(&str, f64)> = values.iter().map(|(n, mm)| (n.as_str(), *mm)).collect();
        Setup::new(part.clone(), &values).map(Ok).map_err(|e| Refused::setup(&part, &e))
    }

    fn outcome(&self, setup: &Setup, range: (f64, f64)) -> Result<Outcome, Refused> {
        let names = |base: &[BaseId]| -> String {
            let names: Vec<&str> = base.iter().map(|&b| setup.derivation.base[b].name.as_str()).collect();
            names.join(", ")
        };
        let name = |run: RunId| setup.model.runs[run].name.clone();
        Ok(match predict(setup, self.measuring.over(range)?, self.measuring.estimator.into()) {
            Ok(prediction) => Outcome::Predicted { setup: Box::new(setup.clone()), prediction },
            Err(FitError::Confounded { base, .. }) => Outcome::Refused(format!("cannot tell {} apart", names(&base))),
            Err(e) => Outcome::Refused(Refused::fit(setup, &name, &e).to_string().replace("\n ", ";")),
        })
    }
}

fn combined(c: Combine) -> &'static str {
    estimate::name(c.into())
}
