//! What is simulated, as `simulate` and `monte-carlo` take it.

use super::Refused;
use clap::Args;
use trunnion::study::{ErrorLimits, Simulation};

/// What is simulated.
#[derive(Clone, Copy, Debug, Args)]
pub struct SimulationArguments {
    /// Seed of the random numbers: the same seed gives the same files.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Samples of each run.
    #[arg(long, default_value_t = 360)]
    samples: usize,
    /// Half width of the uniform noise of the readings, µm.
    #[arg(long, default_value_t = 0.1)]
    noise_um: f64,
    /// Largest length error, µm.
    #[arg(long, default_value_t = 30.0)]
    length_um: f64,
    /// Largest angle error, µrad.
    #[arg(long, default_value_t = 100.0)]
    angle_urad: f64,
    /// First angle, degrees.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    from_deg: f64,
    /// End of the range, degrees; the last sample is one step before it.
    #[arg(long, default_value_t = 360.0, allow_negative_numbers = true)]
    to_deg: f64,
}

/// Largest errors from the command line.
pub fn limits(length_um: f64, angle_urad: f64) -> Result<ErrorLimits, Refused> {
    not_negative("length-um", length_um)?;
    not_negative("angle-urad", angle_urad)?;
    Ok(ErrorLimits::scaled(length_um, angle_urad))
}

/// Refuses what is no size of a noise or an error.
pub fn not_negative(option: &'static str, value: f64) -> Result<(), Refused> {
    match value.is_finite() && (0.0..=1e4).contains(&value) {
        true => Ok(()),
        false => Err(Refused::Option(option, value.to_string(), "expected a number from 0 to 10000")),
    }
}

/// Most samples of one run.
const MOST_SAMPLES: usize = 10_000_000;

impl SimulationArguments {
    /// What is asked for, where it can be simulated.
    pub fn simulation(&self) -> Result<Simulation, Refused> {
        not_negative("noise-um", self.noise_um)?;
        let limits = limits(self.length_um, self.angle_urad)?;
        for (option, value) in [("from-deg", self.from_deg), ("to-deg", self.to_deg)] {
            if !(value.is_finite() && value.abs() <= 3600.0) {
                return Err(Refused::Option(option, value.to_string(), "expected an angle within ten turns"));
            }
        }
        if self.to_deg <= self.from_deg {
            return Err(Refused::Option("to-deg", self.to_deg.to_string(), "expected an angle beyond --from-deg"));
        }
        if !(1..=MOST_SAMPLES).contains(&self.samples) {
            return Err(Refused::Option("samples", self.samples.to_string(), "expected a number from 1 to 10000000"));
        }
        Ok(Simulation {
            seed: self.seed,
            samples: self.samples,
            noise_um: self.noise_um,
            limits,
            range_deg: (self.from_deg, self.to_deg),
        })
    }
}
