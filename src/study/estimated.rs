//! The functions that a study asks for: how each follows from the readings, and over which coordinates.

use super::estimate::{EstimateError, fit};
use super::fit::{Estimator, Fit};
use super::observation::Observation;
use super::operator::{Operator, Profile};
use super::seen::Seen;
use super::setup::Setup;
use super::told::Told;
use super::visited::{between, visited};
use core::ops::Range;
use rayon::prelude::*;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::{FunctionId, RunId};
use typed_index_collections::TiVec;

/// Steps between the points at which a function's error is looked at.
const POINTS: usize = 1440;

/// What is asked, worked out on readings of zero: the estimate is linear in them.
pub(super) struct Estimated {
    /// How far each function that is asked for is determined.
    told: Vec<Told>,
    /// From readings to the coefficients of all that are seen.
    pub operator: Operator,
    /// Those that are seen.
    pub targets: Vec<Target>,
}

/// A function that is seen.
pub(super) struct Target {
    /// Which of those asked for.
    asked: usize,
    /// How it is seen.
    pub seen: Seen,
    /// The motion error.
    pub error: ErrorId,
    /// Where its coefficients are.
    pub range: Range<usize>,
    /// Its basis where its axis goes.
    pub profile: Profile,
}

/// Room for one trial.
pub(super) struct Room {
    /// Of all runs, with zeros behind the last one.
    pub readings: Vec<f64>,
    /// Coefficients from readings without noise.
    pub systematic: Vec<f64>,
    /// Coefficients from noise.
    pub random: Vec<f64>,
}

impl Estimated {
    /// From all runs at the given values of their sweep, rad.
    ///
    /// # Errors
    /// [`EstimateError`]
    pub fn new(
        setup: &Setup,
        sweeps: &TiVec<RunId, Vec<f64>>,
        asked: &[(Estimator, FunctionId)],
    ) -> Result<Self, EstimateError> {
        let observations: Vec<Observation> =
            sweeps.iter_enumerated().map(|(run, sweeps)| Observation::zero(setup, run, sweeps)).collect();
        let mut fits: Vec<Fit> = Vec::new();
        let (mut told, mut weights, mut targets) = (Vec::new(), Vec::new(), Vec::new());
        for (asked, &(estimator, function)) in asked.iter().enumerate() {
            let fit = match fits.iter().position(|fit| fit.estimator == estimator) {
                Some(at) => &fits[at],
                None => {
                    fits.push(fit(setup, &observations, estimator)?);
                    &fits[fits.len() - 1]
                }
            };
            let Some(seen) = fit.seen(function) else {
                return Err(EstimateError::NotEstimated(setup.function_name(function)));
            };
            told.push(seen.told(setup));
            if seen.extent() == Extent::NotSeen {
                continue;
            }
            let first = weights.len();
            weights.extend(fit.coefficient_sensitivities(setup, &observations, seen));
            let range = visited(setup, function, sweeps.iter_enumerated());
            let points: Vec<Vec<f64>> =
                range.into_iter().flat_map(|range| between(range, POINTS)).map(|x| seen.basis(setup, x)).collect();
            targets.push(Target {
                asked,
                seen: seen.clone(),
                error: setup.model.functions[function].error,
                range: first..weights.len(),
                profile: Profile::new(weights.len() - first, &points),
            });
        }
        let readings = sweeps.iter().map(Vec::len).sum();
        Ok(Self { told, operator: Operator::new(readings, weights), targets })
    }

    /// Results of many trials: `trial` writes one for each target, in room that it finds as another trial left it; none of what is
    /// not seen.
    pub fn trials<T: Clone + Copy + Default + Send>(
        &self,
        trials: u64,
        trial: impl Fn(&mut Room, u64, &mut [T]) + Sync,
    ) -> Vec<(Told, Vec<T>)> {
        let count = self.targets.len();
        let mut all = vec![T::default(); trials as usize * count];
        let room = || Room {
            readings: self.operator.readings(),
            systematic: self.operator.combinations(),
            random: self.operator.combinations(),
        };
        let one = |room: &mut Room, (n, own): (usize, &mut [T])| trial(room, n as u64, own);
        all.par_chunks_mut(count.max(1)).enumerate().for_each_init(room, one);
        let of = |asked: usize| {
            let target = self.targets.iter().position(|target| target.asked == asked);
            target.map_or(Vec::new(), |at| all.iter().skip(at).step_by(count).copied().collect())
        };
        self.told.iter().cloned().enumerate().map(|(asked, told)| (told, of(asked))).collect()
    }
}
