//! Recorded data: the same factor, filled a block of rows at a time.

use super::{Factor, Real, Rejected};

/// Rows of a block.
pub const ROWS: usize = 128;
/// Blocks whose triangle goes on before it is merged into the factor, where sums are compensated.
const GROUP: u32 = 16;

/// A column of a block.
pub type Column<T> = [T; ROWS];

/// A [`Factor`] that takes blocks of rows.
///
/// A block goes into a triangle by Householder reflections (Golub and Van Loan, *Matrix Computations*, 5.2; one for each column, of
/// the triangle's row and all the block's): some ten times fewer operations wait for one another than with a rotation for each
/// row. Groups of blocks are [merged](Factor::merge) into the factor, which is that of all rows pushed one by one, up to
/// rounding.
#[derive(Clone, Debug)]
pub struct Blocked<T, const P: usize> {
    factor: Factor<T, P>,
    /// The group's triangle, upper, with the reflections' signs.
    r: [[T; P]; P],
    q: [T; P],
    rss: T,
    /// What the group's rows weigh.
    weight: T,
    rows: u32,
    blocks: u32,
}

impl<T: Real, const P: usize> Default for Blocked<T, P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const P: usize> Blocked<T, P> {
    /// Of no rows.
    pub fn new() -> Self {
        let zero = T::zero();
        let factor = Factor::new();
        Self { factor, r: [[zero; P]; P], q: [zero; P], rss: zero, weight: T::one(), rows: 0, blocks: 0 }
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
        self.push_with(Portable, columns, y, rows, weight)
    }

    /// As [`push`](Self::push), with another kernel than plain loops.
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
    ) -> Result<(), Rejected> {
        let rows = rows.min(ROWS);
        for column in columns.iter_mut().chain([&mut *y]) {
            column[rows..].fill(T::zero());
        }
        acceptable(columns, y, weight)?;
        if weight == T::zero() {
            return Ok(());
        }
        if weight != self.weight || self.blocks == GROUP {
            self.merge_group();
            self.weight = weight;
        }
        self.absorb(kernel, columns, y);
        self.rows = self.rows.saturating_add(u32::try_from(rows).unwrap_or(u32::MAX));
        self.blocks += 1;
        Ok(())
    }

    /// Takes all samples of another factor; of no rows yet, it is that factor to the bit.
    ///
    /// # Errors
    /// As [`Factor::merge`]; nothing is taken then.
    pub fn merge(&mut self, other: &Factor<T, P>) -> Result<(), Rejected> {
        self.merge_group();
        if self.factor.samples == 0 {
            self.factor = *other;
            return Ok(());
        }
        self.factor.merge(other)
    }

    /// The factor of all rows so far.
    pub fn factor(&self) -> Factor<T, P> {
        let mut all = self.clone();
        all.merge_group();
        all.factor
    }

    /// A rotation for each row of the group's triangle.
    fn merge_group(&mut self) {
        for (j, (row, &q)) in self.r.iter().zip(&self.q).enumerate() {
            let diagonal = row.get(j).copied().unwrap_or(T::zero());
            let d = self.weight * diagonal * diagonal;
            if d > T::LEAST {
                let per = diagonal.recip();
                let mut row = row.map(|r| r * per);
                row[..=j].fill(T::zero());
                row[j] = T::one();
                self.factor.rotate(j, row, q * per, d);
            }
        }
        self.factor.rss += self.weight * self.rss;
        self.factor.samples = self.factor.samples.saturating_add(self.rows);
        (self.r, self.q, self.rss) = ([[T::zero(); P]; P], [T::zero(); P], T::zero());
        (self.rows, self.blocks) = (0, 0);
    }

    /// A reflection for each column. Those behind it are turned when the next one is at hand, with which their product is wanted
    /// by then: each is read and written once for a reflection.
    #[inline(always)]
    fn absorb(&mut self, kernel: impl Kernel<T>, columns: &mut [Column<T>], y: &mut Column<T>) {
        let n = columns.len().min(P);
        let mut rest = &mut columns[..n];
        // What turns the columns behind it: the column that was reflected last, and how much of it is added to each.
        let mut last: Option<&Column<T>> = None;
        let (mut factors, mut of_y) = ([T::zero(); P], T::zero());
        for j in 0..n {
            let Some((own, behind)) = core::mem::take(&mut rest).split_first_mut() else { break };
            if let Some(last) = last {
                kernel.add(own, factors[j], last);
            }
            let own = &*own;
            let (pairs, odd) = behind.as_chunks_mut::<2>();
            let (pair_factors, odd_factor) = factors[j + 1..n].as_chunks_mut::<2>();
            for (factors, columns) in pair_factors.iter_mut().zip(pairs) {
                *factors = match last {
                    Some(last) => kernel.add_and_dot_both(columns, *factors, last, own),
                    None => [kernel.dot(&columns[0], own), kernel.dot(&columns[1], own)],
                };
            }
            for (factor, column) in odd_factor.iter_mut().zip(odd).chain([(&mut of_y, &mut *y)]) {
                *factor = match last {
                    Some(last) => kernel.add_and_dot(column, *factor, last, own),
                    None => kernel.dot(column, own),
                };
            }
            let reflection = Reflection::new(&mut self.r[j][j], kernel.dot(own, own));
            if let Some(reflection) = &reflection {
                for k in j + 1..n {
                    factors[k] = reflection.factor(&mut self.r[j][k], factors[k]);
                }
                of_y = reflection.factor(&mut self.q[j], of_y);
            }
            last = reflection.map(|_| own);
            rest = behind;
        }
        if let Some(last) = last {
            kernel.add(y, of_y, last);
        }
        self.rss += kernel.dot(y, y);
    }
}

/// The reflection that takes a column below the triangle away.
struct Reflection<T> {
    /// 1/v₀ of the vector (v₀, column).
    per_v0: T,
    tau: T,
}

impl<T: Real> Reflection<T> {
    /// From the triangle's diagonal, which becomes the column's norm, and the squares of the column; none of a column that is zero.
    #[inline(always)]
    fn new(diagonal: &mut T, squares: T) -> Option<Self> {
        if squares <= T::LEAST {
            return None;
        }
        let alpha = *diagonal;
        let norm = (alpha * alpha + squares).sqrt();
        let beta = if alpha > T::zero() { -norm } else { norm };
        *diagonal = beta;
        Some(Self { per_v0: (alpha - beta).recip(), tau: (beta - alpha) / beta })
    }

    /// Turns the triangle's entry of another column, whose product with the reflected one is given; what of that is to be added to
    /// the other.
    #[inline(always)]
    fn factor(&self, entry: &mut T, product: T) -> T {
        let w = (*entry + product * self.per_v0) * self.tau;
        *entry -= w;
        -(w * self.per_v0)
    }
}

/// What a reflection does with columns, on whatever the processor has for it.
pub trait Kernel<T>: Copy {
    /// Product of two columns.
    fn dot(self, a: &Column<T>, b: &Column<T>) -> T;

    /// `column + factor · own`.
    fn add(self, column: &mut Column<T>, factor: T, own: &Column<T>);

    /// [`add`](Self::add), and the product of what comes out with `next`.
    fn add_and_dot(self, column: &mut Column<T>, factor: T, own: &Column<T>, next: &Column<T>) -> T;

    /// The same for two columns: the others are read once for both.
    #[inline(always)]
    fn add_and_dot_both(
        self,
        [a, b]: &mut [Column<T>; 2],
        [of_a, of_b]: [T; 2],
        own: &Column<T>,
        next: &Column<T>,
    ) -> [T; 2] {
        [self.add_and_dot(a, of_a, own, next), self.add_and_dot(b, of_b, own, next)]
    }
}

/// Plain loops, for any processor.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

/// Sums are kept in so many parts, which do not wait for each other.
const PARTS: usize = 8;

impl<T: Real> Kernel<T> for Portable {
    #[inline(always)]
    fn dot(self, a: &Column<T>, b: &Column<T>) -> T {
        let mut sums = [T::zero(); PARTS];
        for (a, b) in a.as_chunks::<PARTS>().0.iter().zip(b.as_chunks::<PARTS>().0) {
            for l in 0..PARTS {
                sums[l] += a[l] * b[l];
            }
        }
        total(sums)
    }

    #[inline(always)]
    fn add(self, column: &mut Column<T>, factor: T, own: &Column<T>) {
        for (x, &v) in column.iter_mut().zip(own) {
            *x += factor * v;
        }
    }

    #[inline(always)]
    fn add_and_dot(self, column: &mut Column<T>, factor: T, own: &Column<T>, next: &Column<T>) -> T {
        let mut sums = [T::zero(); PARTS];
        let (own, next) = (own.as_chunks::<PARTS>().0, next.as_chunks::<PARTS>().0);
        for ((x, v), u) in column.as_chunks_mut::<PARTS>().0.iter_mut().zip(own).zip(next) {
            for l in 0..PARTS {
                x[l] += factor * v[l];
                sums[l] += x[l] * u[l];
            }
        }
        total(sums)
    }
}

#[inline(always)]
fn total<T: Real>([a, b, c, d, e, f, g, h]: [T; PARTS]) -> T {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
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
