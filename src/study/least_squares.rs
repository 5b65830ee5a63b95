//! The solver's factor for a number of coefficients known only at run time.
//!
//! The factor is of fixed size, as in a controller; here one is chosen by its size, so that a model read at run time is
//! fitted by the same code.

use nalgebra::{DMatrix, DVector, SVector};
use trunnion_codegen::ids::BaseId;
use trunnion_solver::lstsq::{Factor, Rejected, SolveError};

/// The largest number of coefficients.
pub const LARGEST: usize = 64;

/// How well the samples separate the base parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// Condition number of the design, columns scaled.
    pub condition: f64,
    /// Those that take part in what is separated worst.
    pub weakest: Vec<BaseId>,
}

/// Coefficients, and their covariance for readings of standard deviation 1 mm.
pub(super) struct Solved {
    pub coefficients: DVector<f64>,
    pub inverse: DMatrix<f64>,
    pub rss: f64,
    pub samples: u32,
    /// Condition number of the design, columns scaled, and the columns that are separated worst.
    pub condition: (f64, Vec<usize>),
}

/// Why there is no solution; columns are positions in the row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Unsolved {
    TooFew { samples: u32, needed: usize },
    Confounded { columns: Vec<usize>, rank: usize },
    NotFinite,
}

/// A factor of some size.
pub(super) trait Accumulate: Send {
    fn push(&mut self, row: &[f64], y: f64, weight: f64) -> Result<(), Rejected>;
    fn solve(&self) -> Result<Solved, Unsolved>;
}

impl<const P: usize> Accumulate for Factor<f64, P> {
    fn push(&mut self, row: &[f64], y: f64, weight: f64) -> Result<(), Rejected> {
        self.push_weighted(&SVector::from_fn(|i, _| row.get(i).copied().unwrap_or(0.0)), y, weight)
    }

    fn solve(&self) -> Result<Solved, Unsolved> {
        let unsolved = |e: SolveError<P>| match e {
            SolveError::TooFewSamples { samples, needed } => Unsolved::TooFew { samples, needed },
            SolveError::RankDeficient(c) => Unsolved::Confounded { columns: c.involved.iter().collect(), rank: c.rank },
            SolveError::NotFinite => Unsolved::NotFinite,
        };
        if (self.samples() as usize) <= P {
            return Err(Unsolved::TooFew { samples: self.samples(), needed: P + 1 });
        }
        let solution = self.solve_with_sigma(1.0).map_err(unsolved)?;
        let condition = self.condition().map_err(unsolved)?;
        Ok(Solved {
            coefficients: DVector::from_iterator(P, solution.coefficients.iter().copied()),
            inverse: DMatrix::from_iterator(P, P, solution.covariance.iter().copied()),
            rss: self.residual_sum_of_squares(),
            samples: self.samples(),
            condition: (condition.number, condition.weakest.iter().collect()),
        })
    }
}

macro_rules! of_size {
    ($size:expr, $($n:literal)*) => {
        match $size {
            $($n => Some(Box::new(Factor::<f64, $n>::new())),)*
            _ => None,
        }
    };
}

/// An empty factor for `size` coefficients; `None` for none or more than [`LARGEST`].
pub(super) fn factor(size: usize) -> Option<Box<dyn Accumulate>> {
    of_size!(size, 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
        33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64)
}
