//! The largest error of estimated functions over many drawn machines, and where it comes from.

use super::draw::Population;
use super::estimate::EstimateError;
use super::estimated::{Estimated, Room};
use super::fit::Estimator;
use super::limits::ErrorLimits;
use super::noise::Noise;
use super::setup::Setup;
use super::told::Told;
use super::track::Tracks;
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use trunnion_codegen::ids::{FunctionId, RunId};
use typed_index_collections::TiVec;

/// What is drawn, and how often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draws {
    /// Number of machines.
    pub trials: u64,
    /// Samples of each run.
    pub samples: usize,
    /// First and last sweep, rad.
    pub range: (f64, f64),
    /// Bounds of the errors.
    pub limits: ErrorLimits,
    /// Half width of the uniform noise, mm.
    pub noise: f64,
    /// Machine n is drawn from stream n of this seed, whatever thread does it.
    pub seed: u64,
}

/// Largest error of the function over the range on one machine, in its own unit (mm or rad).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Trial {
    /// From noise alone: any linear model must give the same.
    pub noise: f64,
    /// From linearisation alone.
    pub linearisation: f64,
    /// From both.
    pub both: f64,
}

/// Draws machines, simulates all runs exactly, once for all that is asked, and estimates each function, or the sum it is seen in,
/// with its estimator: the largest errors, none where it is not seen. `done` is called after every machine.
///
/// # Errors
/// [`EstimateError`] if these runs over this range do not determine a function.
pub fn monte_carlo(
    setup: &Setup,
    draws: Draws,
    asked: &[(Estimator, FunctionId)],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<(Told, Vec<Trial>)>, EstimateError> {
    let sweeps = sweeps(setup, draws);
    let estimated = Estimated::new(setup, &sweeps, asked)?;
    let tracks = Tracks::new(setup, &sweeps);
    let machines = Population::new(setup, tracks.exact(), draws.limits);
    let noise = Noise::new(draws.seed, draws.noise);
    let samples = tracks.samples();
    let trial = |room: &mut Room, n: u64, trials: &mut [Trial]| {
        let mut random = ChaCha8Rng::seed_from_u64(draws.seed);
        random.set_stream(n);
        let machine = machines.draw(&mut random);
        tracks.read(&machine, &mut room.readings[..samples]);
        tracks.explain(&machine, &mut room.readings[..samples]);
        estimated.operator.apply(&room.readings, &mut room.systematic);
        noise.fill(n, &mut room.readings[..samples]);
        estimated.operator.apply(&room.readings, &mut room.random);
        let parameters = machine.parameters(setup);
        for (target, trial) in estimated.targets.iter().zip(trials) {
            let (noise, off) = (&room.random[target.range.clone()], &mut room.systematic[target.range.clone()]);
            let truth = target.seen.coefficients(machine.factors(target.error), &parameters);
            off.iter_mut().zip(truth).for_each(|(off, truth)| *off -= truth);
            let [from_noise, from_model] = [noise, off].map(|part| target.profile.largest(part));
            off.iter_mut().zip(noise).for_each(|(off, noise)| *off += noise);
            *trial = Trial { noise: from_noise, linearisation: from_model, both: target.profile.largest(off) };
        }
        done();
    };
    Ok(estimated.trials(draws.trials, trial))
}

/// The largest errors from noise alone, as [`monte_carlo`] has them: no machine is drawn for them.
///
/// # Errors
/// [`EstimateError`]
pub fn noise_alone(
    setup: &Setup,
    draws: Draws,
    asked: &[(Estimator, FunctionId)],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<(Told, Vec<f64>)>, EstimateError> {
    let sweeps = sweeps(setup, draws);
    let estimated = Estimated::new(setup, &sweeps, asked)?;
    let noise = Noise::new(draws.seed, draws.noise);
    let samples = sweeps.iter().map(Vec::len).sum();
    let trial = |room: &mut Room, n: u64, largest: &mut [f64]| {
        noise.fill(n, &mut room.readings[..samples]);
        estimated.operator.apply(&room.readings, &mut room.random);
        for (target, largest) in estimated.targets.iter().zip(largest) {
            *largest = target.profile.largest(&room.random[target.range.clone()]);
        }
        done();
    };
    Ok(estimated.trials(draws.trials, trial))
}

fn sweeps(setup: &Setup, draws: Draws) -> TiVec<RunId, Vec<f64>> {
    setup.model.runs.keys().map(|run| setup.swept(run, draws.samples, draws.range)).collect()
}
