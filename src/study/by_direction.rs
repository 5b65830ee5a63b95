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

use super::fill::places;
use super::fit::{Fit, Sample};
use super::recording::Recording;
use super::rows::{Rows, Taken, blocks};
use super::setup::Setup;
use super::solved::columns;
use super::warning::WARN_CONDITION;
use nalgebra::{DMatrix, DVector};
use thiserror::Error;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::graph::{LANES, Lanes};
use trunnion_codegen::ids::{AxisId, FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_solver::sized::{self, Block, Column, ROWS};

/// Of the coordinates that were visited, the share that either direction has to go over.
const SHARE: f64 = 0.9;
/// Half the step of a derivative with respect to an error, mm or rad, and to a sweep, rad.
const STEP: f64 = 1e-4;

/// A function's hysteresis.
#[derive(Clone, Debug)]
pub struct ByDirection {
    function: FunctionId,
    /// Base parameters in the order of the fit, then h₀ and each hⱼ.
    values: DVector<f64>,
    covariance: DMatrix<f64>,
    /// Degrees of freedom of that.
    pub degrees_of_freedom: u32,
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
    let own = setup.basis(function, 0.0).len() + 1;
    let known = fit.base.len();
    let runs: Vec<RunId> = recordings.iter().map(Recording::run).collect();
    let (_, mut of) = columns(setup, &runs, &fit.steps);
    // The runs that see the function are those of the last step.
    let added = if of.own.is_empty() { &mut of.first } else { &mut of.own };
    added.extend(known..known + own);
    let mut problem = sized::estimator(&of).ok_or(NotByDirection::Confounded)?;
    let mut reached = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    let mut refused = false;
    for (recording, &step) in recordings.iter().zip(&fit.steps) {
        let order = of.of(step);
        let turning = Turning { setup, run: recording.run(), function, axis };
        let moves = setup.model.runs[turning.run].at[axis].poly().is_some();
        let places = places(setup, turning.run, &fit.base, &order);
        let halves: Vec<Option<usize>> =
            (known..known + own).map(|column| order.iter().position(|at| *at == column)).collect();
        let mut block: Vec<Column<f64>> = vec![[0.0; ROWS]; order.len()];
        let take = |rows: &Rows| {
            let samples = rows.samples();
            block.iter_mut().for_each(|column| column.fill(0.0));
            let mut put = |at: &Option<usize>, values: &Lanes| {
                if let Some(at) = at {
                    block[*at][..samples].copy_from_slice(&values[..samples]);
                }
            };
            rows.regressors().zip(&places).for_each(|(values, at)| put(at, values));
            if moves {
                turning.columns(rows, own).iter().zip(&halves).for_each(|(values, at)| put(at, values));
                for (x, side) in turning.sides(rows.taken()).into_iter().filter(|(_, side)| *side != 0.0) {
                    let (low, high) = &mut reached[usize::from(side < 0.0)];
                    (*low, *high) = (low.min(x), high.max(x));
                }
            }
            let mut y = [0.0; ROWS];
            y[..samples].copy_from_slice(&rows.explained()[..samples]);
            let pushed = Block { columns: &mut block, y: &mut y };
            refused |= problem.push(step, pushed, samples, recording.weight()).is_err();
        };
        blocks(setup, recording, |_: &Sample| {}, take).map_err(Failing::Recording)?;
    }
    let length = |(low, high): (f64, f64)| high - low;
    let all = (reached[0].0.min(reached[1].0), reached[0].1.max(reached[1].1));
    if !reached.iter().all(|own| length(*own) >= SHARE * length(all) && length(all) > 0.0) {
        return Err(NotByDirection::OneDirection.into());
    }
    let solved = problem.solve(None).map_err(|_| NotByDirection::Confounded)?;
    if refused || solved.condition.0 > WARN_CONDITION.max(3.0 * fit.separation.condition) {
        return Err(NotByDirection::Confounded.into());
    }
    let (values, covariance) = (solved.coefficients, solved.covariance);
    Ok(ByDirection { function, values, covariance, degrees_of_freedom: solved.degrees_of_freedom })
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

    /// (1, φ₁, …) behind zeros for the base parameters.
    fn functional(&self, setup: &Setup, known: usize, x: f64) -> DVector<f64> {
        let values = std::iter::once(1.0).chain(setup.basis(self.function, x));
        let all: Vec<f64> = std::iter::repeat_n(0.0, known).chain(values).collect();
        DVector::from_vec(all)
    }
}
