//! An estimated function for either direction of its axis: its hysteresis as a function of the coordinate.
//!
//! With side = ±1 as the axis' coordinate x increases or decreases, the error is f(x) + side·h(x), and a reading
//!
//! ```text
//! Σ regressor · base + side · ∂reading/∂error · (h₀ + Σ hⱼ φⱼ(x))
//! ```
//!
//! with the functions φ of the basis of f. Nothing else turns with the direction but what the runs' `nuisance` names: balls and bar
//! were not touched between the directions.

use super::budget::{COVERAGE, Combined, Contribution, combine};
use super::fill::places;
use super::fit::{Fit, Sample};
use super::misfit::Looking;
use super::problem::columns;
use super::recording::Recording;
use super::rows::{Rows, Taken, blocks};
use super::setup::Setup;
use super::warning::WARN_CONDITION;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;
use thiserror::Error;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::graph::{LANES, Lanes};
use trunnion_codegen::ids::{AxisId, FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_solver::sized::{self, Block, Column, ROWS};

/// Of the coordinates that were visited, the share that either direction has to go over.
const SHARE: f64 = 0.9;
/// Coordinates this near are one, mm or rad.
const SAME: f64 = 1e-9;
/// Half the step of a derivative with respect to an error, mm or rad, and to a sweep, rad.
const STEP: f64 = 1e-4;

/// A function's hysteresis.
#[derive(Clone, Debug)]
pub struct ByDirection {
    function: FunctionId,
    /// Base parameters in the order of the fit, then h₀ and each hⱼ.
    values: DVector<f64>,
    /// From the scatter about both directions, so many readings standing for an independent one as are alike.
    covariance: DMatrix<f64>,
    /// Degrees of freedom of that.
    pub degrees_of_freedom: u32,
}

/// The expanded uncertainty of a function's value, 95 %, mm or rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sided {
    /// Where the axis' coordinate increases.
    pub forward: f64,
    /// Where it decreases.
    pub reverse: f64,
    /// Of the mean of both.
    pub mean: f64,
}

/// Why the directions are not told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NotByDirection {
    /// They were not measured.
    #[error("one direction was measured, or part of the other, or lines in no order")]
    OneDirection,
    /// The readings do not separate the hysteresis from what else turns with the direction.
    #[error(
        "these runs do not tell its hysteresis from what else turns with the direction, such as its backlash in `nuisance`"
    )]
    Confounded,
    /// The fit weighs readings down.
    #[error("a robust fit does not tell directions apart")]
    Robust,
}

/// Recordings that cannot be read again, or directions that are not told apart.
pub enum Failing<E> {
    /// They are not told apart.
    Not(NotByDirection),
    /// They cannot be read.
    Recording(E),
}

impl<E> From<NotByDirection> for Failing<E> {
    fn from(not: NotByDirection) -> Self {
        Self::Not(not)
    }
}

/// A machine that has one error, the same everywhere.
struct Only(ErrorId, f64);

impl ErrorValues for Only {
    fn value(&self, error: ErrorId, _: f64) -> f64 {
        if error == self.0 { self.1 } else { 0.0 }
    }
}

/// What the function adds to a run's rows.
struct Turning<'a> {
    setup: &'a Setup,
    run: RunId,
    function: FunctionId,
    axis: AxisId,
}

impl Turning<'_> {
    /// The axis' coordinate at each sample and the side of it: ±1, or 0 where it turns round or is not known.
    fn sides(&self, taken: &[Taken]) -> Vec<(f64, f64)> {
        let along = |by: f64| {
            let sweeps: Vec<f64> = taken.iter().map(|t| t.sweep + by).collect();
            self.setup.coordinates(self.run, self.axis, &sweeps)
        };
        let [before, at, behind] = [-STEP, 0.0, STEP].map(along);
        let sense = |(t, moved): (&Taken, f64)| if moved == 0.0 { 0.0 } else { t.direction * moved.signum() };
        let moved = behind.iter().zip(&before).map(|(b, a)| b - a);
        at.into_iter().zip(taken.iter().zip(moved).map(sense)).collect()
    }

    /// side · ∂reading/∂error · (1, φ₁, …): a column for each.
    fn columns(&self, rows: &Rows, functions: usize) -> Vec<Lanes> {
        let taken = rows.taken();
        let mut columns = vec![[0.0; LANES]; functions];
        let sweeps: Vec<f64> = taken.iter().map(|t| t.sweep).collect();
        let exact = self.setup.exact(self.run, &sweeps);
        let error = self.setup.model.functions[self.function].error;
        let by = |size: f64| exact.values(&Only(error, size)).collect::<Vec<_>>();
        let slopes = by(STEP).into_iter().zip(by(-STEP)).map(|(more, less)| (more - less) / (2.0 * STEP));
        for (lane, (slope, (x, side))) in slopes.zip(self.sides(taken)).enumerate() {
            let basis = self.setup.basis(self.function, x);
            let values = std::iter::once(1.0).chain(basis.iter().copied());
            columns.iter_mut().zip(values).for_each(|(column, value)| column[lane] = side * slope * value);
        }
        columns
    }
}

/// From rows of a run to columns of the problem.
struct Filling<'a> {
    turning: Turning<'a>,
    /// Where the axis turns round, if it moves.
    ends: Option<(f64, f64)>,
    /// Where each regressor is in the block, and each of the hysteresis' functions.
    places: Vec<Option<usize>>,
    halves: Vec<Option<usize>>,
    block: Vec<Column<f64>>,
    y: Column<f64>,
    /// The sweep before.
    last: Option<f64>,
}

impl Filling<'_> {
    /// Fills the block with the samples whose side is known, and gives their number.
    fn fill(&mut self, rows: &Rows) -> usize {
        let kept = self.known(rows.taken());
        let Self { block, y, .. } = self;
        block.iter_mut().for_each(|column| column.fill(0.0));
        let take = |into: &mut Column<f64>, values: &Lanes| {
            into.iter_mut().zip(&kept).for_each(|(into, lane)| *into = values[*lane]);
        };
        let mut put = |at: &Option<usize>, values: &Lanes| {
            if let Some(at) = at {
                take(&mut block[*at], values);
            }
        };
        rows.regressors().zip(&self.places).for_each(|(values, at)| put(at, values));
        if self.ends.is_some() {
            let columns = self.turning.columns(rows, self.halves.len());
            columns.iter().zip(&self.halves).for_each(|(values, at)| put(at, values));
        }
        y.fill(0.0);
        take(y, &rows.explained());
        kept.len()
    }

    /// The samples whose side is known: not those where the axis turns round, which without having moved may be of either.
    fn known(&mut self, taken: &[Taken]) -> Vec<usize> {
        let Some((low, high)) = self.ends else { return (0..taken.len()).collect() };
        let mut is_known = |(t, (x, side)): (&Taken, (f64, f64))| {
            let rests = self.last.replace(t.sweep) == Some(t.sweep);
            let at_an_end = x - low < SAME || high - x < SAME;
            side != 0.0 && !(rests && at_an_end)
        };
        let known: Vec<bool> = taken.iter().zip(self.turning.sides(taken)).map(&mut is_known).collect();
        (0..taken.len()).filter(|lane| known[*lane]).collect()
    }
}

/// First and last coordinate that either direction reaches.
type Reached = [(f64, f64); 2];

fn reached<R: Recording>(
    setup: &Setup,
    recordings: &[R],
    function: FunctionId,
    axis: AxisId,
) -> Result<Reached, R::Error> {
    let mut reached = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    for recording in recordings.iter().filter(|own| moves(setup, own.run(), axis)) {
        let turning = Turning { setup, run: recording.run(), function, axis };
        blocks(
            setup,
            recording,
            |_: &Sample| {},
            |rows| {
                for (x, side) in turning.sides(rows.taken()).into_iter().filter(|(_, side)| *side != 0.0) {
                    let (low, high) = &mut reached[usize::from(side < 0.0)];
                    (*low, *high) = (low.min(x), high.max(x));
                }
            },
        )?;
    }
    Ok(reached)
}

fn moves(setup: &Setup, run: RunId, axis: AxisId) -> bool {
    setup.model.runs[run].at[axis].poly().is_some()
}

/// Fits a function's hysteresis beside all that `fit`, of the same recordings, has.
///
/// # Errors
/// [`Failing`]
pub fn by_direction<R: Recording>(
    setup: &Setup,
    recordings: &[R],
    fit: &Fit,
    function: FunctionId,
) -> Result<ByDirection, Failing<R::Error>> {
    if !fit.weighed_down.is_empty() {
        return Err(NotByDirection::Robust.into());
    }
    let (axis, _) = setup.model.axis_of(setup.model.functions[function].error).ok_or(NotByDirection::OneDirection)?;
    let reached = reached(setup, recordings, function, axis).map_err(Failing::Recording)?;
    let length = |(low, high): (f64, f64)| high - low;
    let ends = (reached[0].0.min(reached[1].0), reached[0].1.max(reached[1].1));
    if !reached.iter().all(|own| length(*own) >= SHARE * length(ends) && length(ends) > 0.0) {
        return Err(NotByDirection::OneDirection.into());
    }
    let own = setup.basis(function, 0.0).len() + 1;
    let known = fit.base.len();
    let runs: Vec<RunId> = recordings.iter().map(Recording::run).collect();
    let mut of = columns(setup, &runs, fit.estimator);
    // The runs that see the function are those of the last step.
    let added = if of.own.is_empty() { &mut of.first } else { &mut of.own };
    added.extend(known..known + own);
    let mut problem = sized::estimator(&of).ok_or(NotByDirection::Confounded)?;
    let mut refused = false;
    let filling = |run: RunId, order: &[usize]| {
        let half = |column| order.iter().position(|at| *at == column);
        Filling {
            turning: Turning { setup, run, function, axis },
            ends: moves(setup, run, axis).then_some(ends),
            places: places(setup, run, &fit.base, order),
            halves: (known..known + own).map(half).collect(),
            block: vec![[0.0; ROWS]; order.len()],
            y: [0.0; ROWS],
            last: None,
        }
    };
    for (recording, &step) in recordings.iter().zip(&fit.steps) {
        let mut filling = filling(recording.run(), &of.of(step));
        let take = |rows: &Rows| {
            let samples = filling.fill(rows);
            let pushed = Block { columns: &mut filling.block, y: &mut filling.y };
            refused |= problem.push(step, pushed, samples, recording.weight()).is_err();
        };
        blocks(setup, recording, |_: &Sample| {}, take).map_err(Failing::Recording)?;
    }
    let solved = problem.solve(None).map_err(|_| NotByDirection::Confounded)?;
    if refused || solved.condition.0 > WARN_CONDITION.max(3.0 * fit.separation.condition) {
        return Err(NotByDirection::Confounded.into());
    }
    // The residuals of a run one after the other, in one recording or in several.
    let mut residuals: BTreeMap<RunId, Looking> = BTreeMap::new();
    for (recording, &step) in recordings.iter().zip(&fit.steps) {
        let order = of.of(step);
        let mut filling = filling(recording.run(), &order);
        let looking = residuals.entry(recording.run()).or_default();
        let look = |rows: &Rows| {
            for row in 0..filling.fill(rows) {
                let explained =
                    filling.block.iter().zip(&order).map(|(column, at)| column[row] * solved.coefficients[*at]);
                looking.add(filling.y[row] - explained.sum::<f64>());
            }
        };
        blocks(setup, recording, |_: &Sample| {}, look).map_err(Failing::Recording)?;
    }
    let alike = residuals.values().map(|looking| looking.look().alike()).fold(1.0, f64::max);
    Ok(ByDirection {
        function,
        values: solved.coefficients,
        covariance: solved.covariance * alike,
        degrees_of_freedom: (f64::from(solved.degrees_of_freedom) / alike).max(1.0) as u32,
    })
}

impl ByDirection {
    /// The function where its axis' coordinate increases and where it decreases, at a coordinate (mm or rad); mm or rad.
    pub fn at(&self, setup: &Setup, fit: &Fit, x: f64) -> [f64; 2] {
        let known = fit.base.len();
        let mean = fit.functional(setup, self.function, x).dot(&self.values.rows(0, known));
        let half = self.functional(setup, known, x).dot(&self.values);
        [mean + half, mean - half]
    }

    /// The difference of the two at a coordinate, and its standard deviation from the scatter of the readings alone; mm or rad.
    pub fn hysteresis(&self, setup: &Setup, fit: &Fit, x: f64) -> [f64; 2] {
        let functional = self.functional(setup, fit.base.len(), x);
        let variance = (&self.covariance * &functional).dot(&functional);
        [2.0 * functional.dot(&self.values), 2.0 * variance.max(0.0).sqrt()]
    }

    /// The uncertainty of the function at a coordinate (mm or rad): the scatter of the readings about both directions, and the
    /// standard uncertainty from all `others`, the same for both.
    pub fn uncertainty(&self, setup: &Setup, fit: &Fit, x: f64, others: f64) -> Sided {
        let known = fit.base.len();
        let half = self.functional(setup, known, x);
        let mut mean = DVector::zeros(half.len());
        mean.rows_mut(0, known).copy_from(&fit.functional(setup, self.function, x));
        let of = |functional: &DVector<f64>| {
            let std = (&self.covariance * functional).dot(functional).max(0.0).sqrt();
            let scatter = Contribution { std, degrees_of_freedom: Some(self.degrees_of_freedom) };
            let Combined { expanded, .. } =
                combine([scatter, Contribution { std: others, degrees_of_freedom: None }], COVERAGE);
            expanded
        };
        Sided { forward: of(&(&mean + &half)), reverse: of(&(&mean - &half)), mean: of(&mean) }
    }

    /// (1, φ₁, …) behind zeros for the base parameters.
    fn functional(&self, setup: &Setup, known: usize, x: f64) -> DVector<f64> {
        let values = std::iter::once(1.0).chain(setup.basis(self.function, x));
        let all: Vec<f64> = std::iter::repeat_n(0.0, known).chain(values).collect();
        DVector::from_vec(all)
    }
}
