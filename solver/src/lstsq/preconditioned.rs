//! Rows added to a triangle by their products, in units of that triangle.

use super::columns::{dot, dots, substitute};
use super::upper::Upper;
use super::{Column, Kernel, Real};

/// As much as B'B may come to for each column: so many times the samples that the triangle has already.
const MOST_OF_A_COLUMN: f64 = 4.0;

/// Sums over rows A, with readings y, that are to be added to a triangle R with right-hand side q.
///
/// With `B = A R⁻¹` and `e = y − B q`, what the triangle leaves out of the readings,
///
/// ```text
/// R'R + A'A = R' (1 + B'B) R = (C R)' (C R),   C'C = 1 + B'B (Cholesky)
/// R'q + A'y = (C R)' (C q + z),                C'z = B'e
/// ```
///
/// and the rows add `e'e − z'z` to the residual sum of squares. Normal equations square a condition: here that of 1 + B'B, a small
/// number where the triangle is one of similar rows. Where it is not, the rows are not taken. Almost twice as fast as
/// reflections: no operation waits for a sum over a column (Yamamoto et al., *Roundoff error analysis of the CholeskyQR2
/// algorithm*, ETNA 44, 2015, has the second of two such steps).
#[derive(Clone, Debug)]
pub(super) struct Preconditioned<T, const P: usize> {
    /// How many columns the triangle has; none if there is none at hand.
    n: usize,
    /// Of each column, −1 times what is above the diagonal, and one over what is on it.
    units: [[T; P]; P],
    /// −q
    of_y: [T; P],
    /// Of all numbers in R and q.
    squares: T,
    sums: Products<T, P>,
}

impl<T: Real, const P: usize> Preconditioned<T, P> {
    /// Of no rows and no triangle.
    pub fn new() -> Self {
        let zero = T::zero();
        Self { n: 0, units: [[zero; P]; P], of_y: [zero; P], squares: zero, sums: Products::new() }
    }

    /// Forgets the triangle and its rows.
    pub fn clear(&mut self) {
        if self.n > 0 {
            (self.n, self.sums) = (0, Products::new());
        }
    }

    /// Takes a block of rows for a triangle, which has to stay as it is until they are [added](Self::add_to) to it; whether it did.
    /// There has to be a triangle of all columns, and a column to work in for each and for the readings.
    #[inline(always)]
    pub fn take<K: Kernel<T>>(
        &mut self,
        kernel: K,
        upper: &Upper<T, P>,
        columns: &[Column<T>],
        y: &Column<T>,
        weight: T,
        work: &mut [Column<T>],
    ) -> bool {
        let n = columns.len().min(P);
        let columns = columns.get(..n).unwrap_or(columns);
        let Some((e, b)) = work.get_mut(..=n).and_then(|work| work.split_last_mut()) else { return false };
        if self.n != n && !self.prepare(upper, n) {
            return false;
        }
        self.substituted(kernel, columns, y, b, e);
        let mut products = Products::new();
        products.set(kernel, b, e);
        let two = T::one() + T::one();
        // A = B R and y = e + B q: what bounds B and e bounds them. No comparison with NaN holds.
        let taken =
            products.trace(n) <= most(n) && weight * two * (most::<T>(n) * self.squares + products.yy) <= T::MOST;
        if taken {
            self.sums.add(n, &products);
        }
        taken
    }

    /// Whether rows wait to be added.
    pub fn has_rows(&self) -> bool {
        self.sums.yy > T::zero() || self.sums.trace(self.n) > T::zero()
    }

    /// Whether the rows are to be added before there are more.
    pub fn is_full(&self) -> bool {
        self.sums.trace(self.n) > most(self.n)
    }

    /// A triangle's units, if it has all its columns.
    #[cold]
    fn prepare(&mut self, upper: &Upper<T, P>, n: usize) -> bool {
        let n = n.min(P);
        self.squares = T::zero();
        for k in 0..n {
            let diagonal = upper.r[k][k];
            if diagonal * diagonal <= T::LEAST {
                return false;
            }
            for j in 0..k {
                self.units[k][j] = -upper.r[j][k];
            }
            self.units[k][k] = diagonal.recip();
            self.squares = upper.r[k][k..n].iter().chain(&upper.q[k..=k]).fold(self.squares, |sum, &x| sum + x * x);
        }
        self.of_y = upper.q.map(|q| -q);
        self.n = n;
        true
    }

    /// Solves `B R = A`, and `e = y − B q`: two columns at a time.
    #[inline(always)]
    fn substituted<K: Kernel<T>>(
        &self,
        kernel: K,
        columns: &[Column<T>],
        y: &Column<T>,
        b: &mut [Column<T>],
        e: &mut Column<T>,
    ) {
        let scale = |k: usize| self.units[k][k];
        let (pairs, odd) = columns.as_chunks::<2>();
        for (at, [first, second]) in pairs.iter().enumerate() {
            let k = 2 * at;
            let (done, rest) = b.split_at_mut(k);
            let Some(out) = rest.first_chunk_mut::<2>() else { return };
            let factors = [self.units[k].as_slice(), self.units[k + 1].as_slice()];
            substitute(kernel, [first, second], factors, [scale(k), scale(k + 1)], done, out);
        }
        if let [last] = odd {
            let Some((own, done)) = b.split_last_mut() else { return };
            let k = done.len();
            substitute(kernel, [last], [&self.units[k]], [scale(k)], done, core::array::from_mut(own));
        }
        substitute(kernel, [y], [&self.of_y], [T::one()], b, core::array::from_mut(e));
    }

    /// Makes the triangle that of its own rows and these.
    pub fn add_to(&self, upper: &mut Upper<T, P>) {
        let (n, mut c, mut z) = (self.n.min(P), self.sums.squares, self.sums.with_y);
        let mut explained = T::zero();
        for i in 0..n {
            c[i][i] += T::one();
            let (above, own) = c.split_at_mut(i);
            let Some(own) = own.first_mut() else { break };
            for (k, above) in above.iter().enumerate() {
                let factor = above[i];
                for j in i..n {
                    own[j] -= factor * above[j];
                }
                z[i] -= factor * z[k];
            }
            let root = own[i].sqrt();
            let per = root.recip();
            own[i] = root;
            own[i + 1..n].iter_mut().for_each(|own| *own *= per);
            z[i] *= per;
            explained += z[i] * z[i];
            // C R: a row of it needs the same and later rows of R.
            let mut row = [T::zero(); P];
            for k in i..n {
                let factor = own[k];
                for j in k..n {
                    row[j] += factor * upper.r[k][j];
                }
            }
            upper.q[i] = (i..n).fold(z[i], |q, k| q + own[k] * upper.q[k]);
            upper.r[i] = row;
        }
        upper.rss += (self.sums.yy - explained).max(T::zero());
    }
}

/// As much as the trace of B'B may be.
fn most<T: Real>(n: usize) -> T {
    T::of(MOST_OF_A_COLUMN) * T::of_count(u32::try_from(n).unwrap_or(u32::MAX))
}

/// Products of columns, and of columns with the readings.
#[derive(Clone, Debug)]
struct Products<T, const P: usize> {
    /// B'B, upper.
    squares: [[T; P]; P],
    /// B'e
    with_y: [T; P],
    /// e'e
    yy: T,
}

impl<T: Real, const P: usize> Products<T, P> {
    fn new() -> Self {
        Self { squares: [[T::zero(); P]; P], with_y: [T::zero(); P], yy: T::zero() }
    }

    /// Those of a block.
    #[inline(always)]
    fn set<K: Kernel<T>>(&mut self, kernel: K, b: &[Column<T>], e: &Column<T>) {
        self.yy = dot(kernel, e, e);
        for i in (0..b.len()).step_by(2) {
            match &b[i..] {
                [first, second, ..] => self.set_two(kernel, i, [first, second], b, e),
                [last] => {
                    self.squares[i][i] = dot(kernel, last, last);
                    self.with_y[i] = dot(kernel, last, e);
                }
                [] => {}
            }
        }
    }

    /// Of two columns, `i` and the next, with themselves, those behind them, and the readings: so many at a time that the sums do not
    /// wait for each other.
    #[inline(always)]
    fn set_two<K: Kernel<T>>(&mut self, kernel: K, i: usize, two: [&Column<T>; 2], b: &[Column<T>], e: &Column<T>) {
        let (mut k, mut rest) = (i, b.get(i..).unwrap_or_default());
        loop {
            match rest {
                [p, q] => return self.put_last(i, k, dots(kernel, two, [p, q, e])),
                [p, q, r] => return self.put_last(i, k, dots(kernel, two, [p, q, r, e])),
                [p, q, r, s] => return self.put_last(i, k, dots(kernel, two, [p, q, r, s, e])),
                [p, q, r, s, t] => return self.put_last(i, k, dots(kernel, two, [p, q, r, s, t, e])),
                [p, q, r, s, others @ ..] => {
                    self.put(i, k, &dots(kernel, two, [p, q, r, s]));
                    (k, rest) = (k + 4, others);
                }
                _ => return,
            }
        }
    }

    /// Products of columns `i` and the next with those from `k` on.
    #[inline(always)]
    fn put<const N: usize>(&mut self, i: usize, k: usize, products: &[[T; N]; 2]) {
        for (squares, products) in self.squares.iter_mut().skip(i).zip(products) {
            squares.iter_mut().skip(k).zip(products).for_each(|(square, &product)| *square = product);
        }
    }

    /// The same, the last ones with the readings.
    #[inline(always)]
    fn put_last<const N: usize>(&mut self, i: usize, k: usize, products: [[T; N]; 2]) {
        for m in 0..2 {
            for j in 0..N - 1 {
                self.squares[i + m][k + j] = products[m][j];
            }
            self.with_y[i + m] = products[m][N - 1];
        }
    }

    /// Adds those of `n` columns.
    fn add(&mut self, n: usize, other: &Self) {
        for (i, (sums, products)) in self.squares.iter_mut().zip(&other.squares).take(n).enumerate() {
            let sums = sums.iter_mut().zip(products).take(n).skip(i);
            sums.for_each(|(sum, &product)| *sum += product);
        }
        self.with_y.iter_mut().zip(other.with_y).take(n).for_each(|(sum, product)| *sum += product);
        self.yy += other.yy;
    }

    fn trace(&self, n: usize) -> T {
        self.squares.iter().enumerate().take(n).filter_map(|(k, row)| row.get(k)).fold(T::zero(), |sum, &x| sum + x)
    }
}
