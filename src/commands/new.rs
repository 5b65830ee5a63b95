//! `trunnion new`: a folder to measure with.

use super::Refused;
use super::model::ModelArguments;
use super::number;
use super::output::say;
use super::stated::RangeArguments;
use clap::Args;
use std::path::{Path as FilePath, PathBuf};
use trunnion::data::{Files, Guard, PROJECT};
use trunnion::program::{Control, Program};
use trunnion::project::{self, Planned};
use trunnion::study::plan::{Intended, predict};
use trunnion::study::{Estimator, Path};
use trunnion_codegen::catalogue;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::problems::Named;
use trunnion_codegen::quantity::Unit;

/// Samples of each run that the valuation numbers are for.
const SAMPLES: usize = 360;

/// Arguments of `new`.
#[derive(Debug, Args)]
pub struct NewArguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    ranges: RangeArguments,
    /// Degrees of the sweep a minute in the NC programs.
    #[arg(long, value_name = "DEG", default_value_t = 360.0, value_parser = number::rate, allow_negative_numbers = true)]
    rate: f64,
    /// Degrees by which the NC programs go on beyond both ends of what is measured, where the axes can.
    #[arg(long, value_name = "DEG", default_value_t = 5.0, value_parser = number::beyond, allow_negative_numbers = true)]
    overshoot: f64,
    /// The folder.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replaces files of their names.
    #[arg(long)]
    force: bool,
}

impl NewArguments {
    /// Plans, writes.
    pub fn run(self) -> Result<(), Refused> {
        let source = self.model.source()?;
        if source.project.is_some() {
            return Err(Refused::IsProject(self.model.model.unwrap_or(PROJECT.to_owned())));
        }
        let setup = self.model.setup(&source, |model| self.ranges.apply(model))?;
        // What a standard deviation of 1 µm of the readings makes of each function.
        let intended =
            Intended { samples: SAMPLES, range: (0.0, std::f64::consts::TAU), sigma: Unit::Um.to_inner(1.0) };
        let prediction = predict(&setup, intended, Estimator::Joint)?;
        let paths: Vec<(RunId, Path)> =
            setup.model.runs.keys().map(|run| (run, setup.path(run, self.overshoot.to_radians()))).collect();
        let mut files = Files::default();
        let Named { name, text } = &source.described.model;
        // A model file comes along.
        let model = match catalogue::source(name) {
            Some(_) => name.clone(),
            None => {
                let file = FilePath::new(name).file_name().map_or(name.into(), |file| file.to_string_lossy());
                files.add(&*file, text.as_str());
                file.into_owned()
            }
        };
        let planned = Planned { setup: &setup, model: &model, prediction: &prediction, paths: &paths };
        files.add(PROJECT, project::project(&planned));
        files.add("measuring-plan.md", project::plan(&planned));
        for (run, path) in &paths {
            let name = &setup.model.runs[*run].name;
            let program = Program { name, title: &setup.model.title, path, rate: self.rate };
            for control in Control::ALL {
                match program.text(control) {
                    Some(text) => files.add(project::program_file(name, control), text),
                    None => {
                        say(format_args!("note: no program of {name} for {}: the names of its axes", control.name()))
                    }
                }
            }
        }
        Ok(files.write(&self.out, &Guard { inputs: source.inputs(), force: self.force })?)
    }
}
