//! What is derived: the physical parameters, the base parameters, what each run reads, what the runs cannot tell apart.

use super::parameter::{Coefficient, Parameter};
use crate::algebra::{AlgebraError, ErrorId, Fraction, Poly};
use crate::ids::{BaseId, FunctionId, KernelId, ParameterId, RunId};
use crate::measurement::ReadingError;
use crate::model::Text;
use typed_index_collections::TiVec;

/// The measurement model of a machine and its runs.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// Physical parameters that appear in a run: location and set-up errors, coefficients of functions.
    pub parameters: TiVec<ParameterId, Parameter>,
    /// The lumped coefficients the runs determine.
    pub base: TiVec<BaseId, BaseParameter>,
    /// What each run reads.
    pub runs: TiVec<RunId, DerivedRun>,
    /// Directions in parameter space that change no reading: one vector over `parameters` each.
    pub kernel: TiVec<KernelId, Vec<(ParameterId, Fraction)>>,
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
    pub pivot: ParameterId,
    /// What it is in physical parameters, in the declared order.
    pub definition: Vec<(ParameterId, Fraction)>,
    /// The coefficient it is, of a function the runs are made to find.
    pub estimates: Option<Coefficient>,
    /// The first run that sees it.
    pub run: RunId,
}

/// What one run reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DerivedRun {
    /// The run's name.
    pub name: String,
    /// The linear reading in errors and functions, eq. (5), mm.
    pub reading: Poly,
    /// Base parameter and its regressor, eqs. (7) and (9), in the order of [`Derivation::base`].
    pub regressors: Vec<(BaseId, Fraction)>,
    /// Known functions with their factors.
    pub known: Vec<(FunctionId, Poly)>,
}

/// Why there is no measurement model.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DeriveError {
    /// A run has no reading, and why.
    Reading(RunId, ReadingError),
    /// Motion errors that runs see and of which nothing is assumed, with their factors.
    NoBasis(Vec<(RunId, ErrorId, Poly)>),
    /// An entry of [`Model::order`](crate::model::Model::order) that is no parameter of the runs.
    UnknownParameter(Text),
    /// An exact computation failed.
    Algebra(AlgebraError),
}

impl From<AlgebraError> for DeriveError {
    fn from(e: AlgebraError) -> Self {
        Self::Algebra(e)
    }
}

impl core::fmt::Display for DeriveError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Reading(run, e) => write!(f, "run {run}: {e}"),
            Self::NoBasis(seen) => write!(f, "nothing is assumed of {} motion errors that runs see", seen.len()),
            Self::UnknownParameter(text) => write!(f, "`{}` is not a parameter that the runs see", text.value),
            Self::Algebra(e) => core::fmt::Display::fmt(e, f),
        }
    }
}

impl core::error::Error for DeriveError {}
