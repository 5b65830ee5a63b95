//! What can be wrong with a sample, and with a solve.

use super::Subset;
use core::{error, fmt};

/// Why a sample, or a factor to merge, was not taken. The factor is as it was before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rejected {
    /// A regressor or the measured value is NaN or infinite.
    NotFinite,
    /// The weight is negative, NaN, or beyond [`Real::LEAST`](super::Real::LEAST) and its inverse.
    Weight,
    /// The values are finite, but so large that the factor might not be.
    Overflow,
}

/// Columns of the design that the data cannot tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Confounded<const P: usize> {
    /// The first coefficient that the ones before it leave undetermined.
    pub pivot: usize,
    /// `pivot` and the earlier coefficients whose columns combine to its column. Only `pivot` if its column is zero.
    pub involved: Subset<P>,
    /// How many of the columns are independent.
    pub rank: usize,
    /// How many columns there are: `P`, or as many as one of two steps estimates.
    pub columns: usize,
}

/// Why a factor has no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolveError<const P: usize> {
    /// Fewer samples than the coefficients and the residual need.
    TooFewSamples {
        /// Samples of positive weight taken so far.
        samples: u32,
        /// Samples needed.
        needed: usize,
    },
    /// Coefficients that the samples cannot tell apart, whatever their number.
    RankDeficient(Confounded<P>),
    /// A given value is not finite, or a result would not be.
    NotFinite,
}

/// Why two steps have no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TwoStepError<const P: usize> {
    /// The step that failed.
    pub step: Step,
    /// Why; its coefficients are those of the whole estimate.
    pub why: SolveError<P>,
}

/// One of two steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The first, which gives.
    First,
    /// The second, which is given.
    Second,
}

impl<const N: usize> SolveError<N> {
    /// The same, each coefficient moved to its place in `to`.
    pub(super) fn placed<const P: usize>(self, to: &[usize]) -> SolveError<P> {
        match self {
            Self::TooFewSamples { samples, needed } => SolveError::TooFewSamples { samples, needed },
            Self::RankDeficient(Confounded { pivot, involved, rank, columns }) => {
                SolveError::RankDeficient(Confounded {
                    pivot: to.get(pivot).copied().unwrap_or(pivot),
                    involved: involved.placed(to),
                    rank,
                    columns,
                })
            }
            Self::NotFinite => SolveError::NotFinite,
        }
    }
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a value of the sample is not a finite number",
            Self::Weight => "the weight is negative, not a finite number, or beyond the range of the arithmetic",
            Self::Overflow => "the values are beyond the range of the arithmetic",
        })
    }
}

/// An error with the names of the coefficients, for people.
#[derive(Clone, Copy, Debug)]
pub struct Named<'a, const P: usize> {
    error: &'a SolveError<P>,
    names: &'a [&'static str; P],
}

impl<const P: usize> SolveError<P> {
    /// To be shown with the names of the coefficients, such as a model's `NAMES`, in the place of positions.
    pub fn named<'a>(&'a self, names: &'a [&'static str; P]) -> Named<'a, P> {
        Named { error: self, names }
    }

    /// `each` writes one coefficient of those that are not told apart.
    fn write(
        &self,
        f: &mut fmt::Formatter<'_>,
        each: impl Fn(&mut fmt::Formatter<'_>, usize) -> fmt::Result,
    ) -> fmt::Result {
        match self {
            Self::TooFewSamples { samples, needed } => {
                write!(f, "{samples} samples where at least {needed} are needed: measure at more places")
            }
            Self::RankDeficient(c) => {
                write!(f, "the samples do not tell apart (rank {} of {}):", c.rank, c.columns)?;
                c.involved.iter().try_for_each(|i| each(f, i))
            }
            Self::NotFinite => f.write_str("a value is not a finite number: check the readings and their units"),
        }
    }
}

impl<const P: usize> fmt::Display for SolveError<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, |f, i| write!(f, " {i}"))
    }
}

impl<const P: usize> fmt::Display for Named<'_, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.write(f, |f, i| write!(f, " {}", self.names.get(i).copied().unwrap_or("?")))
    }
}

impl<const P: usize> fmt::Display for TwoStepError<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = match self.step {
            Step::First => "first",
            Step::Second => "second",
        };
        write!(f, "{step} step: {}", self.why)
    }
}

impl error::Error for Rejected {}
impl<const P: usize> error::Error for SolveError<P> {}
impl<const P: usize> error::Error for TwoStepError<P> {}
