//! Recorded data: the same factor, filled a block of rows at a time.

use super::preconditioned::Preconditioned;
use super::upper::Upper;
use super::{Column, Factor, Kernel, Portable, ROWS, Real, Rejected};

/// How often a triangle is added to before it is merged into the factor, where sums are compensated.
const GROUP: u32 = 256;

/// A [`Factor`] that takes blocks of rows.
///
/// A block goes into a triangle by Householder reflections (Golub and Van Loan, *Matrix Computations*, 5.2; one for each column, of
/// the triangle's row and all the block's): some ten times fewer operations wait for one another than with a rotation for each
/// row. With room to work in, blocks of rows that are like earlier ones go in by their products in the triangle's units, which is
/// as accurate and almost twice as fast again. It pays to let each block be rows from all over the recording: of `m` blocks, the
/// one at `b` every `m`-th row from `b` on. Triangles are [merged](Factor::merge) into the factor, which is that of all rows pushed
/// one by one, up to rounding.
#[derive(Clone, Debug)]
pub struct Blocked<T, const P: usize> {
    factor: Factor<T, P>,
    /// Of rows that are not in the factor yet, without those that are ahead.
    upper: Upper<T, P>,
    ahead: Preconditioned<T, P>,
    /// What the triangle's rows weigh.
    weight: T,
    /// How many columns they have: reflections and products leave those behind as they are, where an earlier row may have some.
    width: usize,
    /// How many they are, with those that are ahead.
    rows: u32,
    /// How often the triangle was added to.
    changes: u32,
    /// With how many rows it is tried again whether the triangle foretells a block.
    again: u32,
}

impl<T: Real, const P: usize> Default for Blocked<T, P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const P: usize> Blocked<T, P> {
    /// Of no rows.
    pub fn new() -> Self {
        let (factor, upper, ahead) = (Factor::new(), Upper::new(), Preconditioned::new());
        Self { factor, upper, ahead, weight: T::one(), width: 0, rows: 0, changes: 0, again: 0 }
    }

    /// Takes the first `rows` rows of a block, each with `weight`: `columns` are those of the factor from the first on (the
    /// others are zero), `y` the measured values. The block's contents are used up.
    ///
    /// # Errors
    /// As [`Factor::push_weighted`] for any of the rows; none is taken then.
    #[inline]
    pub fn push(
        &mut self,
        columns: &mut [Column<T>],
        y: &mut Column<T>,
        rows: usize,
        weight: T,
    ) -> Result<(), Rejected> {
        self.push_with(Portable, columns, y, rows, weight, &mut [])
    }

    /// As [`push`](Self::push), with another kernel than plain arithmetic, and with room to `work` in: as many columns as the
    /// block has, and one more.
    ///
    /// # Errors
    /// The same.
    #[inline(always)]
    pub fn push_with(
        &mut self,
        kernel: impl Kernel<T>,
        columns: &mut [Column<T>],
        y: &mut Column<T>,
        rows: usize,
        weight: T,
        work: &mut [Column<T>],
    ) -> Result<(), Rejected> {
        let rows = rows.min(ROWS);
        for column in columns.iter_mut().chain([&mut *y]) {
            column[rows..].fill(T::zero());
        }
        let width = columns.len().min(P);
        let alike = weight == self.weight && width == self.width;
        let tried = alike && self.rows >= self.again;
        if tried && self.ahead.take(kernel, &self.upper, columns, y, weight, work) {
            if self.ahead.is_full() {
                self.catch_up();
            }
        } else {
            acceptable(columns, y, weight)?;
            if weight == T::zero() {
                return Ok(());
            }
            self.catch_up();
            if !alike || self.changes >= GROUP {
                self.merge_triangle();
                (self.weight, self.width) = (weight, width);
            }
            self.upper.absorb(kernel, columns, y);
            self.changes += 1;
            if tried {
                self.again = self.rows.saturating_add(self.rows / 2);
            }
        }
        self.rows = self.rows.saturating_add(u32::try_from(rows).unwrap_or(u32::MAX));
        Ok(())
    }

    /// Takes all samples of another factor; of no rows yet, it is that factor to the bit.
    ///
    /// # Errors
    /// As [`Factor::merge`]; nothing is taken then.
    pub fn merge(&mut self, other: &Factor<T, P>) -> Result<(), Rejected> {
        self.merge_triangle();
        if self.factor.samples == 0 {
            self.factor = *other;
            return Ok(());
        }
        self.factor.merge(other)
    }

    /// The factor of all rows so far.
    pub fn factor(&self) -> Factor<T, P> {
        let (mut factor, mut upper) = (self.factor, self.upper);
        self.ahead.add_to(&mut upper);
        upper.add_to(&mut factor, self.rows, self.weight);
        factor
    }

    fn merge_triangle(&mut self) {
        if self.rows == 0 {
            return;
        }
        self.factor = self.factor();
        self.upper = Upper::new();
        self.ahead.clear();
        (self.rows, self.changes, self.again) = (0, 0, 0);
    }

    /// Adds the rows that are ahead to the triangle, which may then be changed.
    fn catch_up(&mut self) {
        if self.ahead.has_rows() {
            self.ahead.add_to(&mut self.upper);
            self.changes += 1;
        }
        self.ahead.clear();
    }
}

/// Whether a factor may take each row, as [`Factor::push_weighted`] asks.
#[inline(always)]
fn acceptable<T: Real>(columns: &[Column<T>], y: &Column<T>, weight: T) -> Result<(), Rejected> {
    let mut sizes = [T::zero(); ROWS];
    for column in columns.iter().chain([y]) {
        for (size, &x) in sizes.iter_mut().zip(column) {
            *size += x * x;
        }
    }
    let within = sizes.iter().fold(true, |within, &size| within & (weight * size <= T::MOST));
    if within && weight >= T::LEAST && weight <= T::LEAST.recip() {
        return Ok(());
    }
    if !columns.iter().chain([y]).all(|column| T::all_finite(column)) {
        Err(Rejected::NotFinite)
    } else if weight == T::zero() {
        Ok(())
    } else if !(weight >= T::LEAST && weight <= T::LEAST.recip()) {
        Err(Rejected::Weight)
    } else {
        Err(Rejected::Overflow)
    }
}
