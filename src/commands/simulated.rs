//! What is simulated, as `simulate` and `monte-carlo` take it.

use super::Refused;
use super::model::ModelArguments;
use super::number;
use super::predicted;
use super::stated::{LimitArguments, RangeArguments};
use clap::Args;
use trunnion::data::Source;
use trunnion::data::limits::{SAMPLES, SIMULATED};
use trunnion::study::{Setup, Simulation};

/// What is simulated.
#[derive(Clone, Debug, Args)]
pub struct SimulationArguments {
    /// Seed of the random numbers: the same seed gives the same files.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Samples of each run.
    #[arg(long, default_value_t = 360, value_parser = number::count::<1, { SIMULATED as u32 }>, allow_negative_numbers = true)]
    samples: u32,
    /// Half width of the uniform noise of the readings, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.1, value_parser = number::noise, allow_negative_numbers = true)]
    noise_um: f64,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    ranges: RangeArguments,
    /// Range of the sweeps, degrees; the last sample is one step before its end. The full turn without it; where an axis has a
    /// range, runs then go as far as it lets them.
    #[arg(long, value_name = "A:B", value_parser = predicted::range, allow_hyphen_values = true, conflicts_with_all = ["from_deg", "to_deg"])]
    range_deg: Option<(f64, f64)>,
    /// Its beginning alone.
    #[arg(long, value_name = "DEG", hide = true, value_parser = number::angle, allow_negative_numbers = true)]
    from_deg: Option<f64>,
    /// Its end alone.
    #[arg(long, value_name = "DEG", hide = true, value_parser = number::angle, allow_negative_numbers = true)]
    to_deg: Option<f64>,
}

impl SimulationArguments {
    /// As [`SimulationArguments::simulation`], with no more samples than are kept.
    pub fn kept(&self, model: &ModelArguments, source: &Source) -> Result<(Setup, Simulation), Refused> {
        let (setup, simulation) = self.simulation(model, source)?;
        let runs = setup.model.runs.len();
        match simulation.samples * runs > SAMPLES {
            true => Err(Refused::Samples(self.samples, SAMPLES / runs.max(1), runs)),
            false => Ok((setup, simulation)),
        }
    }

    /// The model with the ranges of its axes, and what is asked for, where it can be simulated.
    pub fn simulation(&self, model: &ModelArguments, source: &Source) -> Result<(Setup, Simulation), Refused> {
        let given = match (self.range_deg, self.from_deg, self.to_deg) {
            (None, None, None) => None,
            (range, from, to) => Some(range.unwrap_or((from.unwrap_or(0.0), to.unwrap_or(360.0)))),
        };
        let (from, to) = given.unwrap_or((0.0, 360.0));
        if to <= from {
            return Err(Refused::Option(
                "to-deg",
                to.to_string(),
                "not beyond the range's beginning\n  expected an angle beyond --from-deg",
            ));
        }
        let setup = model.setup(source, |model| self.ranges.apply(model))?;
        let (limits, range_deg) = (self.limits.limits(&setup), (from, to));
        let &Self { seed, samples, noise_um, .. } = self;
        let simulation = Simulation { seed, samples: samples as usize, noise_um, limits, range_deg };
        if given.is_some() {
            setup.model.runs.keys().try_for_each(|run| setup.reaches(run, simulation.range()))?;
        }
        Ok((setup, simulation))
    }
}
