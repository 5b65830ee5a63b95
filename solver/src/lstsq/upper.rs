//! A triangle with its right-hand side, and rows taken into it by reflections.

use super::columns::{add, add_and_dot, dot};
use super::{Column, Factor, Kernel, Real};
use core::array;

/// The triangle R of rows A, upper, and q of their readings y, such that `A'A = R'R` and `A'y = R'q`; signs are as reflections leave
/// them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Upper<T, const P: usize> {
    pub r: [[T; P]; P],
    pub q: [T; P],
    /// What the readings have left.
    pub rss: T,
}

impl<T: Real, const P: usize> Upper<T, P> {
    /// Of no rows.
    pub fn new() -> Self {
        Self { r: [[T::zero(); P]; P], q: [T::zero(); P], rss: T::zero() }
    }

    /// Adds its rows, so many and each with `weight`, to a factor: by a rotation for each row of the triangle, where the factor has rows.
    pub fn add_to(&self, factor: &mut Factor<T, P>, rows: u32, weight: T) {
        let is_empty = factor.samples == 0;
        for (j, (row, &q)) in self.r.iter().zip(&self.q).enumerate() {
            let diagonal = row.get(j).copied().unwrap_or(T::zero());
            let d = weight * diagonal * diagonal;
            if d > T::LEAST {
                let v = d.recip();
                let mut row = row.map(|r| r / diagonal);
                row[..j].fill(T::zero());
                if is_empty {
                    row[j] = v;
                    (factor.dr[j], factor.q[j]) = (row, q / diagonal);
                } else {
                    row[j] = T::one();
                    factor.rotate(j, row, q / diagonal, v);
                }
            }
        }
        factor.rss += weight * self.rss;
        factor.samples = factor.samples.saturating_add(rows);
    }

    /// Takes a block of rows by a reflection for each column. Those behind it are turned when the next one is at hand, with which their product is wanted
    /// by then: each is read and written once for a reflection.
    #[inline(always)]
    pub fn absorb<K: Kernel<T>>(&mut self, kernel: K, columns: &mut [Column<T>], y: &mut Column<T>) {
        let n = columns.len().min(P);
        let mut rest = &mut columns[..n];
        // What turns the columns behind it: the column that was reflected last, and how much of it is added to each.
        let mut last: Option<&Column<T>> = None;
        let (mut factors, mut of_y) = ([T::zero(); P], T::zero());
        for j in 0..n {
            let Some((own, behind)) = core::mem::take(&mut rest).split_first_mut() else { break };
            if let Some(last) = last {
                add(kernel, own, factors[j], last);
            }
            let own = &*own;
            let (pairs, odd) = behind.as_chunks_mut::<2>();
            let (pair_factors, odd_factor) = factors[j + 1..n].as_chunks_mut::<2>();
            for (factors, columns) in pair_factors.iter_mut().zip(pairs) {
                *factors = match last {
                    Some(last) => add_and_dot(kernel, columns, *factors, last, own),
                    None => [dot(kernel, &columns[0], own), dot(kernel, &columns[1], own)],
                };
            }
            for (factor, column) in odd_factor.iter_mut().zip(odd).chain([(&mut of_y, &mut *y)]) {
                *factor = match last {
                    Some(last) => {
                        let [product] = add_and_dot(kernel, array::from_mut(column), [*factor], last, own);
                        product
                    }
                    None => dot(kernel, column, own),
                };
            }
            let reflection = Reflection::new(&mut self.r[j][j], dot(kernel, own, own));
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
            add(kernel, y, of_y, last);
        }
        self.rss += dot(kernel, y, y);
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
