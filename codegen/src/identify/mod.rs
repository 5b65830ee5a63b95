//! Base parameters by exact rank factorisation: eqs. (7) and (9), and what the runs cannot tell apart.
//!
//! After this room a run's reading is `Σ regressor · base parameter + Σ coefficient · known function`, and the base
//! parameters are exactly what all runs together determine.

mod columns;
mod factor;
mod groups;

pub use columns::{Origin, Parameter};
pub use groups::Group;

use crate::algebra::{AlgebraError, ErrorId, Fraction, Order, Poly};
use crate::measurement::{ReadingError, reading};
use crate::model::Model;

/// The measurement model of a machine and its runs.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// Physical parameters that appear in a run: location and set-up errors, coefficients of functions.
    pub parameters: Vec<Parameter>,
    /// The lumped coefficients the runs determine.
    pub base: Vec<BaseParameter>,
    /// What each run reads.
    pub runs: Vec<DerivedRun>,
    /// Directions in parameter space that change no reading: one vector over `parameters` each.
    pub kernel: Vec<Vec<(usize, Fraction)>>,
    /// Errors of the machine that no run sees at first order.
    pub unseen: Vec<ErrorId>,
}

impl Derivation {
    /// Number of base parameters that are not coefficients of an estimated function: 11 for the paper.
    pub fn rank(&self) -> usize {
        self.base.iter().filter(|b| b.estimates.is_none()).count()
    }
}

/// A lumped coefficient ("base parameter" in robotics).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BaseParameter {
    /// `k1`, `k2`, …, or the coefficient's own name for an estimated function.
    pub name: String,
    /// The parameter that carries it.
    pub pivot: usize,
    /// What it is in physical parameters, in the declared order.
    pub definition: Vec<(usize, Fraction)>,
    /// Position in [`Model::functions`] and in its basis, for a function the runs are made to find.
    pub estimates: Option<(usize, usize)>,
    /// The first run that sees it.
    pub run: usize,
}

/// What one run reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DerivedRun {
    /// The run's name.
    pub name: String,
    /// The linear reading in errors and functions, eq. (5), mm.
    pub reading: Poly,
    /// Base parameter and its regressor, eqs. (7) and (9), in the order of [`Derivation::base`].
    pub regressors: Vec<(usize, Fraction)>,
    /// Known functions (positions in [`Model::functions`]) with their coefficients.
    pub known: Vec<(usize, Poly)>,
}

/// Why there is no measurement model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeriveError {
    /// A run has no reading: the run's position and why.
    Reading(usize, ReadingError),
    /// Motion errors that runs see and of which nothing is assumed: the run's position, the error, its coefficient.
    NoBasis(Vec<(usize, ErrorId, Poly)>),
    /// An entry of [`Model::order`] that is no parameter of the runs.
    UnknownParameter(usize),
    /// An exact computation failed.
    Algebra(AlgebraError),
}

impl From<AlgebraError> for DeriveError {
    fn from(e: AlgebraError) -> Self {
        Self::Algebra(e)
    }
}

/// Derives the measurement model: every reading at first order, the bases put in, the base parameters.
pub fn derive(model: &Model) -> Result<Derivation, DeriveError> {
    let read = |(i, run)| reading(model, run, Order::LINEAR).map_err(|e| DeriveError::Reading(i, e));
    let readings = model.runs.iter().enumerate().map(read).collect::<Result<Vec<_>, _>>()?;
    let columns = columns::columns(model, &readings)?;
    factor::factor(model, readings, columns)
}
