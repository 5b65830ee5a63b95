//! `trunnion fit`: errors and their uncertainty from measurement files.

use super::model::ModelArguments;
use super::simulated::limits;
use super::{Refused, estimate, print};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trunnion::data::{Known, Radius, Sweep, Table};
use trunnion::study::{Estimator, Observation, Sample, Setup, fit, report};
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::model::Coordinate;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct Fit {
    #[command(flatten)]
    model: ModelArguments,
    /// Measurements of a run; once for every run of the model.
    ///
    /// Three displacements may be in one file with the columns dx, dy, dz: `low=FILE` for the runs low-x, low-y, low-z.
    #[arg(long = "run", value_name = "NAME=FILE", required = true)]
    runs: Vec<String>,
    /// The known functions over the swept angle; without it they are taken as zero.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// How the runs are combined.
    #[arg(long, value_enum, default_value_t = Combine::Joint)]
    estimator: Combine,
    /// Weight of a run's samples: one over the variance of its readings, up to a common factor (between runs fitted in one
    /// step: the two steps of two-step do not weigh each other).
    #[arg(long = "weight", value_name = "NAME=W")]
    weights: Vec<String>,
    /// Largest length error of the machine that what linearisation drops is worked out for, µm.
    #[arg(long, default_value_t = 30.0)]
    length_um: f64,
    /// Largest angle error for the same, µrad.
    #[arg(long, default_value_t = 100.0)]
    angle_urad: f64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// An estimator's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Combine {
    /// All runs at once.
    Joint,
    /// The runs without an estimated function first, the paper's way.
    TwoStep,
}

impl From<Combine> for Estimator {
    fn from(c: Combine) -> Self {
        match c {
            Combine::Joint => Self::Joint,
            Combine::TwoStep => Self::TwoStep,
        }
    }
}

impl Fit {
    /// Reads, fits, prints.
    pub fn run(self) -> Result<(), Refused> {
        let (setup, radius) = self.model.setup()?;
        let files = self.files(&setup)?;
        let observations = self.observations(&setup, radius, &files)?;
        let estimator = Estimator::from(self.estimator);
        let file_of = |run: RunId| files[run].0.display().to_string();
        let fitted = fit(&setup, &observations, estimator).map_err(|e| Refused::fit(&setup, &file_of, &e))?;
        let limits = limits(self.length_um, self.angle_urad)?;
        let without_table = self.table.is_none();
        let report = report(&setup, &observations, &fitted, limits, without_table)
            .map_err(|e| Refused::setup(&setup.model, &e))?;
        for warning in &report.warnings {
            eprintln!("warning: {warning}");
        }
        print(&match self.json {
            true => format!("{:#}\n", estimate::json(&setup, radius.mm(), estimator, &report)),
            false => estimate::text(&setup, estimator, limits, &report),
        })
    }

    /// The file of every run.
    fn files(&self, setup: &Setup) -> Result<TiVec<RunId, Source>, Refused> {
        let names = run_names(setup);
        let mut files: TiVec<RunId, Option<Source>> = ti_vec![None; names.len()];
        for given in &self.runs {
            let not = || Refused::NotAPair {
                option: "run",
                pair: "NAME=FILE",
                given: given.clone(),
                example: "tilting=run1.csv",
            };
            let (name, file) = given.split_once('=').filter(|(_, file)| !file.is_empty()).ok_or_else(not)?;
            let channels: Vec<RunId> =
                ["-x", "-y", "-z"].iter().filter_map(|c| setup.run(&format!("{name}{c}"))).collect();
            let runs = match setup.run(name) {
                Some(run) => vec![(run, READING)],
                None if channels.len() == CHANNELS.len() => channels.into_iter().zip(CHANNELS).collect(),
                None => return Err(Refused::UnknownRun(name.to_owned(), names.join(", "))),
            };
            for (run, column) in runs {
                if files[run].replace((PathBuf::from(file), column)).is_some() {
                    return Err(Refused::RunTwice(setup.model.runs[run].name.clone()));
                }
            }
        }
        let missing =
            |(file, name): (Option<Source>, &&str)| file.ok_or_else(|| Refused::RunMissing((*name).to_owned()));
        files.into_iter().zip(&names).map(missing).collect()
    }

    /// The weight of every run.
    fn weights(&self, setup: &Setup) -> Result<TiVec<RunId, f64>, Refused> {
        let mut weights: TiVec<RunId, Option<f64>> = ti_vec![None; setup.model.runs.len()];
        for given in &self.weights {
            let number = |(name, w): (&str, &str)| Some((setup.run(name), name.to_owned(), w.parse().ok()?));
            let usable = |w: &f64| (1.0 / MOST_WEIGHT..=MOST_WEIGHT).contains(w);
            match given.split_once('=').and_then(number).filter(|(.., w)| usable(w)) {
                Some((Some(run), name, weight)) if weights[run].replace(weight).is_some() => {
                    return Err(Refused::WeightTwice(name));
                }
                Some((Some(_), ..)) => {}
                Some((None, name, _)) => return Err(Refused::UnknownRun(name, run_names(setup).join(", "))),
                None => return Err(Refused::Weight(given.clone())),
            }
        }
        Ok(weights.into_iter().map(|w| w.unwrap_or(1.0)).collect())
    }

    fn observations(
        &self,
        setup: &Setup,
        radius: Radius,
        files: &TiSlice<RunId, Source>,
    ) -> Result<Vec<Observation>, Refused> {
        let weights = self.weights(setup)?;
        let table = self.table.as_deref().map(|file| known_table(setup, file)).transpose()?;
        let mut observations = Vec::new();
        for (run, (file, column)) in files.iter_enumerated() {
            let described = &setup.model.runs[run];
            let derived = &setup.derivation.runs[run];
            let least = derived.regressors.len() + 1;
            let angle = setup.model.alphabet.sweep_name(described.sweep);
            let mut channels = if *column == READING { vec![READING] } else { CHANNELS.to_vec() };
            channels.retain(|c| c != column);
            let sweep = Sweep::read_column(file, angle, column, &channels, radius, least)?;
            let mut known = vec![vec![0.0; derived.known.len()]; sweep.samples().len()];
            if let Some((table, functions)) = table.as_ref().filter(|_| !derived.known.is_empty()) {
                let at_samples = table.at_samples(&sweep)?;
                for (row, values) in known.iter_mut().zip(&at_samples.values) {
                    for (value, (f, _)) in row.iter_mut().zip(&derived.known) {
                        let at = functions.iter().position(|g| g == f);
                        *value = at.and_then(|at| values.get(at)).copied().unwrap_or(0.0);
                    }
                }
            }
            let samples = sweep.samples().iter().zip(known);
            let samples = samples.map(|(s, known)| Sample { sweep: s.angle_rad, reading: s.reading_mm, known });
            observations.push(Observation { run, weight: weights[run], samples: samples.collect() });
        }
        Ok(observations)
    }
}

/// A run's file and the column of its readings without the unit.
type Source = (PathBuf, &'static str);

/// The readings' column of a run with a file of its own.
const READING: &str = "dr";
/// The readings' columns of a file with all three displacements.
const CHANNELS: [&str; 3] = ["dx", "dy", "dz"];

/// Weights beyond this, or below its inverse, leave one of the runs without a say in double precision.
const MOST_WEIGHT: f64 = 1e9;

fn run_names(setup: &Setup) -> Vec<&str> {
    setup.model.runs.iter().map(|r| r.name.as_str()).collect()
}

/// The table of all known functions that the runs see, and which they are.
fn known_table(setup: &Setup, file: &Path) -> Result<(Table, Vec<FunctionId>), Refused> {
    let mut functions: Vec<FunctionId> =
        setup.derivation.runs.iter().flat_map(|r| r.known.iter().map(|(f, _)| *f)).collect();
    functions.sort_unstable();
    functions.dedup();
    let mut angle = "a";
    for (run, &f) in setup.model.runs.iter().flat_map(|r| functions.iter().map(move |f| (r, f))) {
        angle = setup.model.alphabet.sweep_name(run.sweep);
        let Some((axis, _)) = setup.model.axis_of(setup.model.functions[f].error) else { continue };
        let own = setup.model.alphabet.sweep_symbols(run.sweep)[0];
        let is_sweep = |c: &Coordinate| c.poly().is_none_or(|p| *p == trunnion_codegen::algebra::Poly::nominal(own));
        if !is_sweep(&run.at[axis]) {
            let axis = setup.model.axis(axis).map_or_else(String::new, |a| a.name.clone());
            return Err(Refused::TableCoordinate(known_name(&setup.model, f), axis));
        }
    }
    let known = |&f: &FunctionId| Known { name: known_name(&setup.model, f), quantity: setup.quantity(f) };
    Ok((Table::read(file, angle, &functions.iter().map(known).collect::<Vec<_>>())?, functions))
}
