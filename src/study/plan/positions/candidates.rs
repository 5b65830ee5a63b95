//! Positions to choose from, with what each tells: a set of them is weighed by adding matrices.
//!
//! The covariance of all runs' base parameters is `σ² M⁻¹` with `M = Σ rows rowsᵀ` over the positions, and a function φ at a
//! coordinate has the variance `σ² φᵀ M⁻¹ φ`: neither depends on readings.

use crate::study::visited::{between, sweeps, visited};
use crate::study::{EstimateError, Estimator, Fit, Measurement, Observation, Setup, Variance, fit_with};
use nalgebra::{Cholesky, DMatrix, DVector};
use trunnion_codegen::ids::{FunctionId, RunId};

/// Steps between coordinates at which a function is looked at.
const STEPS: usize = 24;

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
    information: Vec<DMatrix<f64>>,
    /// Each function at coordinates of its axis.
    targets: Vec<Vec<DVector<f64>>>,
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
            information: Vec::new(),
            targets: Vec::new(),
            places,
        };
        let told = |own: &Self| own.places.iter().map(|place| own.told(*place)).collect::<Vec<_>>();
        let whole = told(&own).into_iter().fold(DMatrix::zeros(size, size), |sum, one| sum + one);
        own.scale = whole.diagonal().map(|x| if x > 0.0 { x.sqrt().recip() } else { 1.0 });
        own.information = told(&own);
        let target = |&function: &FunctionId| -> Vec<DVector<f64>> {
            let Some((low, high)) = visited(setup, function, sweeps(&all)) else { return Vec::new() };
            let steps = if low < high { STEPS } else { 0 };
            let at = |x| own.fit.functional(setup, function, x).component_mul(&own.scale);
            between((low, high), steps).map(at).collect()
        };
        own.targets = functions.iter().map(target).collect();
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

    /// What one tells.
    pub fn information(&self, candidate: usize) -> &DMatrix<f64> {
        &self.information[candidate]
    }

    /// What a set of them tells together.
    pub fn known(&self, set: impl Iterator<Item = usize>) -> DMatrix<f64> {
        set.fold(self.nothing(), |sum, i| sum + &self.information[i])
    }

    /// What other positions tell together.
    pub fn known_at(&self, positions: &[Vec<f64>]) -> DMatrix<f64> {
        let places = positions.iter().enumerate().flat_map(|(run, own)| own.iter().map(move |sweep| (run, *sweep)));
        places.fold(self.nothing(), |sum, place| sum + self.told(place))
    }

    /// Each function's largest standard deviation for one of the readings; `None` where not all is determined.
    pub fn stds(&self, known: DMatrix<f64>) -> Option<Vec<f64>> {
        let factor = Cholesky::new(known)?;
        let lower = factor.l_dirty();
        let variance = |t: &DVector<f64>| lower.solve_lower_triangular(t).map_or(f64::INFINITY, |y| y.norm_squared());
        let largest = |own: &Vec<DVector<f64>>| own.iter().map(variance).fold(0.0, f64::max).sqrt();
        Some(self.targets.iter().map(largest).collect())
    }

    fn nothing(&self) -> DMatrix<f64> {
        DMatrix::zeros(self.scale.len(), self.scale.len())
    }

    /// `Σ rows rowsᵀ` at a place, of base parameters in their scale.
    fn told(&self, (measurement, sweep): (usize, f64)) -> DMatrix<f64> {
        let mut sum = self.nothing();
        let mut add = |run: RunId, direction: f64| {
            let mut row = self.setup.row(run);
            let (regressors, _) = row.at(sweep, direction);
            let mut own = DVector::zeros(self.scale.len());
            for (x, at) in regressors.iter().zip(self.fit.places(self.setup, run)) {
                at.into_iter().for_each(|at| own[at] += x * self.scale[at]);
            }
            sum.ger(1.0, &own, &own, 1.0);
        };
        for &run in &self.measurements[measurement].runs {
            let both = !self.setup.model.runs[run].nuisance.is_empty();
            [1.0, -1.0].into_iter().take(1 + usize::from(both)).for_each(|direction| add(run, direction));
        }
        sum
    }
}
