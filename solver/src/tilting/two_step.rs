//! The paper's two steps: k1…k5 from run 2, put into run 1; their covariance carried into ε_xa.
//!
//! Both runs stream at once: the substitution happens in the factor of run 1, when it is solved.

use super::estimate::Estimate;
use super::regressors::{NAMES, SEPARATION, TILTING};
use super::{ImpossibleRadius, checked, regressors};
use crate::Real;
use crate::lstsq::{Factor, Rejected, SolveError};
use nalgebra::{SMatrix, SVector};
use num_traits::{AsPrimitive, FloatConst};

const RUN_1: usize = TILTING.len();
const RUN_2: usize = SEPARATION.len();
/// Base parameters that both runs see: those of the linear axes, k1…k5.
const SHARED: usize = {
    let (mut i, mut n) = (0, 0);
    while i < RUN_1 {
        n += place(&SEPARATION, TILTING[i]).is_some() as usize;
        i += 1;
    }
    n
};
/// Base parameters that only run 1 sees: ε_xa's coefficients, k6, k7, k8.
const OWN: usize = RUN_1 - SHARED;
/// Columns of run 1, its own first: positions in its row.
const ORDER: [usize; RUN_1] = {
    let (mut order, mut i, mut own, mut shared) = ([0; RUN_1], 0, 0, OWN);
    while i < RUN_1 {
        if place(&SEPARATION, TILTING[i]).is_some() {
            order[shared] = i;
            shared += 1;
        } else {
            order[own] = i;
            own += 1;
        }
        i += 1;
    }
    order
};
/// Places of the shared base parameters in run 2's row, in the order of run 1's columns.
const IN_RUN_2: [usize; SHARED] = {
    let (mut at, mut j) = ([0; SHARED], 0);
    while j < SHARED {
        at[j] = match place(&SEPARATION, TILTING[ORDER[OWN + j]]) {
            Some(p) => p,
            None => 0,
        };
        j += 1;
    }
    at
};
/// Names of the coefficients in the second step's solution.
pub const TWO_STEP_NAMES: [&str; OWN] = {
    let (mut names, mut j) = ([""; OWN], 0);
    while j < OWN {
        names[j] = NAMES[TILTING[ORDER[j]]];
        j += 1;
    }
    names
};

const fn place(positions: &[usize; RUN_2], wanted: usize) -> Option<usize> {
    let mut i = 0;
    while i < RUN_2 {
        if positions[i] == wanted {
            return Some(i);
        }
        i += 1;
    }
    None
}

/// The two-step estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoStep<T> {
    radius: T,
    tilting: Factor<T, RUN_1>,
    separation: Factor<T, RUN_2>,
}

/// Why there is no two-step estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwoStepError {
    /// Run 2 does not give k1…k5; positions are those of [`SEPARATION`].
    Separation(SolveError<RUN_2>),
    /// Run 1 does not give the rest; positions are those of [`TWO_STEP_NAMES`].
    Tilting(SolveError<OWN>),
}

impl<T: Real + FloatConst> TwoStep<T>
where
    f64: AsPrimitive<T>,
{
    /// No samples yet; `radius` is the bar's nominal length, mm.
    ///
    /// # Errors
    /// [`ImpossibleRadius`]
    pub fn new(radius: T) -> Result<Self, ImpossibleRadius> {
        Ok(Self { radius: checked(radius)?, tilting: Factor::new(), separation: Factor::new() })
    }

    /// Takes a sample of run 1 at the angle `a`: the radial deviation ΔR₁ and the known δ_ya and δ_za there, mm.
    ///
    /// # Errors
    /// [`Rejected`], and nothing has changed.
    pub fn push_tilting(&mut self, a: T, deviation: T, known: [T; 2]) -> Result<(), Rejected> {
        let (row, factors) = regressors::tilting(self.radius, a);
        let rest = factors.iter().zip(known).fold(deviation, |y, (&f, k)| y - f * k);
        self.tilting.push(&SVector::from(ORDER.map(|i| row.get(i).copied().unwrap_or(T::zero()))), rest)
    }

    /// Takes a sample of run 2 at the angle `a`: the radial deviation ΔR₂, mm.
    ///
    /// # Errors
    /// [`Rejected`], and nothing has changed.
    pub fn push_separation(&mut self, a: T, deviation: T) -> Result<(), Rejected> {
        self.separation.push(&SVector::from(regressors::separation(self.radius, a)), deviation)
    }

    /// The estimate from all samples so far: coefficients named by [`TWO_STEP_NAMES`].
    ///
    /// # Errors
    /// [`TwoStepError`] naming the run and what its samples do not separate.
    pub fn solve(&self) -> Result<Estimate<T, OWN>, TwoStepError> {
        let first = self.separation.solve().map_err(TwoStepError::Separation)?;
        let [column] = &first.coefficients.data.0;
        let zero = T::zero();
        let k = IN_RUN_2.map(|i| column.get(i).copied().unwrap_or(zero));
        let columns = &first.covariance.data.0;
        let covariance =
            IN_RUN_2.map(|j| IN_RUN_2.map(|i| columns.get(j).and_then(|c| c.get(i)).copied().unwrap_or(zero)));
        let covariance = SMatrix::from_fn(|i, j| covariance.get(j).and_then(|c| c.get(i)).copied().unwrap_or(zero));
        let solution =
            self.tilting.solve_given::<OWN, SHARED>(&SVector::from(k), &covariance).map_err(TwoStepError::Tilting)?;
        Ok(Estimate { solution, radius: self.radius })
    }
}
