//! `trunnion new`: a folder to measure with; or what of it follows from its project file.

use super::Refused;
use super::model::ModelArguments;
use super::number::{self, length};
use super::output::say;
use super::stated::RangeArguments;
use clap::Args;
use std::path::{Path as FilePath, PathBuf};
use trunnion::data::{Files, Guard, PROJECT, Positions, Source, read_text};
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
/// What is usual of a sphere and a probe, mm.
const TOUCH_MM: f64 = 15.0;

/// Arguments of `new`.
#[derive(Debug, Args)]
pub struct NewArguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    ranges: RangeArguments,
    /// Degrees of the sweep a minute in the NC programs.
    #[arg(long, value_name = "DEG/MIN", default_value_t = 360.0, value_parser = number::rate, allow_negative_numbers = true)]
    rate: f64,
    /// Degrees by which the NC programs go on beyond both ends of what is measured; where an axis' range ends, less is measured.
    #[arg(long, alias = "overshoot", value_name = "DEG", default_value_t = 5.0, value_parser = number::beyond, allow_negative_numbers = true)]
    overshoot_deg: f64,
    /// Positions of a touch probe in each run that reads three displacements: its programs stop there and find a sphere's centre,
    /// in place of a path for probes that read on the way.
    #[arg(long, value_name = "N", value_parser = number::stops, group = "stops")]
    positions: Option<usize>,
    /// The same at the positions of a file, as `trunnion plan --positions N --out FILE` proposes them; without it at those of the
    /// project.
    #[arg(long, value_name = "FILE", group = "stops")]
    at: Option<PathBuf>,
    /// Half of the diameters of the sphere and of the touch probe's ball together, mm: how far their centres are apart at a touch; without it
    /// that of the project, or 15.
    #[arg(long, value_name = "MM", value_parser = length)]
    touch_mm: Option<f64>,
    /// The folder; without it that of the project, whose plan and programs are written anew.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replaces files of their names.
    #[arg(long)]
    force: bool,
}

impl NewArguments {
    /// Plans, writes.
    pub fn run(self) -> Result<(), Refused> {
        let source = self.model.source()?;
        let folder = source.folder();
        let Some(out) = self.out.as_ref().or(folder.as_ref()) else { return Err(Refused::NoFolder) };
        let setup = self.model.setup(&source, |model| self.ranges.apply(model))?;
        let measurements = setup.measurements();
        let stops = self.stops(&source, &setup, &measurements)?;
        if let Some(touch) = self.touch_mm.filter(|_| stops.is_none()) {
            return Err(Refused::Option("touch-mm", touch.to_string(), NOTHING_TOUCHED));
        }
        let stated = self.touch_mm.or_else(|| source.project.as_ref()?.touch_mm);
        let touch_mm = stops.as_ref().map(|_| stated.unwrap_or(TOUCH_MM));
        let stopped = |at: usize| stops.as_ref()?.get(at).filter(|_| measurements[at].is_displacement()).cloned();
        let path = |(at, measurement): (usize, &Measurement)| {
            let run = measurement.first()?;
            let driven = || setup.path(run, self.overshoot_deg.to_radians());
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
        let file = FilePath::new(name).file_name().filter(|_| catalogue::source(name).is_none());
        let model = file.map_or_else(|| name.clone(), |file| file.to_string_lossy().into_owned());
        let named = source.readings();
        let (setup, model, prediction, paths) = (&setup, &model, &prediction, &paths);
        let planned = Planned { setup, model, prediction, paths, samples, touch_mm, named: &named };
        if source.project.is_none() {
            files.add(PROJECT, project::project(&planned));
            // A model file comes along.
            if file.is_some() {
                files.add(model, text.as_str());
            }
        }
        files.add("measuring-plan.md", project::plan(&planned));
        for (measurement, path) in paths {
            let (name, title) = (&measurement.name, &setup.model.title);
            let text = |control: Control| {
                let Some(radius) = touch_mm.filter(|_| measurement.is_displacement()) else {
                    return Program { name, title, path, rate: self.rate }.text(control);
                };
                let sweep = setup.model.alphabet.sweep_name(setup.model.runs[measurement.first()?].sweep);
                Probing { name, title, path, sweep, radius }.text(control)
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
            out,
            &Guard { inputs: source.inputs().into_iter().chain(self.at.clone()).collect(), force: self.force },
        )?)
    }

    /// Where each run stops, rad, in the order of the runs; none where they do not.
    fn stops(
        &self,
        source: &Source,
        setup: &Setup,
        measurements: &[Measurement],
    ) -> Result<Option<Vec<Vec<f64>>>, Refused> {
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
        let (file, positions) = match (&self.at, source.positions()) {
            (Some(file), _) => {
                let text = read_text(file).map_err(|problem| Refused::Text(file.clone(), problem))?;
                (file.clone(), Positions::read(&text))
            }
            (None, Some((file, positions))) => (file, Ok(positions.clone())),
            (None, None) => return Ok(None),
        };
        if !measurements.iter().all(Measurement::is_displacement) {
            return Err(Refused::PositionsOf(file, NOT_DISPLACED));
        }
        let read = positions.and_then(|positions| positions.sweeps(setup, measurements));
        Ok(Some(read.map_err(|problem| Refused::PositionsFile(file, problem))?))
    }
}

/// Of what a touch probe does not measure.
const NONE_DISPLACED: &str = "no run reads three displacements\n  expected a model whose runs read \"xyz\"";
const NOTHING_TOUCHED: &str = "nothing is touched\n  expected --positions or --at, or a project with [positions_deg]";
const NOT_DISPLACED: &str = "a run does not read three displacements\n  expected a model whose runs all read \"xyz\"";
