//! Positions proposed for what is asked, beside those that are spread evenly.

use super::candidates::{Candidates, unread};
use super::exchange::{First, Held};
use crate::study::plan::{Prediction, RotaryAxis, predict_at, rotary_axes};
use crate::study::{EstimateError, Estimator, Measurement, Setup};
use std::f64::consts::TAU;
use thiserror::Error;
use trunnion_codegen::ids::FunctionId;

/// Rounding of a sweep at the end of its range, degrees.
const SLACK: f64 = 1e-6;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The functions that positions are for.
    pub functions: Vec<FunctionId>,
    /// How many positions.
    pub count: Count,
    /// Positions to choose from: the multiples of this, degrees, and the ends of where a run can go.
    pub step_deg: f64,
    /// Standard deviation of a reading, mm.
    pub sigma: f64,
}

/// How many positions.
#[derive(Clone, Debug, PartialEq)]
pub enum Count {
    /// So many of each run.
    Each(usize),
    /// So many of all runs together, of each as many at least as a fit asks for.
    InAll(usize),
    /// The fewest of all runs together that make each function as certain as this: expanded, 95 %, from noise; mm or rad.
    Fewest(Vec<f64>),
}

impl Count {
    /// The fewest that make each function as certain as `within` (µm or µrad) says: one number for all, or one for each; none of
    /// another number of them.
    pub fn fewest(setup: &Setup, functions: &[FunctionId], within: &[f64]) -> Option<Self> {
        let fits = within.len() == functions.len() || within.len() == 1;
        let own = |(i, f): (usize, &FunctionId)| {
            let within = within.get(i).or(within.first())?;
            Some(setup.quantity(*f).deviation().to_inner(*within))
        };
        fits.then(|| Self::Fewest(functions.iter().enumerate().filter_map(own).collect()))
    }
}

/// Why nothing is proposed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PositionsError {
    /// More than there are to choose from.
    #[error("{wanted} positions of {of}: {found} to choose from\n  expected fewer, or a smaller step between them")]
    TooMany {
        /// How many are asked for.
        wanted: usize,
        /// Of which run, or of all.
        of: String,
        /// How many there are.
        found: usize,
    },
    /// Fewer than a fit asks for.
    #[error("{wanted} positions of {of}\n  expected {least} at least")]
    TooFew {
        /// How many are asked for.
        wanted: usize,
        /// Of which run, or of all.
        of: String,
        /// How many it takes.
        least: usize,
    },
    /// All positions together do not make a function certain enough.
    #[error(
        "{name}: all {found} positions together do not give that\n  expected more uncertainty, less noise, or a smaller step"
    )]
    NotReached {
        /// The function.
        name: String,
        /// How many there are.
        found: usize,
    },
    /// Such positions give no estimate.
    #[error(transparent)]
    Estimate(#[from] EstimateError),
}

/// Positions that are proposed, and what they are held against.
#[derive(Clone, Debug)]
pub struct Proposed {
    /// The runs.
    pub measurements: Vec<Measurement>,
    /// As many, spread evenly.
    pub evenly: Chosen,
    /// Those that are proposed.
    pub proposed: Chosen,
}

impl Proposed {
    /// What the evenly spread ones and the proposed ones would give of the rotary axes, the same axes in either.
    pub fn axes(&self, setup: &Setup, asked: &Asked) -> [Vec<RotaryAxis>; 2] {
        [&self.evenly, &self.proposed].map(|own| rotary_axes(setup, &own.prediction, &asked.functions, asked.sigma))
    }
}

/// Positions of each run.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// Of each run the sweeps, rad, ascending.
    pub positions: Vec<Vec<f64>>,
    /// What they would give, each function over all that the runs can reach.
    pub prediction: Prediction,
}

/// Proposes positions of all runs of a model.
///
/// Of as many positions, none of the functions is less certain than by those spread evenly; the one that gains least gains as much as
/// exchanging single positions can make it.
///
/// # Errors
/// [`PositionsError`]
pub fn propose(setup: &Setup, asked: &Asked) -> Result<Proposed, PositionsError> {
    let measurements = setup.measurements();
    let grid: Vec<Vec<f64>> = measurements.iter().map(|own| stops(setup, own, asked.step_deg)).collect();
    let all: usize = grid.iter().map(Vec::len).sum();
    let candidates = Candidates::new(setup, &measurements, &grid, &asked.functions)?;
    let least = measurements.iter().map(|own| setup.least(&own.runs)).collect();
    let search = Search { setup, measurements: &measurements, grid: &grid, least, candidates: &candidates, asked };
    let (evenly, proposed) = match &asked.count {
        Count::Each(count) => {
            let counts = vec![*count; measurements.len()];
            search.of(&counts, &counts, None)?
        }
        Count::InAll(count) => search.in_all(*count, None)?,
        Count::Fewest(within) => {
            let least = search.chosen(grid.clone())?;
            if let Some(name) = search.beyond(&least, within) {
                return Err(PositionsError::NotReached { name, found: all });
            }
            // More positions never know less.
            let (mut low, mut high) = (search.least.iter().sum(), all);
            while low < high {
                let half = usize::midpoint(low, high);
                let enough =
                    search.in_all(half, Some(within)).is_ok_and(|(_, own)| search.beyond(&own, within).is_none());
                if enough { high = half } else { low = half + 1 }
            }
            search.in_all(high, Some(within))?
        }
    };
    Ok(Proposed { measurements, evenly, proposed })
}

/// Where a run can stop: at multiples of a step, and at the ends of what of a turn its axes can reach.
fn stops(setup: &Setup, measurement: &Measurement, step_deg: f64) -> Vec<f64> {
    let Some(run) = measurement.first() else { return Vec::new() };
    let (from, to) = setup.sweep_range(run, (0.0, TAU));
    let (low, high) = (from.to_degrees(), to.to_degrees());
    let is_turn = to - from >= TAU - 1e-9;
    let (first, last) = (((low - SLACK) / step_deg).ceil() as i64, ((high + SLACK) / step_deg).floor() as i64);
    let mut all: Vec<f64> = (first..=last).map(|i| i as f64 * step_deg).collect();
    if all.first().is_none_or(|own| own - low > SLACK) {
        all.insert(0, low);
    }
    if all.last().is_none_or(|own| high - own > SLACK) {
        all.push(high);
    }
    if is_turn {
        // Its end is its beginning.
        all.pop();
    }
    all.into_iter().map(f64::to_radians).collect()
}

fn within_what_there_is(of: &str, wanted: usize, least: usize, found: usize) -> Result<(), PositionsError> {
    let of = of.to_owned();
    match wanted {
        _ if wanted > found => Err(PositionsError::TooMany { wanted, of, found }),
        _ if wanted < least => Err(PositionsError::TooFew { wanted, of, least }),
        _ => Ok(()),
    }
}

struct Search<'a> {
    setup: &'a Setup,
    measurements: &'a [Measurement],
    grid: &'a [Vec<f64>],
    /// Of each run.
    least: Vec<usize>,
    candidates: &'a Candidates<'a>,
    asked: &'a Asked,
}

impl Search<'_> {
    /// So many of all runs together.
    fn in_all(&self, count: usize, within: Option<&[f64]>) -> Result<(Chosen, Chosen), PositionsError> {
        let (least, found) = (self.least.iter().sum(), self.candidates.len());
        within_what_there_is("all runs", count, least, found)?;
        // As even as their least numbers and their numbers of candidates let them be.
        let mut counts = self.least.clone();
        (least..count).for_each(|_| {
            let open = (0..counts.len()).filter(|i| counts[*i] < self.grid[*i].len());
            open.min_by_key(|i| (counts[*i], *i)).into_iter().for_each(|i| counts[i] += 1);
        });
        self.of(&counts, &self.least, within)
    }

    /// So many of each run to begin with: spread evenly, and exchanged.
    fn of(
        &self,
        counts: &[usize],
        least: &[usize],
        within: Option<&[f64]>,
    ) -> Result<(Chosen, Chosen), PositionsError> {
        for (at, count) in counts.iter().enumerate() {
            let of = format!("run {}", self.measurements[at].name);
            within_what_there_is(&of, *count, self.least[at], self.grid[at].len())?;
        }
        let spread =
            |(own, count): (&Measurement, &usize)| own.first().map_or(Vec::new(), |run| self.setup.evenly(run, *count));
        let evenly: Vec<Vec<f64>> = self.measurements.iter().zip(counts).map(spread).collect();
        let even = self.chosen(evenly.clone())?;
        let known = self.candidates.known_at(&evenly);
        let stds = known.stds();
        let against = within.map(<[f64]>::to_vec).or(stds).unwrap_or_default();
        let held = Held { candidates: self.candidates, against: &against, least, first: First::Largest };
        let count = counts.iter().sum();
        let smooth = Held { first: First::Mean, ..held };
        let from = [self.nearest(&evenly), held.dropped(count), smooth.dropped(count)];
        let exchanged =
            from.into_iter().flat_map(|set| [set.clone(), smooth.exchanged(set)]).map(|set| held.exchanged(set));
        let graded = |set: &Vec<usize>| held.graded(self.candidates.known(set.iter().copied()).stds());
        let best = exchanged.min_by_key(|set| (graded(set), set.clone())).unwrap_or_default();
        if within.is_none() && graded(&best) > held.graded(known.stds()) {
            return Ok((even.clone(), even));
        }
        let mut positions = vec![Vec::new(); self.measurements.len()];
        for (run, sweep) in best.into_iter().map(|i| self.candidates.place(i)) {
            positions[run].push(sweep);
        }
        Ok((even, self.chosen(positions)?))
    }

    /// The candidates nearest to positions, none twice.
    fn nearest(&self, positions: &[Vec<f64>]) -> Vec<usize> {
        let mut chosen: Vec<usize> = Vec::new();
        for (run, own) in positions.iter().enumerate() {
            for sweep in own {
                let free =
                    (0..self.candidates.len()).filter(|i| self.candidates.place(*i).0 == run && !chosen.contains(i));
                // In millionths of a degree: of those as near the first.
                let far = |i: &usize| ((self.candidates.place(*i).1 - sweep).abs().to_degrees() * 1e6).round() as i64;
                chosen.extend(free.min_by_key(|i| (far(i), *i)));
            }
        }
        chosen
    }

    /// What positions would give.
    fn chosen(&self, positions: Vec<Vec<f64>>) -> Result<Chosen, EstimateError> {
        let [own, along] = [positions.as_slice(), self.grid].map(|at| unread(self.setup, self.measurements, at));
        let prediction = predict_at(self.setup, &own, &along, self.asked.sigma, Estimator::Joint)?;
        Ok(Chosen { positions, prediction })
    }

    /// The first function that is less certain than it should be.
    fn beyond(&self, chosen: &Chosen, within: &[f64]) -> Option<String> {
        let of = |f: &FunctionId| chosen.prediction.functions.iter().find(|own| own.function == *f)?.largest;
        let is = |(f, within): &(&FunctionId, &f64)| of(f).is_none_or(|largest| largest.u95 > **within);
        let first = self.asked.functions.iter().zip(within).find(is);
        first.map(|(f, _)| self.setup.function_name(*f))
    }
}
