//! Positions to choose from, with what each tells: a set of them is weighed by adding matrices.
//!
//! The covariance of all runs' base parameters is `σ² M⁻¹` with `M = Σ rows rowsᵀ` over the positions, and a function φ at a
//! coordinate has the variance `σ² φᵀ M⁻¹ φ`: neither depends on readings.

use crate::study::visited::{between, sweeps, visited};
use crate::study::{EstimateError, Estimator, Fit, Measurement, Observation, Setup, Variance, fit_with};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use trunnion_codegen::ids::{FunctionId, RunId};

/// Steps between coordinates at which a function is looked at.
const STEPS: usize = 24;
/// Share of a variance that an update leaves, below which it is worked out anew.
const KEPT: f64 = 1e-4;

/// The positions to choose from, run after run.
pub struct Candidates<'a> {
    setup: &'a Setup,
    measurements: &'a [Measurement],
    /// A fit of all of them.
    fit: Fit,
    /// What each base parameter is multiplied with, so that all of them together know of each as much.
    scale: DVector<f64>,
    /// Which run each is of, and its sweep, rad.
    places: Vec<(usize, f64)>,
    /// The rows of each, of base parameters in their scale; a column each.
    rows: Vec<DMatrix<f64>>,
    /// The functions at coordinates of their axes, a column each.
    targets: DMatrix<f64>,
    /// Which function each column is of.
    functions: Vec<usize>,
    /// How many functions.
    count: usize,
}

/// What a set of positions knows, to be weighed with one more or one less.
pub struct Known<'a> {
    candidates: &'a Candidates<'a>,
    sum: DMatrix<f64>,
    /// None where not all is determined.
    solved: Option<Solved>,
}

struct Solved {
    /// L of `M = L Lᵀ`.
    factor: Cholesky<f64, Dyn>,
    /// `L⁻¹ φ` of each target.
    targets: DMatrix<f64>,
    variances: Vec<f64>,
}

/// The readings of zero of runs that stop at positions.
pub fn unread(setup: &Setup, measurements: &[Measurement], positions: &[Vec<f64>]) -> Vec<Observation> {
    let of = |(measurement, own): (&Measurement, &Vec<f64>)| {
        let runs = measurement.runs.clone().into_iter();
        let own = own.clone();
        runs.map(move |run| Observation::zero(setup, run, &setup.both_ways(run, own.clone())))
    };
    measurements.iter().zip(positions).flat_map(of).collect()
}

impl<'a> Candidates<'a> {
    /// The positions to choose from of each run, weighed for functions.
    ///
    /// # Errors
    /// [`EstimateError`] where all of them together give no estimate.
    pub fn new(
        setup: &'a Setup,
        measurements: &'a [Measurement],
        grid: &[Vec<f64>],
        functions: &[FunctionId],
    ) -> Result<Self, EstimateError> {
        let all = unread(setup, measurements, grid);
        let fit = fit_with(setup, &all, Estimator::Joint, Variance::Known(1.0))?;
        let size = fit.base.len();
        let places: Vec<(usize, f64)> =
            grid.iter().enumerate().flat_map(|(run, own)| own.iter().map(move |sweep| (run, *sweep))).collect();
        let mut own = Self {
            setup,
            measurements,
            fit,
            scale: DVector::from_element(size, 1.0),
            rows: Vec::new(),
            targets: DMatrix::zeros(size, 0),
            functions: Vec::new(),
            count: functions.len(),
            places,
        };
        let rows = |own: &Self| own.places.iter().map(|place| own.rows_at(*place)).collect::<Vec<_>>();
        let squares = |at: usize, rows: &[DMatrix<f64>]| rows.iter().map(|r| r.row(at).norm_squared()).sum();
        let unscaled = rows(&own);
        own.scale = DVector::from_fn(size, |column, _| {
            let sum: f64 = squares(column, &unscaled);
            if sum > 0.0 { sum.sqrt().recip() } else { 1.0 }
        });
        own.rows = rows(&own);
        let mut targets = Vec::new();
        for (i, &function) in functions.iter().enumerate() {
            let Some((low, high)) = visited(setup, function, sweeps(&all)) else { continue };
            let steps = if low < high { STEPS } else { 0 };
            for x in between((low, high), steps) {
                targets.push(own.fit.functional(setup, function, x).component_mul(&own.scale));
                own.functions.push(i);
            }
        }
        if !targets.is_empty() {
            own.targets = DMatrix::from_columns(&targets);
        }
        Ok(own)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Which run one is of, and its sweep, rad.
    pub fn place(&self, candidate: usize) -> (usize, f64) {
        self.places[candidate]
    }

    /// What a set of them knows together.
    pub fn known(&self, set: impl Iterator<Item = usize>) -> Known<'_> {
        self.solved(set.map(|i| &self.rows[i]).fold(self.nothing(), |sum, rows| added(sum, rows, 1.0)))
    }

    /// What other positions know together.
    pub fn known_at(&self, positions: &[Vec<f64>]) -> Known<'_> {
        let places = positions.iter().enumerate().flat_map(|(run, own)| own.iter().map(move |sweep| (run, *sweep)));
        self.solved(places.fold(self.nothing(), |sum, place| added(sum, &self.rows_at(place), 1.0)))
    }

    fn solved(&self, sum: DMatrix<f64>) -> Known<'_> {
        let solved = Cholesky::new(sum.clone()).and_then(|factor| {
            let targets = factor.l_dirty().solve_lower_triangular(&self.targets)?;
            let variances = targets.column_iter().map(|own| own.norm_squared()).collect();
            Some(Solved { factor, targets, variances })
        });
        Known { candidates: self, sum, solved }
    }

    /// Each function's largest standard deviation of the variances of the targets.
    fn largest(&self, variances: &[f64]) -> Vec<f64> {
        let mut stds = vec![0.0f64; self.count];
        for (function, variance) in self.functions.iter().zip(variances) {
            stds[*function] = stds[*function].max(variance.sqrt());
        }
        stds
    }

    fn nothing(&self) -> DMatrix<f64> {
        DMatrix::zeros(self.scale.len(), self.scale.len())
    }

    /// The rows at a place.
    fn rows_at(&self, (measurement, sweep): (usize, f64)) -> DMatrix<f64> {
        let mut rows = Vec::new();
        let mut add = |run: RunId, direction: f64| {
            let mut row = self.setup.row(run);
            let (regressors, _) = row.at(sweep, direction);
            let mut own = DVector::zeros(self.scale.len());
            for (x, at) in regressors.iter().zip(self.fit.places(self.setup, run)) {
                at.into_iter().for_each(|at| own[at] += x * self.scale[at]);
            }
            rows.push(own);
        };
        for &run in &self.measurements[measurement].runs {
            let both = !self.setup.model.runs[run].nuisance.is_empty();
            [1.0, -1.0].into_iter().take(1 + usize::from(both)).for_each(|direction| add(run, direction));
        }
        DMatrix::from_columns(&rows)
    }
}

impl Known<'_> {
    /// Each function's largest standard deviation for one of the readings; `None` where not all is determined.
    pub fn stds(&self) -> Option<Vec<f64>> {
        self.solved.as_ref().map(|own| self.candidates.largest(&own.variances))
    }

    /// What is known with one position more.
    pub fn and(&self, candidate: usize) -> Self {
        self.candidates.solved(added(self.sum.clone(), &self.candidates.rows[candidate], 1.0))
    }

    /// What is known with one position less.
    pub fn but(&self, candidate: usize) -> Self {
        self.candidates.solved(added(self.sum.clone(), &self.candidates.rows[candidate], -1.0))
    }

    /// The standard deviations with one position more.
    pub fn with(&self, candidate: usize) -> Option<Vec<f64>> {
        self.changed(candidate, 1.0)
    }

    /// The standard deviations with one position less.
    pub fn without(&self, candidate: usize) -> Option<Vec<f64>> {
        self.changed(candidate, -1.0)
    }

    /// Rows R added or taken away: `φᵀ (M ± RᵀR)⁻¹ φ = φᵀ M⁻¹ φ ∓ bᵀ (1 ± R M⁻¹ Rᵀ)⁻¹ b` with `b = R M⁻¹ φ`.
    fn changed(&self, candidate: usize, sign: f64) -> Option<Vec<f64>> {
        let rows = &self.candidates.rows[candidate];
        let quick = self.solved.as_ref().and_then(|Solved { factor, targets, variances }| {
            let own = factor.l_dirty().solve_lower_triangular(rows)?;
            let mut inner = own.tr_mul(&own) * sign;
            (0..inner.nrows()).for_each(|i| inner[(i, i)] += 1.0);
            let seen = Cholesky::new(inner)?.l_dirty().solve_lower_triangular(&own.tr_mul(targets))?;
            let change = seen.column_iter().zip(variances).map(|(b, before)| before - sign * b.norm_squared());
            let after: Vec<f64> = change.collect();
            // Of what is nearly all taken away no digits are left.
            let is_kept = after.iter().zip(variances).all(|(after, before)| *after > KEPT * before);
            is_kept.then_some(after)
        });
        match quick {
            Some(variances) => Some(self.candidates.largest(&variances)),
            None => self.candidates.solved(added(self.sum.clone(), rows, sign)).stds(),
        }
    }
}

/// A sum of `row rowᵀ` with some more, or less.
fn added(mut sum: DMatrix<f64>, rows: &DMatrix<f64>, sign: f64) -> DMatrix<f64> {
    rows.column_iter().for_each(|row| sum.ger(sign, &row, &row, 1.0));
    sum
}
