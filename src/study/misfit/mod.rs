//! Data that do not fit the model: residuals that are no noise, and the mistake that explains them.

mod mistakes;
mod noise;

pub use mistakes::Mistake;
pub use noise::Look;
pub(super) use noise::{Looking, Sizes};

use super::called::called;
use super::fit::{Fit, Observation};
use super::setup::Setup;

/// Residuals this many times the stated noise are more than it: of the noise of a hundred readings one in a million is.
const MORE: f64 = 1.4;

/// Residuals of a run that are no noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Odd {
    /// The run, with the number of the time where it was measured several times.
    pub run: String,
    /// Its residuals.
    pub look: Look,
    /// How many times the stated noise they are, where that is stated.
    pub times: Option<f64>,
}

/// Runs whose residuals are no noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// Each of them.
    pub runs: Vec<Odd>,
    /// The one mistake whose undoing makes all of them fit.
    pub mistake: Option<Mistake>,
    /// Known functions were taken as zero: they are in the residuals, and nothing else is looked for.
    pub without_table: bool,
    /// The fit is one of a factor: mistakes are looked for in samples, which it does not have.
    pub of_factor: bool,
}

/// Looks at the residuals of a fit; `dropped` is what linearisation usually drops of each observation's readings, `noise` the
/// stated standard deviation of a reading, mm (0 for none); `without_table` says that the known functions were taken as zero.
pub fn misfit(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    dropped: &[f64],
    noise: f64,
    without_table: bool,
) -> Option<Misfit> {
    let odd = |(at, (look, dropped)): (usize, (&Look, &f64))| {
        let times = (noise > 0.0).then(|| look.rms / noise.hypot(*dropped));
        let is_noise = look.is_noise(*dropped) && times.is_none_or(|times| times <= MORE);
        (!is_noise).then(|| Odd { run: called(setup, observations, at), look: look.clone(), times })
    };
    let runs: Vec<Odd> = fit.looks.iter().zip(dropped).enumerate().filter_map(odd).collect();
    if runs.is_empty() {
        return None;
    }
    let explained = || mistakes::explanation(setup, observations, fit.estimator);
    let of_factor = fit.of_factor;
    Some(Misfit {
        runs,
        mistake: if without_table || of_factor { None } else { explained() },
        without_table,
        of_factor,
    })
}

/// By how much the scatter of the readings tells less than as many independent ones would: a variance's factor.
pub fn alike(fit: &Fit) -> f64 {
    fit.looks.iter().map(Look::alike).fold(1.0, f64::max)
}
