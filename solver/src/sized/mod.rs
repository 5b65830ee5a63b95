//! The estimators for a number of coefficients known only at run time, on a desk: feature `sized`, with a heap.
//!
//! A factor is of fixed size, as in a controller; here one is chosen by its size, so that a model read at run time is fitted by
//! the same code. It stands in this crate so that its sizes are compiled once, not with every change of a program.

mod spread;
mod stored;
mod vectors;

pub use crate::lstsq::{Column, ROWS};
pub use spread::{blocks, spread};
pub use stored::{NotTaken, Stored};
use vectors::Vectors;
pub use vectors::{Work, vectorised};

use crate::lstsq::{Blocked, Condition, Factor, Order, Portable, Rejected, Solution, SolveError, Step, TwoStepError};
use nalgebra::{DMatrix, DVector, SMatrix};
use std::boxed::Box;
use std::vec;
use std::vec::Vec;

/// The largest number of coefficients.
pub const LARGEST: usize = 64;

/// Which coefficients are the columns of each step: of one alone, all are the first's.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// The first step's.
    pub first: Vec<usize>,
    /// Only the second step sees these.
    pub own: Vec<usize>,
    /// The first step gives these to the second.
    pub given: Vec<usize>,
}

impl Columns {
    /// The columns of a step's rows.
    pub fn of(&self, step: Step) -> Vec<usize> {
        match step {
            Step::First => self.first.clone(),
            Step::Second => [self.own.as_slice(), &self.given].concat(),
        }
    }
}

/// An estimate of all coefficients.
pub struct Solved {
    /// In the order of the columns.
    pub coefficients: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// Of the residuals of the last step.
    pub degrees_of_freedom: u32,
    /// By how much a sample's reading moves the coefficients: `w · sensitivity[step] · row`.
    pub sensitivity: [DMatrix<f64>; 2],
    /// Condition number of the design, columns scaled, and the coefficients that are separated worst.
    pub condition: (f64, Vec<usize>),
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsolved {
    /// Fewer samples than a step needs.
    TooFew {
        /// The step.
        step: Step,
        /// Samples there are.
        samples: u32,
        /// Samples needed.
        needed: usize,
    },
    /// The samples of a step do not tell coefficients apart.
    Confounded {
        /// The step.
        step: Step,
        /// Their columns.
        coefficients: Vec<usize>,
    },
    /// A sample, or a result, is not finite.
    NotFinite,
}

impl Unsolved {
    fn in_step<const P: usize>(error: TwoStepError<P>) -> Self {
        Self::of(error.step, error.why)
    }

    fn of<const P: usize>(step: Step, error: SolveError<P>) -> Self {
        match error {
            SolveError::TooFewSamples { samples, needed } => Self::TooFew { step, samples, needed },
            SolveError::RankDeficient(c) => Self::Confounded { step, coefficients: c.involved.iter().collect() },
            _ => Self::NotFinite,
        }
    }
}

/// An estimator of some size.
pub trait Estimate: Send + Sync {
    /// Takes the first `rows` rows of a block of a step, each with `weight`; the columns are in the order of [`Columns::of`], and
    /// used up.
    ///
    /// # Errors
    /// [`Rejected`]; none of the rows is taken then.
    fn push(&mut self, step: Step, block: Block, rows: usize, weight: f64) -> Result<(), Rejected>;
    /// What the samples so far have come to, step by step.
    fn stored(&self) -> Vec<Stored>;
    /// Takes all samples of another estimator of the same columns, as [stored](Self::stored); one without samples becomes the other
    /// to the bit.
    ///
    /// # Errors
    /// [`NotTaken`]; nothing is taken then.
    fn absorb(&mut self, stored: &[Stored]) -> Result<(), NotTaken>;
    /// A copy.
    fn copy(&self) -> Box<dyn Estimate>;
    /// The coefficients of [`solve`](Self::solve) alone, in the order of the columns.
    ///
    /// # Errors
    /// [`Unsolved`]
    fn coefficients(&self) -> Result<DVector<f64>, Unsolved>;
    /// The estimate; `sigma` is the standard deviation of a reading of weight one, if it is known.
    ///
    /// # Errors
    /// [`Unsolved`]
    fn solve(&self, sigma: Option<f64>) -> Result<Solved, Unsolved>;
}

/// A block of rows: regressors column by column, and readings.
pub struct Block<'a> {
    /// A column for each coefficient of the step.
    pub columns: &'a mut [Column<f64>],
    /// The readings.
    pub y: &'a mut Column<f64>,
}

/// A block on its way into a factor.
struct Push<'a, const P: usize> {
    factor: &'a mut Blocked<f64, P>,
    block: Block<'a>,
    rows: usize,
    weight: f64,
    work: &'a mut [Column<f64>],
}

impl<const P: usize> pulp::WithSimd for Push<'_, P> {
    type Output = Result<(), Rejected>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) -> Self::Output {
        let Block { columns, y } = self.block;
        if S::IS_SCALAR {
            return self.factor.push_with(Portable, columns, y, self.rows, self.weight, self.work);
        }
        self.factor.push_with(Vectors(simd), columns, y, self.rows, self.weight, self.work)
    }
}

impl<const P: usize> Push<'_, P> {
    fn done(self) -> Result<(), Rejected> {
        pulp::Arch::new().dispatch(self)
    }
}

fn leading(n: usize, coefficients: &[f64]) -> DVector<f64> {
    DVector::from_column_slice(&coefficients[..n])
}

/// The first `n` of what was solved.
fn solved<const P: usize>(
    n: usize,
    solution: Solution<f64, P>,
    condition: Condition<f64, P>,
    sensitivity: [SMatrix<f64, P, P>; 2],
) -> Solved {
    let matrix = |m: &SMatrix<f64, P, P>| DMatrix::from_fn(n, n, |i, j| m[(i, j)]);
    Solved {
        coefficients: leading(n, solution.coefficients.as_slice()),
        covariance: matrix(&solution.covariance),
        degrees_of_freedom: solution.degrees_of_freedom,
        sensitivity: sensitivity.each_ref().map(matrix),
        condition: (condition.number, condition.weakest.iter().collect()),
    }
}

/// Uncertainty needs a sample more than there are coefficients, even where the readings' own is known.
fn enough(step: Step, samples: u32, columns: usize) -> Result<(), Unsolved> {
    if samples as usize > columns { Ok(()) } else { Err(Unsolved::TooFew { step, samples, needed: columns + 1 }) }
}

/// All runs in one problem of `n` unknowns.
#[derive(Clone)]
struct OneStep<const P: usize> {
    n: usize,
    factor: Blocked<f64, P>,
    work: Vec<Column<f64>>,
}

impl<const P: usize> Estimate for OneStep<P> {
    fn push(&mut self, _: Step, block: Block, rows: usize, weight: f64) -> Result<(), Rejected> {
        Push { factor: &mut self.factor, block, rows, weight, work: &mut self.work }.done()
    }

    fn copy(&self) -> Box<dyn Estimate> {
        Box::new(self.clone())
    }

    fn stored(&self) -> Vec<Stored> {
        vec![Stored::of(&self.factor, self.n)]
    }

    fn absorb(&mut self, stored: &[Stored]) -> Result<(), NotTaken> {
        let [stored] = stored else { return Err(NotTaken::OtherSize) };
        stored.add_to(&mut self.factor, self.n)
    }

    fn coefficients(&self) -> Result<DVector<f64>, Unsolved> {
        let (n, factor) = (self.n, self.factor.factor());
        enough(Step::First, factor.samples(), n)?;
        let coefficients = factor.coefficients_of_first(n).map_err(|e| Unsolved::of(Step::First, e))?;
        Ok(leading(n, &coefficients))
    }

    fn solve(&self, sigma: Option<f64>) -> Result<Solved, Unsolved> {
        let (n, factor) = (self.n, self.factor.factor());
        let unsolved = |e| Unsolved::of(Step::First, e);
        enough(Step::First, factor.samples(), n)?;
        let unit = factor.estimate(n, Some(1.0)).map_err(unsolved)?.covariance;
        let solution = factor.estimate(n, sigma.map(|sigma| sigma * sigma)).map_err(unsolved)?;
        let condition = factor.condition_of_first(n).map_err(unsolved)?;
        Ok(solved(n, solution, condition, [unit, SMatrix::zeros()]))
    }
}

/// Two problems, the second with what the first gives.
#[derive(Clone)]
struct TwoSteps<const P: usize> {
    order: Order<P, P, P>,
    /// Of the second step, its own and those that it is given.
    columns: usize,
    first: Blocked<f64, P>,
    second: Blocked<f64, P>,
    work: Vec<Column<f64>>,
}

impl<const P: usize> TwoSteps<P> {
    fn unknowns(&self) -> usize {
        self.order.first().len() + self.order.own().len()
    }

    /// Whether there are enough samples in both steps.
    fn enough(&self, first: &Factor<f64, P>, second: &Factor<f64, P>) -> Result<(), Unsolved> {
        enough(Step::First, first.samples(), self.order.first().len())?;
        enough(Step::Second, second.samples(), self.order.own().len())
    }

    /// The columns of each step.
    fn widths(&self) -> [usize; 2] {
        [self.order.first().len(), self.columns]
    }
}

impl<const P: usize> Estimate for TwoSteps<P> {
    fn push(&mut self, step: Step, block: Block, rows: usize, weight: f64) -> Result<(), Rejected> {
        let factor = if step == Step::First { &mut self.first } else { &mut self.second };
        Push { factor, block, rows, weight, work: &mut self.work }.done()
    }

    fn copy(&self) -> Box<dyn Estimate> {
        Box::new(self.clone())
    }

    fn stored(&self) -> Vec<Stored> {
        let [first, second] = self.widths();
        vec![Stored::of(&self.first, first), Stored::of(&self.second, second)]
    }

    fn absorb(&mut self, stored: &[Stored]) -> Result<(), NotTaken> {
        let [first, second] = stored else { return Err(NotTaken::OtherSize) };
        let [in_first, in_second] = self.widths();
        // Both or none.
        let mut whole = self.second.clone();
        second.add_to(&mut whole, in_second)?;
        first.add_to(&mut self.first, in_first)?;
        self.second = whole;
        Ok(())
    }

    fn coefficients(&self) -> Result<DVector<f64>, Unsolved> {
        let (first, second) = (&self.first.factor(), &self.second.factor());
        self.enough(first, second)?;
        let coefficients = self.order.coefficients(first, second).map_err(Unsolved::in_step)?;
        Ok(leading(self.unknowns(), coefficients.as_slice()))
    }

    fn solve(&self, sigma: Option<f64>) -> Result<Solved, Unsolved> {
        let (order, first, second) = (&self.order, &self.first.factor(), &self.second.factor());
        self.enough(first, second)?;
        let solution = match sigma {
            None => order.solve(first, second),
            Some(sigma) => order.solve_with_sigma(first, second, sigma),
        };
        let solution = solution.map_err(Unsolved::in_step)?;
        let sensitivity = order.sensitivity(first, second).map_err(Unsolved::in_step)?;
        let condition = order.condition(first, second).map_err(Unsolved::in_step)?;
        Ok(solved(self.unknowns(), solution, condition, [sensitivity.first, sensitivity.second]))
    }
}

fn of<const P: usize>(n: usize, columns: &Columns) -> Option<Box<dyn Estimate>> {
    if columns.own.is_empty() {
        return Some(Box::new(OneStep::<P> { n, factor: Blocked::new(), work: room(n) }));
    }
    let order = Order::<P, P, P>::within(n, &columns.first, &columns.own, &columns.given).ok()?;
    let second = columns.own.len() + columns.given.len();
    let work = room(second.max(columns.first.len()));
    Some(Box::new(TwoSteps::<P> { order, columns: second, first: Blocked::new(), second: Blocked::new(), work }))
}

/// Columns to work in with blocks of so many.
fn room(columns: usize) -> Vec<Column<f64>> {
    vec![[0.0; ROWS]; columns + 1]
}

/// An estimator without samples for these columns, each coefficient one; `None` for none or more than [`LARGEST`].
pub fn estimator(columns: &Columns) -> Option<Box<dyn Estimate>> {
    let n = columns.first.len() + columns.own.len();
    // A factor may be wider than its columns: each width takes a second or more to compile.
    match n {
        1..=8 => of::<8>(n, columns),
        9..=16 => of::<16>(n, columns),
        17..=24 => of::<24>(n, columns),
        25..=32 => of::<32>(n, columns),
        33..=48 => of::<48>(n, columns),
        49..=LARGEST => of::<LARGEST>(n, columns),
        _ => None,
    }
}
