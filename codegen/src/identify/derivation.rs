//! What is derived: the physical parameters, the base parameters, what each run reads, what the runs cannot tell apart.

use super::parameter::{Assumed, Parameter};
use crate::algebra::{AlgebraError, ErrorId, Fraction, Poly};
use crate::ids::{BaseId, FunctionId, KernelId, ParameterId, RunId, TermId};
use crate::measurement::ReadingError;
use crate::model::Coefficient;
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
    /// Parameters that the model's assumptions make up of others.
    pub assumed: Vec<Assumed>,
    /// What all runs together tell of each estimated function.
    pub functions: Vec<Determination>,
}

impl Derivation {
    /// Number of base parameters that are not called after coefficients of an estimated function: 11 for the paper.
    pub fn rank(&self) -> usize {
        self.base.iter().filter(|b| b.lumped || b.estimates.is_none()).count()
    }
}

/// A lumped coefficient ("base parameter" in robotics).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BaseParameter {
    /// `k1`, `k2`, …, or the coefficient's own name for an estimated function; a location error's own where it stands alone.
    pub name: String,
    /// Whether it has a number for a name.
    pub lumped: bool,
    /// The parameter that carries it.
    pub pivot: ParameterId,
    /// What it is in physical parameters, in the declared order.
    pub definition: Vec<(ParameterId, Fraction)>,
    /// The coefficient it is, of a function the runs are made to find.
    pub estimates: Option<Coefficient>,
    /// The first run that sees it.
    pub run: RunId,
}

/// What is seen of a function, term by term of its basis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Determination {
    /// The function.
    pub function: FunctionId,
    /// The terms of its basis whose coefficients are seen, ascending.
    pub seen: Vec<SeenTerm>,
    /// The coefficients that are not: nothing the runs read has them, or only sums in which an earlier one stands.
    pub missing: Vec<TermId>,
}

/// A coefficient as it is seen: `coefficient + Σ others = Σ base`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeenTerm {
    /// The term of the basis.
    pub term: TermId,
    /// Base parameters with their factors.
    pub base: Vec<(BaseId, Fraction)>,
    /// Other parameters with their factors, from which no run separates it.
    pub others: Vec<(ParameterId, Fraction)>,
}

/// How far a function is determined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The runs give its value.
    Determined,
    /// They give it up to what other parameters, or terms that are missing, add to it.
    UpTo,
    /// They give nothing of it.
    NotSeen,
}

impl Determination {
    /// How far the function is determined.
    pub fn extent(&self) -> Extent {
        match (self.seen.as_slice(), self.missing.as_slice()) {
            ([], _) => Extent::NotSeen,
            (seen, []) if seen.iter().all(|s| s.others.is_empty()) => Extent::Determined,
            _ => Extent::UpTo,
        }
    }
}

/// What one run reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DerivedRun {
    /// The run's name.
    pub name: String,
    /// The linear reading in errors and functions, T(5), mm.
    pub reading: Poly,
    /// Base parameter and its regressor, T(7) and T(9), in the order of [`Derivation::base`].
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
    /// Assumptions that could only be solved by dividing by a sum of constants, as they were written.
    AssumptionDivides(Vec<String>),
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
            Self::AssumptionDivides(texts) => write!(f, "{}: a division by a sum of constants", texts.join("; ")),
            Self::Algebra(e) => core::fmt::Display::fmt(e, f),
        }
    }
}

impl core::error::Error for DeriveError {}
