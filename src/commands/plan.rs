//! `trunnion plan`: what intended runs would tell, before anything is measured.

use super::fit::Combine;
use super::model::{has_bar, lengths, load, source};
use super::predicted::{self, Measuring};
use super::{Refused, estimate, print};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use trunnion::data::Radius;
use trunnion::study::plan::{Addition, Prediction, additions, predict, subset};
use trunnion::study::{FitError, Setup, WARN_CONDITION, unit};
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::equations;
use trunnion_codegen::identify::derive;
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
        print(&match self.json {
            true => format!("{:#}\n", self.json(&model, &derivation, &lines, &described, (tried, &added))),
            false => self.text(&model, &derivation, &lines, &described, (tried, &added)),
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
                let kept: Vec<usize> = (0..names.len()).filter(|&i| without.iter().all(|w| w != names[i])).collect();
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
    fn setup(&self, model: &Model, kept: &[usize], values: &[(String, f64)]) -> Result<Result<Setup, String>, Refused> {
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
        let names = |base: &[usize]| -> String {
            let names: Vec<&str> = base.iter().map(|&b| setup.derivation.base[b].name.as_str()).collect();
            names.join(", ")
        };
        let name = |run: usize| setup.model.runs[run].name.clone();
        Ok(match predict(setup, self.measuring.over(range)?, self.measuring.estimator.into()) {
            Ok(prediction) => Outcome::Predicted { setup: Box::new(setup.clone()), prediction },
            Err(FitError::Confounded { base, .. }) => Outcome::Refused(format!("cannot tell {} apart", names(&base))),
            Err(e) => Outcome::Refused(Refused::fit(setup, &name, &e).to_string().replace("\n ", ";")),
        })
    }

    fn text(
        &self,
        model: &Model,
        derivation: &trunnion_codegen::identify::Derivation,
        lines: &[Line],
        described: &[String],
        (tried, added): (usize, &[Addition]),
    ) -> String {
        let mut out = format!(
            "{}: {} samples a run, noise ±{} µm, {} estimate\n",
            model.name,
            self.measuring.samples,
            self.measuring.noise_um,
            combined(self.measuring.estimator)
        );
        let _ = writeln!(
            out,
            "  {:>5} {:>10}  {:>4} {:>10}  runs; largest uncertainty of each function",
            "R", "range", "rank", "condition"
        );
        for line in lines {
            let radius = line.radius.map_or(String::from("-"), |mm| mm.to_string());
            let range = format!("{}…{}°", line.range.0, line.range.1);
            let runs = match line.without.is_empty() {
                true => "all".to_owned(),
                false => format!("without {}", line.without.join(", ")),
            };
            match &line.outcome {
                Outcome::Refused(why) => {
                    let _ = writeln!(out, "  {radius:>5} {range:>10}  {:>4} {:>10}  {runs}; {why}", "-", "-");
                }
                Outcome::Predicted { setup, prediction } => {
                    let hardly = if prediction.condition > WARN_CONDITION { "!" } else { " " };
                    let _ = write!(
                        out,
                        "  {radius:>5} {range:>10}  {:>4} {:>9.0}{hardly}  {runs}",
                        setup.derivation.rank(),
                        prediction.condition
                    );
                    for f in &prediction.functions {
                        let mark = if f.together.is_empty() { "" } else { "*" };
                        let _ = write!(out, "; {}{mark}", predicted::function(setup, f));
                    }
                    out.push('\n');
                }
            }
        }
        let _ = writeln!(
            out,
            "  ! condition above {WARN_CONDITION}: hardly told apart\n  * its coefficients are seen only together with other errors"
        );
        let asked = !self.without.is_empty();
        out += &together(lines.iter().filter(|l| asked || l.without.is_empty()));
        let _ = writeln!(
            out,
            "\nWhat all runs together cannot tell apart, and what each of the {tried} runs of the catalogue that fit this machine would separate"
        );
        for (group, words) in derivation.groups().iter().zip(described) {
            let _ = writeln!(out, "  {words}");
            let separating: Vec<&Addition> =
                added.iter().filter(|a| a.separates.iter().any(|s| group.kernel.contains(s))).collect();
            if separating.is_empty() {
                let _ = writeln!(out, "    none separates any of them");
            }
            for a in separating.iter().take(3) {
                let count = a.separates.iter().filter(|s| group.kernel.contains(s)).count();
                let of = group.kernel.len();
                let determined = a.determines.iter().filter(|j| group.parameters.contains(j));
                let determined: Vec<&str> = determined.map(|&j| derivation.parameters[j].name.as_str()).collect();
                let then = match determined.as_slice() {
                    [] => String::new(),
                    names => format!("; then {} can be told", names.join(", ")),
                };
                let _ = writeln!(
                    out,
                    "    adding {} of {}{} separates {count} of {of} directions{then}",
                    a.run,
                    a.model,
                    kept(a)
                );
            }
            if separating.len() > 3 {
                let _ = writeln!(out, "    and {} more runs of the catalogue", separating.len() - 3);
            }
        }
        for a in added.iter().filter(|a| !a.finds.is_empty()) {
            let _ = writeln!(
                out,
                "  {} of {} helps to measure {}, taken as known here",
                a.run,
                a.model,
                a.finds.join(", ")
            );
        }
        out
    }

    fn json(
        &self,
        model: &Model,
        derivation: &trunnion_codegen::identify::Derivation,
        lines: &[Line],
        described: &[String],
        (tried, added): (usize, &[Addition]),
    ) -> Value {
        let name = |j: &usize| derivation.parameters[*j].name.clone();
        let groups = derivation.groups();
        let groups = groups.iter().zip(described).map(|(g, words)| {
            json!({
                "parameters": g.parameters.iter().map(name).collect::<Vec<_>>(),
                "base": g.base.iter().map(|&b| derivation.base[b].name.clone()).collect::<Vec<_>>(),
                "directions": g.kernel.len(),
                "words": words,
                "separated_by": added.iter().filter_map(|a| {
                    let count = a.separates.iter().filter(|s| g.kernel.contains(s)).count();
                    (count > 0).then(|| json!({
                        "model": a.model,
                        "run": a.run,
                        "tool_ball_kept": a.ball_kept,
                        "directions": count,
                        "determines": a.determines.iter().filter(|j| g.parameters.contains(j)).map(name).collect::<Vec<_>>(),
                    }))
                }).collect::<Vec<_>>(),
            })
        });
        let known = added.iter().filter(|a| !a.finds.is_empty());
        json!({
            "model": model.name,
            "samples": self.measuring.samples,
            "noise_um": self.measuring.noise_um,
            "estimator": combined(self.measuring.estimator),
            "plans": lines.iter().map(object).collect::<Vec<_>>(),
            "runs_tried": tried,
            "confounded": groups.collect::<Vec<_>>(),
            "known_measured_by": known.map(|a| json!({ "model": a.model, "run": a.run, "functions": a.finds })).collect::<Vec<_>>(),
        })
    }
}

fn kept(a: &Addition) -> &'static str {
    if a.ball_kept { ", the tool ball left in place," } else { "" }
}

fn combined(c: Combine) -> &'static str {
    estimate::name(c.into())
}

/// For each subset of runs, what its functions' coefficients stand for.
fn together<'a>(lines: impl Iterator<Item = &'a Line>) -> String {
    let mut out = String::new();
    let mut said: Vec<&Vec<String>> = Vec::new();
    for line in lines {
        let Outcome::Predicted { setup, prediction } = &line.outcome else { continue };
        let held: Vec<usize> = prediction.functions.iter().flat_map(|f| f.together.iter().copied()).collect();
        if held.is_empty() || said.contains(&&line.without) {
            continue;
        }
        said.push(&line.without);
        let runs = if line.without.is_empty() {
            "All runs".to_owned()
        } else {
            format!("Without {}", line.without.join(", "))
        };
        let _ = writeln!(out, "\n{runs}: estimated are");
        for b in held {
            let base = &setup.derivation.base[b];
            let _ =
                writeln!(out, "  {} as {}", base.name, equations::definition(&setup.model, &setup.derivation, base));
        }
    }
    out
}

fn object(line: &Line) -> Value {
    let mut value = json!({
        "radius_mm": line.radius,
        "range_deg": [line.range.0, line.range.1],
        "without": line.without,
    });
    match &line.outcome {
        Outcome::Refused(why) => value["refused"] = json!(why),
        Outcome::Predicted { setup, prediction } => {
            let name = |b: &usize| setup.derivation.base[*b].name.clone();
            let function = |f: &trunnion::study::plan::Predicted| {
                let (unit, scale) = unit(setup.component(f.function));
                json!({
                    "name": setup.function_name(f.function),
                    "unit": unit,
                    "largest_std": f.largest.map(|l| l.std * scale),
                    "largest_u95": f.largest.map(|l| l.u95 * scale),
                    "seen_together": f.together.iter().map(name).collect::<Vec<_>>(),
                })
            };
            value["rank"] = json!(setup.derivation.rank());
            value["condition"] = json!(prediction.condition);
            value["weakest"] = json!(prediction.weakest.iter().map(name).collect::<Vec<_>>());
            let std: serde_json::Map<String, Value> =
                prediction.base.iter().map(|(b, std)| (name(b), json!(std))).collect();
            value["std"] = Value::Object(std);
            value["functions"] = json!(prediction.functions.iter().map(function).collect::<Vec<_>>());
        }
    }
    value
}
