//! A drawn machine and its noisy readings: what `simulate`, `demo` and `monte-carlo` have in common.

use super::Refused;
use clap::Args;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trunnion::data::Unit;
use trunnion::study::{Limits, Machine, Observation, Setup, draw, grid};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::measurement::ExactReading;
use typed_index_collections::TiVec;

/// What is simulated.
#[derive(Clone, Copy, Debug, Args)]
pub struct Simulation {
    /// Seed of the random numbers: the same seed gives the same files.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Samples of each run.
    #[arg(long, default_value_t = 360)]
    pub samples: usize,
    /// Half width of the uniform noise of the readings, µm.
    #[arg(long, default_value_t = 0.1)]
    pub noise_um: f64,
    /// Largest length error, µm.
    #[arg(long, default_value_t = 30.0)]
    pub length_um: f64,
    /// Largest angle error, µrad.
    #[arg(long, default_value_t = 100.0)]
    pub angle_urad: f64,
    /// First angle, degrees.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub from_deg: f64,
    /// End of the range, degrees; the last sample is one step before it.
    #[arg(long, default_value_t = 360.0, allow_negative_numbers = true)]
    pub to_deg: f64,
}

/// Largest errors from the command line.
pub fn limits(length_um: f64, angle_urad: f64) -> Result<Limits, Refused> {
    not_negative("length-um", length_um)?;
    not_negative("angle-urad", angle_urad)?;
    Ok(Limits { length: length_um * Unit::Um.factor(), angle: angle_urad * Unit::Urad.factor() })
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

impl Simulation {
    /// Refuses what cannot be simulated.
    pub fn check(&self) -> Result<(), Refused> {
        not_negative("noise-um", self.noise_um)?;
        limits(self.length_um, self.angle_urad)?;
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
        Ok(())
    }

    /// First angle and end, rad.
    pub fn range(&self) -> (f64, f64) {
        (self.from_deg.to_radians(), self.to_deg.to_radians())
    }

    /// Limits of the errors.
    pub fn limits(&self) -> Limits {
        Limits { length: self.length_um * Unit::Um.factor(), angle: self.angle_urad * Unit::Urad.factor() }
    }

    /// The sweep at every sample, rad.
    pub fn sweeps(&self) -> Vec<f64> {
        grid(self.samples, (self.from_deg, self.to_deg)).into_iter().map(f64::to_radians).collect()
    }

    /// Draws a machine and measures it.
    pub fn measure(&self, setup: &Setup) -> Measured {
        let sweeps = self.sweeps();
        let exact: TiVec<RunId, ExactReading> = setup.model.runs.keys().map(|r| setup.exact(r, &sweeps)).collect();
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let machine = draw(setup, &exact.raw, self.limits(), &mut random);
        let mut noise = || random.random_range(-1.0..=1.0) * self.noise_um * Unit::Um.factor();
        let observe = |(run, exact)| setup.observe(run, exact, &sweeps, &machine, &mut noise);
        let observations = exact.iter_enumerated().map(observe).collect();
        Measured { machine, observations }
    }
}

/// A machine and what was read on it.
pub struct Measured {
    pub machine: Machine,
    pub observations: TiVec<RunId, Observation>,
}
