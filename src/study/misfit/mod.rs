//! Data that do not fit the model: residuals that are no noise, and the mistake that explains them.

mod mistakes;
mod noise;

pub use mistakes::Mistake;
pub use noise::Look;

use super::fit::{Fit, Observation};
use super::setup::Setup;

/// Runs whose residuals are no noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// Each: its name and its residuals.
    pub runs: Vec<(String, Look)>,
    /// The one mistake whose undoing makes all of them fit.
    pub mistake: Option<Mistake>,
    /// Known functions were taken as zero: they are in the residuals, and nothing else is looked for.
    pub without_table: bool,
}

/// Looks at the residuals of a fit; `dropped` is what linearisation usually drops of each observation's readings, mm;
/// `without_table` says that the known functions were taken as zero.
pub fn misfit(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    dropped: &[f64],
    without_table: bool,
) -> Option<Misfit> {
    let look = |o: &Observation| Look::at(&fit.residuals(setup, o));
    let looks = observations.iter().zip(dropped).map(|(o, dropped)| (o, look(o), *dropped));
    let odd = looks.filter(|(_, look, dropped)| !look.is_noise(*dropped));
    let runs: Vec<(String, Look)> = odd.map(|(o, look, _)| (setup.model.runs[o.run].name.clone(), look)).collect();
    if runs.is_empty() {
        return None;
    }
    let explained = || mistakes::explanation(setup, observations, fit.estimator);
    Some(Misfit { runs, mistake: if without_table { None } else { explained() }, without_table })
}

/// By how much the scatter of the readings tells less than as many independent ones would: a variance's factor.
pub fn alike(setup: &Setup, observations: &[Observation], fit: &Fit) -> f64 {
    observations.iter().map(|o| Look::at(&fit.residuals(setup, o)).alike()).fold(1.0, f64::max)
}
