//! Both runs at once: every coefficient from all the data, equal weights unless given.

use super::estimate::{Estimate, JointEstimate};
use super::{ImpossibleRadius, checked, regressors};
use crate::Real;
use crate::lstsq::{Condition, Factor, Rejected, SolveError};
use nalgebra::SVector;
use num_traits::{AsPrimitive, FloatConst};

const P: usize = regressors::NAMES.len();

/// The joint estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<T> {
    radius: T,
    factor: Factor<T, P>,
}

impl<T: Real + FloatConst> Joint<T>
where
    f64: AsPrimitive<T>,
{
    /// No samples yet; `radius` is the bar's nominal length, mm.
    ///
    /// # Errors
    /// [`ImpossibleRadius`]
    pub fn new(radius: T) -> Result<Self, ImpossibleRadius> {
        Ok(Self { radius: checked(radius)?, factor: Factor::new() })
    }

    /// The bar's nominal length, mm.
    pub fn radius(&self) -> T {
        self.radius
    }

    /// Takes a sample of run 1 at the angle `a`: the radial deviation ΔR₁ and the known δ_ya and δ_za there, mm.
    ///
    /// # Errors
    /// [`Rejected`], and nothing has changed.
    pub fn push_tilting(&mut self, a: T, deviation: T, known: [T; 2]) -> Result<(), Rejected> {
        let (row, factors) = regressors::tilting(self.radius, a);
        let subtract = factors.iter().zip(known).fold(deviation, |y, (&f, k)| y - f * k);
        self.factor.push(&scattered(&regressors::TILTING, &row), subtract)
    }

    /// Takes a sample of run 2 at the angle `a`: the radial deviation ΔR₂, mm.
    ///
    /// # Errors
    /// [`Rejected`], and nothing has changed.
    pub fn push_separation(&mut self, a: T, deviation: T) -> Result<(), Rejected> {
        let row = regressors::separation(self.radius, a);
        self.factor.push(&scattered(&regressors::SEPARATION, &row), deviation)
    }

    /// Adds the samples of another estimator of the same bar.
    ///
    /// # Errors
    /// [`Rejected`], and nothing has changed.
    pub fn merge(&mut self, other: &Self) -> Result<(), Rejected> {
        self.factor.merge(&other.factor)
    }

    /// The estimate from all samples so far.
    ///
    /// # Errors
    /// [`SolveError`] naming what the samples do not separate.
    pub fn solve(&self) -> Result<JointEstimate<T>, SolveError<P>> {
        Ok(Estimate { solution: self.factor.solve()?, radius: self.radius })
    }

    /// Condition of the joint design, columns scaled.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn condition(&self) -> Result<Condition<T, P>, SolveError<P>> {
        self.factor.condition()
    }
}

/// A run's row among all base parameters.
fn scattered<T: Real, const N: usize>(positions: &[usize; N], row: &[T; N]) -> SVector<T, P> {
    let mut all = [T::zero(); P];
    for (&at, &value) in positions.iter().zip(row) {
        if let Some(place) = all.get_mut(at) {
            *place = value;
        }
    }
    SVector::from(all)
}
