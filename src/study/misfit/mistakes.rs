//! The usual mistakes, made undone one after another.

use super::noise::{Look, median_size};
use crate::study::estimate::fit;
use crate::study::fit::{Estimator, Observation, Sample};
use crate::study::setup::Setup;
use core::fmt;
use rayon::prelude::*;
use std::f64::consts::TAU;
use trunnion_codegen::quantity::Unit;

/// What may have gone wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Mistake {
    /// Samples at the beginning and the end of runs, from before and after the circle.
    FeedIn {
        /// What share of the samples at either end was left out.
        share: f64,
    },
    /// Single readings.
    Spikes(Vec<(String, f64)>),
    /// Two runs' files for each other.
    Swapped(String, String),
    /// A run in another unit: mm called µm, or µm called mm.
    Unit(String, f64),
    /// The angle counted the other way; of all runs without a name.
    Mirrored(Option<String>),
    /// The angle counted from elsewhere, rad; of all runs without a name.
    Shifted(Option<String>, f64),
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |run: &Option<String>| run.as_ref().map_or_else(|| "all runs".to_owned(), |run| format!("run {run}"));
        match self {
            Self::FeedIn { share } => {
                write!(
                    f,
                    "without {:.0} % of the samples at either end they fit: feed-in arcs or overshoot left in",
                    100.0 * share
                )
            }
            Self::Spikes(at) => {
                let each = at.iter().map(|(run, sweep)| format!("{run} at {:.1}°", sweep.to_degrees()));
                write!(f, "without single readings they fit: {}", each.collect::<Vec<_>>().join(", "))
            }
            Self::Swapped(a, b) => write!(f, "with the files of {a} and {b} for each other they fit"),
            Self::Unit(run, factor) => {
                write!(f, "with the readings of {run} times {factor} they fit: a wrong unit in the column's name")
            }
            Self::Mirrored(run) => write!(f, "with the angle of {} counted the other way they fit", of(run)),
            Self::Shifted(run, by) => {
                write!(f, "with {:+.1}° added to the angle of {} they fit", Unit::Deg.from_inner(*by), of(run))
            }
        }
    }
}

/// Samples of a run that are looked at where the whole run is changed.
const SAMPLES: usize = 90;
/// Steps of a turn in which a shift is looked for, and halvings after that.
const STEPS: usize = 48;
const HALVINGS: usize = 12;
/// A mistake explains data if its undoing leaves less than this of the residuals.
const EXPLAINS: f64 = 0.5;
/// Undoings that leave about as little are equally good: the first in the list of [`Mistake`]s is named.
const ALIKE: f64 = 1.2;
/// Single readings, at most.
const SPIKES: usize = 8;
/// Readings of two runs of one measurement are of one order; of runs in different units they are not.
const APART: f64 = 50.0;

/// The mistake that explains the data best.
pub fn explanation(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Option<Mistake> {
    if let Some(mistake) = spikes(setup, observations, estimator) {
        return Some(mistake);
    }
    let score = |observations: &[Observation]| left(setup, observations, estimator);
    let thinned: Vec<Observation> = observations.iter().map(thin).collect();
    let (whole, few) = (score(observations)?, score(&thinned)?);
    let mut tried: Vec<(Mistake, f64)> = Vec::new();
    for share in [0.02, 0.05, 0.1] {
        let trimmed: Vec<Observation> = observations.iter().map(|o| trim(o, share)).collect();
        tried.extend(score(&trimmed).map(|left| (Mistake::FeedIn { share }, left / whole)));
    }
    let undone = undone(setup, &thinned);
    let weighed: Vec<(Mistake, f64)> =
        undone.into_par_iter().filter_map(|(mistake, changed)| Some((mistake, score(&changed)? / few))).collect();
    let (shifts, others): (Vec<_>, Vec<_>) = weighed.into_iter().partition(|(m, _)| matches!(m, Mistake::Shifted(..)));
    tried.extend(others);
    let nearest = shifts.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    tried.extend(nearest.and_then(|(mistake, _)| refined(setup, &thinned, estimator, mistake, few)));
    let least = tried.iter().map(|(_, left)| *left).fold(f64::INFINITY, f64::min);
    let enough = |left: f64| left < EXPLAINS && left <= ALIKE * least;
    tried.into_iter().find(|(_, left)| enough(*left)).map(|(mistake, _)| mistake)
}

/// Root mean square of all residuals, mm.
fn left(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Option<f64> {
    let fitted = fit(setup, observations, estimator).ok()?;
    let samples = |o: &Observation| o.samples.len() as f64;
    let sum: f64 = fitted.rms.iter().zip(observations).map(|(rms, o)| rms * rms * samples(o)).sum();
    Some((sum / observations.iter().map(samples).sum::<f64>()).sqrt())
}

fn thin(observation: &Observation) -> Observation {
    let step = observation.samples.len().div_ceil(SAMPLES).max(1);
    Observation { samples: observation.samples.iter().step_by(step).cloned().collect(), ..observation.clone() }
}

fn trim(observation: &Observation, share: f64) -> Observation {
    let n = observation.samples.len();
    let cut = (share * n as f64).ceil() as usize;
    let samples = observation.samples.iter().take(n.saturating_sub(cut)).skip(cut).cloned().collect();
    Observation { samples, ..observation.clone() }
}

/// Takes the reading away that is furthest off, again and again, until what is left is noise.
fn spikes(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Option<Mistake> {
    let mut kept = observations.to_vec();
    let mut gone = Vec::new();
    for _ in 0..=SPIKES {
        let fitted = fit(setup, &kept, estimator).ok()?;
        let mut any = false;
        for o in &mut kept {
            let residuals = fitted.residuals(setup, o);
            if Look::at(&residuals).spikes.is_empty() {
                continue;
            }
            any = true;
            let furthest = (0..residuals.len()).max_by(|a, b| residuals[*a].abs().total_cmp(&residuals[*b].abs()))?;
            let sample = o.samples.remove(furthest);
            gone.push((setup.model.runs[o.run].name.clone(), sample.sweep));
        }
        if !any {
            let noise = kept.iter().all(|o| !Look::at(&fitted.residuals(setup, o)).has_memory());
            return (noise && !gone.is_empty()).then_some(Mistake::Spikes(gone));
        }
    }
    None
}

/// Observations with each mistake undone that concerns whole runs.
fn undone(setup: &Setup, observations: &[Observation]) -> Vec<(Mistake, Vec<Observation>)> {
    let name = |i: usize| setup.model.runs[observations[i].run].name.clone();
    let with = |i: Option<usize>, change: &dyn Fn(&mut Sample)| {
        let mut changed = observations.to_vec();
        let of = changed.iter_mut().enumerate().filter(|(k, _)| i.is_none_or(|i| i == *k));
        of.flat_map(|(_, o)| &mut o.samples).for_each(change);
        changed
    };
    let each = || std::iter::once(None).chain((0..observations.len()).map(Some));
    let mut all = Vec::new();
    for a in 0..observations.len() {
        for b in (a + 1..observations.len()).filter(|&b| observations[a].run != observations[b].run) {
            let mut swapped = observations.to_vec();
            let readings =
                |o: &Observation| o.samples.iter().map(|s| (s.sweep, s.direction, s.reading)).collect::<Vec<_>>();
            for (to, from) in [(a, readings(&observations[b])), (b, readings(&observations[a]))] {
                let known = swapped[to].samples.clone();
                let of = |(sweep, direction, reading): (f64, f64, f64)| {
                    // Known functions belong to the angle, not to the file.
                    let near = |s: &&Sample| (s.sweep - sweep).abs();
                    let at = known.iter().min_by(|x, y| near(x).total_cmp(&near(y)));
                    at.map(|s| Sample { sweep, direction, reading, ..s.clone() })
                };
                swapped[to].samples = from.into_iter().filter_map(of).collect();
            }
            all.push((Mistake::Swapped(name(a), name(b)), swapped));
        }
    }
    let sizes: Vec<f64> = observations.iter().map(|o| median_size(o.samples.iter().map(|s| s.reading))).collect();
    for (i, own) in sizes.iter().enumerate() {
        let others = sizes.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, s)| *s);
        let largest = others.fold(0.0, f64::max);
        let factor = if *own * APART < largest {
            1e3
        } else if *own > APART * largest {
            1e-3
        } else {
            continue;
        };
        all.push((Mistake::Unit(name(i), factor), with(Some(i), &|s| s.reading *= factor)));
    }
    for i in each() {
        all.push((Mistake::Mirrored(i.map(name)), with(i, &|s| (s.sweep, s.direction) = (-s.sweep, -s.direction))));
    }
    for i in each() {
        for step in 1..STEPS {
            let by = TAU * (step as f64 / STEPS as f64 - 0.5);
            if by != 0.0 {
                all.push((Mistake::Shifted(i.map(name), by), with(i, &|s| s.sweep += by)));
            }
        }
    }
    all
}

/// A shift between the steps.
fn refined(
    setup: &Setup,
    observations: &[Observation],
    estimator: Estimator,
    mistake: Mistake,
    whole: f64,
) -> Option<(Mistake, f64)> {
    let Mistake::Shifted(run, mut by) = mistake else { return None };
    let score = |by: f64| {
        let mut changed = observations.to_vec();
        let of = |o: &&mut Observation| run.as_ref().is_none_or(|run| *run == setup.model.runs[o.run].name);
        changed.iter_mut().filter(of).flat_map(|o| &mut o.samples).for_each(|s| s.sweep += by);
        left(setup, &changed, estimator).unwrap_or(f64::INFINITY)
    };
    let (mut step, mut least) = (TAU / STEPS as f64 / 2.0, score(by));
    for _ in 0..HALVINGS {
        for other in [by - step, by + step] {
            let own = score(other);
            if own < least {
                (by, least) = (other, own);
            }
        }
        step /= 2.0;
    }
    Some((Mistake::Shifted(run, by), least / whole))
}
