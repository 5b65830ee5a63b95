//! How well intended runs would determine the base parameters and the functions they are made for.
//!
//! The covariance of a least-squares estimate depends on where the samples are and on the noise, not on the readings: it is
//! that of a fit of readings of zero with a known standard deviation.

use crate::study::visited::{between, sweeps, visited};
use crate::study::{EstimateError, Estimator, Observation, Seen, Setup, Told, Variance, fit_with};
use core::fmt;
use trunnion_codegen::ids::{BaseId, FunctionId};
use trunnion_codegen::quantity::{Quantity, Unit};
use trunnion_solver::lstsq::student_t_95;

/// Runs that are intended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intended {
    /// Samples of each run, in equal steps.
    pub samples: usize,
    /// First sweep and end of the range, rad.
    pub range: (f64, f64),
    /// Standard deviation of a reading, mm: u/√3 for uniform noise ±u.
    pub sigma: f64,
}

/// Standard deviation of noise that is uniform within ± `width`.
pub fn uniform_std(width: f64) -> f64 {
    width / 3f64.sqrt()
}

/// What they would give.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Condition number of the design, columns scaled.
    pub condition: f64,
    /// Base parameters that are separated worst.
    pub weakest: Vec<BaseId>,
    /// Each base parameter with its standard deviation.
    pub base: Vec<(BaseId, f64)>,
    /// The estimated functions.
    pub functions: Vec<Predicted>,
}

/// What they would give of one estimated function.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicted {
    /// The function.
    pub function: FunctionId,
    /// Its uncertainty where that is largest; `None` if no run sees it.
    pub largest: Option<Largest>,
    /// How far it is determined.
    pub told: Told,
}

impl Predicted {
    /// Its valuation number where it is largest, for readings of a standard deviation in mm.
    pub fn valuation(&self, setup: &Setup, sigma: f64) -> Option<Valuation> {
        let unit = match setup.quantity(self.function) {
            Quantity::Length => Unit::Um,
            Quantity::Angle => Unit::Deg,
        };
        let of_one = Unit::Um.to_inner(1.0) / sigma;
        self.largest.map(|largest| Valuation { value: unit.from_inner(largest.std * of_one), unit })
    }
}

/// What each µm of a reading's standard deviation makes of a function's: `0.3586 µm/µm`, `0.000164 °/µm`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Valuation {
    /// The number.
    pub value: f64,
    /// µm or degrees.
    pub unit: Unit,
}

impl Valuation {
    /// Its unit as JSON objects have it: `um/um`.
    pub fn suffix(&self) -> String {
        format!("{}/{}", self.unit.suffix(), Unit::Um.suffix())
    }
}

impl fmt::Display for Valuation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&match self.unit {
            Unit::Um => format!("{:.4} µm/µm", self.value),
            _ => format!("{:.6} °/µm", self.value),
        })
    }
}

/// The largest uncertainty over the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// Coordinate, mm or rad.
    pub at: f64,
    /// Standard deviation, mm or rad.
    pub std: f64,
    /// Half width of the 95 % band a fit of such runs would report.
    pub u95: f64,
}

/// Steps between the points of a function's range that are looked at.
const POINTS: usize = 360;

/// Predicts what all runs of a model would give.
///
/// # Errors
/// [`EstimateError`] where such samples do not determine the base parameters.
pub fn predict(setup: &Setup, intended: Intended, estimator: Estimator) -> Result<Prediction, EstimateError> {
    let observations = setup.unread(intended.samples, intended.range);
    predict_at(setup, &observations, &observations, intended.sigma, estimator)
}

/// What samples of the given places would give, with a standard deviation of a reading in mm; the functions are looked at where
/// those of `along` go.
///
/// # Errors
/// [`EstimateError`] where such samples do not determine the base parameters.
pub fn predict_at(
    setup: &Setup,
    observations: &[Observation],
    along: &[Observation],
    sigma: f64,
    estimator: Estimator,
) -> Result<Prediction, EstimateError> {
    let fit = fit_with(setup, observations, estimator, Variance::Known(sigma))?;
    let t = student_t_95::<f64>(fit.degrees_of_freedom);
    let function = |seen: &Seen| {
        let told = seen.told(setup);
        let range = visited(setup, seen.function(), sweeps(along));
        let points = range.into_iter().filter(|_| told.sum.is_some()).flat_map(|range| between(range, POINTS));
        let std = |x: f64| (x, fit.function(setup, seen.function(), x).1);
        let largest = points.map(std).max_by(|a, b| a.1.total_cmp(&b.1));
        let largest = largest.map(|(at, std)| Largest { at, std, u95: t * std });
        Predicted { function: seen.function(), largest, told }
    };
    Ok(Prediction {
        condition: fit.separation.condition,
        weakest: fit.separation.weakest.clone(),
        base: fit.base.iter().enumerate().map(|(i, &b)| (b, fit.covariance[(i, i)].max(0.0).sqrt())).collect(),
        functions: fit.functions().iter().map(function).collect(),
    })
}
