//! `trunnion new`: a folder to measure with.

use super::Refused;
use super::model::ModelArguments;
use super::number::{self, length};
use super::output::say;
use super::stated::RangeArguments;
use clap::Args;
use std::path::{Path as FilePath, PathBuf};
use trunnion::data::{Files, Guard, PROJECT, read_positions, read_text};
use trunnion::program::{Control, Probing, Program};
use trunnion::project::{self, Planned};
use trunnion::study::plan::positions::{PositionsError, unread};
use trunnion::study::plan::predict_at;
use trunnion::study::{Estimator, Measurement, Path, Setup, grid};
use trunnion_codegen::catalogue;
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
    /// Positions of a touch probe in each run that reads three displacements: its programs stop there and find a sphere's centre,
    /// in place of a path for probes that read on the way.
    #[arg(long, value_name = "N", value_parser = number::stops, group = "stops")]
    positions: Option<usize>,
    /// The same at the positions of a file, as `trunnion plan --positions N --out FILE` proposes them.
    #[arg(long, value_name = "FILE", group = "stops")]
    at: Option<PathBuf>,
    /// Half of the diameters of the sphere and of the touch probe's ball together, mm: how far their centres are apart at a touch.
    #[arg(long, value_name = "MM", default_value_t = 15.0, value_parser = length, requires = "stops")]
    touch_mm: f64,
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
        let measurements = setup.measurements();
        let stops = self.stops(&setup, &measurements)?;
        let probed = stops.is_some();
        let stopped = |at: usize| stops.as_ref()?.get(at).filter(|_| measurements[at].is_displacement()).cloned();
        let path = |(at, measurement): (usize, &Measurement)| {
            let run = measurement.first()?;
            let driven = || setup.path(run, self.overshoot.to_radians());
            let path = stopped(at).map_or_else(driven, |sweeps| Ok(setup.positions(run, sweeps)));
            Some(path.map(|path| (measurement.clone(), path)))
        };
        let paths: Vec<(Measurement, Path)> =
            measurements.iter().enumerate().filter_map(path).collect::<Result<_, _>>()?;
        let swept = |(at, (_, path)): (usize, &(Measurement, Path))| {
            stopped(at).unwrap_or_else(|| grid(SAMPLES, path.measured.into()))
        };
        let read: Vec<Vec<f64>> = paths.iter().enumerate().map(swept).collect();
        // What a standard deviation of 1 µm of the readings makes of each function.
        let unread = unread(&setup, &measurements, &read);
        let prediction = predict_at(&setup, &unread, &unread, Unit::Um.to_inner(1.0), Estimator::Joint)?;
        let samples = read.first().map(Vec::len).filter(|first| read.iter().all(|own| own.len() == *first));
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
        let planned = Planned { setup: &setup, model: &model, prediction: &prediction, paths: &paths, samples, probed };
        files.add(PROJECT, project::project(&planned));
        files.add("measuring-plan.md", project::plan(&planned));
        for (measurement, path) in &paths {
            let (name, title) = (&measurement.name, &setup.model.title);
            let probing = probed && measurement.is_displacement();
            let text = |control: Control| {
                if !probing {
                    return Program { name, title, path, rate: self.rate }.text(control);
                }
                let sweep = setup.model.alphabet.sweep_name(setup.model.runs[measurement.first()?].sweep);
                Probing { name, title, path, sweep, radius: self.touch_mm }.text(control)
            };
            for control in Control::ALL {
                match text(control) {
                    Some(text) => files.add(project::program_file(name, control), text),
                    None => {
                        say(format_args!("note: no program of {name} for {}: the names of its axes", control.name()))
                    }
                }
            }
        }
        Ok(files.write(
            &self.out,
            &Guard { inputs: source.inputs().into_iter().chain(self.at.clone()).collect(), force: self.force },
        )?)
    }

    /// Where each run stops, rad, in the order of the runs; none where they do not.
    fn stops(&self, setup: &Setup, measurements: &[Measurement]) -> Result<Option<Vec<Vec<f64>>>, Refused> {
        if let Some(count) = self.positions {
            if !measurements.iter().any(Measurement::is_displacement) {
                return Err(Refused::Option("positions", count.to_string(), NONE_DISPLACED));
            }
            // The runs' files would be refused.
            if let Some(own) = measurements.iter().find(|own| own.is_displacement() && count < setup.least(&own.runs)) {
                let (of, least) = (format!("run {}", own.name), setup.least(&own.runs));
                return Err(PositionsError::TooFew { wanted: count, of, least }.into());
            }
            let evenly = |own: &Measurement| own.first().map_or(Vec::new(), |run| setup.evenly(run, count));
            return Ok(Some(measurements.iter().map(evenly).collect()));
        }
        let Some(file) = &self.at else { return Ok(None) };
        if !measurements.iter().all(Measurement::is_displacement) {
            return Err(Refused::Option("at", file.display().to_string(), NOT_DISPLACED));
        }
        let text = read_text(file).map_err(|problem| Refused::Text(file.clone(), problem))?;
        let read = read_positions(&text, setup, measurements);
        Ok(Some(read.map_err(|problem| Refused::PositionsFile(file.clone(), problem))?))
    }
}

/// Of what a touch probe does not measure.
const NONE_DISPLACED: &str = "no run reads three displacements\n  expected a model whose runs read \"xyz\"";
const NOT_DISPLACED: &str = "a run does not read three displacements\n  expected a model whose runs all read \"xyz\"";
