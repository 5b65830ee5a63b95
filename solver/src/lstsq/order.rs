//! Which base parameter each column of the two steps stands for.

use core::{error, fmt};

/// The columns of two steps: a first factor of width `F` and a second of width `S`, which together estimate `P` base
/// parameters. The first columns of the second factor are its own, the next are given by the first factor. A factor may be
/// wider than its columns; then the rest of each row must be zero.
///
/// ```
/// use trunnion_solver::lstsq::Order;
///
/// // Base parameters 2 and 3 are estimated first, then 0 and 1 with 3 given.
/// const ORDER: Order<4, 2, 3> = match Order::new(&[2, 3], &[0, 1], &[3]) {
///     Ok(order) => order,
///     Err(_) => panic!("not an order of two steps"),
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Order<const P: usize, const F: usize, const S: usize> {
    first: [usize; F],
    first_count: usize,
    own: [usize; S],
    pub(super) own_count: usize,
    /// For each column of the second factor that is given, the column of the first that gives it; else `F`.
    pub(super) source: [usize; S],
}

/// Why columns are not those of two steps; numbers are positions of base parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OrderError {
    /// More columns than a factor has.
    TooWide,
    /// There are not so many base parameters.
    OutOfRange(usize),
    /// Estimated twice, or given twice.
    Repeated(usize),
    /// Given, but not estimated in the first step.
    NotEstimated(usize),
    /// Estimated in neither step.
    Missing(usize),
}

impl<const P: usize, const F: usize, const S: usize> Order<P, F, S> {
    /// Base parameters (positions, `0..P`) of the first factor's columns, of the second factor's own, and of those that the
    /// first gives to the second.
    ///
    /// # Errors
    /// [`OrderError`]; as a constant's value it stops the compilation.
    pub const fn new(first: &[usize], own: &[usize], given: &[usize]) -> Result<Self, OrderError> {
        Self::within(P, first, own, given)
    }

    /// As [`new`](Self::new) for the first `n` base parameters; there is nothing beyond them.
    pub(crate) const fn within(n: usize, first: &[usize], own: &[usize], given: &[usize]) -> Result<Self, OrderError> {
        if first.len() > F || own.len() > S || given.len() > S - own.len() {
            return Err(OrderError::TooWide);
        }
        let mut order =
            Self { first: [0; F], first_count: first.len(), own: [0; S], own_count: own.len(), source: [F; S] };
        let mut column_of = [None; P];
        let mut estimated = [false; P];
        let mut i = 0;
        while i < first.len() + own.len() {
            let base = if i < first.len() { first[i] } else { own[i - first.len()] };
            if base >= P || base >= n {
                return Err(OrderError::OutOfRange(base));
            }
            if estimated[base] {
                return Err(OrderError::Repeated(base));
            }
            estimated[base] = true;
            if i < first.len() {
                order.first[i] = base;
                column_of[base] = Some(i);
            } else {
                order.own[i - first.len()] = base;
            }
            i += 1;
        }
        let mut base = 0;
        while base < P && base < n {
            if !estimated[base] {
                return Err(OrderError::Missing(base));
            }
            base += 1;
        }
        let mut j = 0;
        while j < given.len() {
            let base = given[j];
            if base >= P {
                return Err(OrderError::OutOfRange(base));
            }
            match column_of[base] {
                Some(column) if column == F => return Err(OrderError::Repeated(base)),
                Some(column) => order.source[own.len() + j] = column,
                None => return Err(OrderError::NotEstimated(base)),
            }
            // Taken: no factor has a column `F`.
            column_of[base] = Some(F);
            j += 1;
        }
        Ok(order)
    }

    /// Base parameters of the first factor's columns.
    pub fn first(&self) -> &[usize] {
        self.first.get(..self.first_count).unwrap_or(&[])
    }

    /// Base parameters of the second factor's own columns.
    pub fn own(&self) -> &[usize] {
        self.own.get(..self.own_count).unwrap_or(&[])
    }
}

impl fmt::Display for OrderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooWide => f.write_str("a step has more columns than its factor"),
            Self::OutOfRange(base) => write!(f, "there is no base parameter {base}"),
            Self::Repeated(base) => write!(f, "base parameter {base} is named twice"),
            Self::NotEstimated(base) => {
                write!(f, "base parameter {base} is given, but not estimated in the first step")
            }
            Self::Missing(base) => write!(f, "base parameter {base} is estimated in neither step"),
        }
    }
}

impl error::Error for OrderError {}
