//! Rows rotated into a factor, two columns at a time.
//!
//! A row x with reading y and weight 1/v meets row r of the factor, whose D is 1/e:
//!
//! ```text
//! b  = x_j² e          v' = v + b           e' = e v / v'
//! x' = x − x_j r       s  = x_j e / v'      r' = r + s x'
//! ```
//!
//! With reciprocals of D and of the weight nothing but additions leads from one column's v to the next: the only division, by v',
//! waits for nothing before it and nothing waits for it but r. A rotation takes as long as its arithmetic.
//!
//! Nothing overflows, so nothing has to be taken back. A rotation keeps `r_k²/e + x_k²/v` of every column k, so with
//! N² = 2³² [`MOST`](Real::MOST) at or above the sum of `w x_k²` over all samples,
//!
//! ```text
//! |r_k| ≤ N √e,  |x_k| ≤ N √v,  e and v at or below 1/LEAST  ⇒  |r_k|, |x_k| ≤ N/√LEAST
//! ```
//!
//! and every product that a row is changed by is the difference of two such numbers. In `f32` that is 2¹¹¹, in `f64` 2⁸¹⁶: what is
//! left to the end of the range is more than rounding adds up to. Where b is beyond it, the new row dominates.
//!
//! What rounding has left out of R at `[j][k]` is kept below the diagonal, in blocks of two rows and columns that are as they are above
//! it, so that what belongs to neighbours of a row stands side by side: at `[k & !1 | j & 1][j & !1 | k & 1]`. In a block with the
//! diagonal, and in the last row where P is odd, it is at `[k][j]`.

use super::{Factor, Real};

impl<T: Real, const P: usize> Factor<T, P> {
    /// Rotates a weighted row into the factor; its entries before column `first` are zero. One over the weight is `v`.
    #[inline(always)]
    pub(super) fn rotate(&mut self, first: usize, mut x: [T; P], mut y: T, mut v: T) {
        let mut j = first & !1;
        while j < P {
            if !self.rotate_two(j, &mut x, &mut y, &mut v) {
                let Some(left) = self.rotate_one(j, &mut x, (y, v)) else { return };
                let Some(left) = self.rotate_one(j + 1, &mut x, left) else { return };
                (y, v) = left;
            }
            // Too little weight is left to matter.
            if v >= T::LEAST.recip() {
                return;
            }
            j += 2;
        }
        self.rss += y / v * y;
    }

    /// Columns `j`, even, and the next, where the rows of the factor dominate: adding a small correction to them rounds least. Whether
    /// they do.
    #[inline(always)]
    fn rotate_two(&mut self, j: usize, x: &mut [T; P], y: &mut T, v: &mut T) -> bool {
        let Some((above, below)) = self.dr.split_at_mut_checked(j + 2) else { return false };
        let [.., a, b] = above else { return false };
        let (x_a, e_a, r) = (x[j], a[j], a[j + 1]);
        let xe_a = x_a * e_a;
        let (b_a, x_b, e_b) = (x_a * xe_a, x[j + 1] - x_a * r, b[j + 1]);
        let xe_b = x_b * e_b;
        let (v_a, b_b) = (*v + b_a, x_b * xe_b);
        // Neither of these is zero without one of D or of x being so.
        if !(b_a > T::zero() && b_a < *v && b_b > T::zero() && b_b < v_a) {
            return false;
        }
        let v_b = v_a + b_b;
        let (per_a, per_b) = (v_a.recip(), v_b.recip());
        let (s_a, s_b) = (xe_a * per_a, xe_b * per_b);
        (a[j], b[j + 1]) = (e_a * (*v * per_a), e_b * (v_a * per_b));
        *v = v_b;
        (a[j + 1], b[j]) = add(r, s_a * x_b + b[j]);

        let (x, last_x) = x[j + 2..].as_chunks_mut::<2>();
        let ((a, last_a), (b, last_b)) = (a[j + 2..].as_chunks_mut::<2>(), b[j + 2..].as_chunks_mut::<2>());
        let (low, last_low) = below.as_chunks_mut::<2>();
        for (((x, a), b), low) in x.iter_mut().zip(a).zip(b).zip(low) {
            let [low_a, low_b] = low;
            let (low_a, low_b) = (&mut low_a[j..j + 2], &mut low_b[j..j + 2]);
            for k in 0..2 {
                x[k] -= x_a * a[k];
                (a[k], low_a[k]) = add(a[k], s_a * x[k] + low_a[k]);
                x[k] -= x_b * b[k];
                (b[k], low_b[k]) = add(b[k], s_b * x[k] + low_b[k]);
            }
        }
        for (((x, a), b), low) in last_x.iter_mut().zip(last_a).zip(last_b).zip(last_low) {
            *x -= x_a * *a;
            (*a, low[j]) = add(*a, s_a * *x + low[j]);
            *x -= x_b * *b;
            (*b, low[j + 1]) = add(*b, s_b * *x + low[j + 1]);
        }
        let (q, low) = (&mut self.q[j..j + 2], &mut self.q_low[j..j + 2]);
        *y -= x_a * q[0];
        (q[0], low[0]) = add(q[0], s_a * *y + low[0]);
        *y -= x_b * q[1];
        (q[1], low[1]) = add(q[1], s_b * *y + low[1]);
        true
    }

    /// Column `j`, if there is one, whatever dominates: what is left of the reading and of one over the weight, if anything is.
    #[inline(never)]
    fn rotate_one(&mut self, j: usize, x: &mut [T; P], (mut y, v): (T, T)) -> Option<(T, T)> {
        let Some(&x_j) = x.get(j).filter(|x_j| **x_j != T::zero()) else { return Some((y, v)) };
        let (e, q) = (self.dr[j][j], self.q[j]);
        let xe = x_j * e;
        let b = x_j * xe;
        if e > T::zero() && b < v {
            let v_j = v + b;
            let per_v = v_j.recip();
            let s = xe * per_v;
            self.dr[j][j] = e * (v * per_v);
            self.behind(j, x, |x, r, low| {
                *x -= x_j * *r;
                (*r, *low) = add(*r, s * *x + *low);
            });
            y -= x_j * q;
            (self.q[j], self.q_low[j]) = add(q, s * y + self.q_low[j]);
            return (v_j < T::LEAST.recip()).then_some((y, v_j));
        }
        // The new row dominates. The old one may be arbitrarily large beside it: it is damped before anything is added to it, and
        // what is left of the two goes on in units of the old row.
        let d = if e > T::zero() { e.recip() } else { T::zero() };
        let wx = x_j / v;
        let brought = wx * x_j;
        let sum = d + brought;
        // A squared entry that has lost its digits to underflow counts as zero.
        if sum <= T::LEAST {
            return Some((y, v));
        }
        let per_sum = sum.recip();
        let (c, s, per_x) = (d * per_sum, wx * per_sum, x_j.recip());
        self.dr[j][j] = per_sum;
        for (x, r) in x[j + 1..].iter_mut().zip(&mut self.dr[j][j + 1..]) {
            (*r, *x) = (c * *r + s * *x, *r - per_x * *x);
        }
        self.behind(j, x, |_, _, low| *low = T::zero());
        (self.q[j], self.q_low[j]) = (c * q + s * y, T::zero());
        let weight = c * brought;
        (weight > T::LEAST).then(|| (q - per_x * y, weight.recip()))
    }

    /// Every entry of a row behind column `j`, with R's and what rounding has left out of that.
    #[inline(always)]
    fn behind(&mut self, j: usize, x: &mut [T; P], mut each: impl FnMut(&mut T, &mut T, &mut T)) {
        let first = j & !1;
        let Some((above, below)) = self.dr.split_at_mut_checked(first + 2) else { return };
        let [.., even, odd] = above else { return };
        let own = if j == first {
            each(&mut x[j + 1], &mut even[j + 1], &mut odd[j]);
            even
        } else {
            odd
        };
        let (x, last_x) = x[first + 2..].as_chunks_mut::<2>();
        let (r, last_r) = own[first + 2..].as_chunks_mut::<2>();
        let (low, last_low) = below.as_chunks_mut::<2>();
        for ((x, r), low) in x.iter_mut().zip(r).zip(low) {
            let low = &mut low[j - first][first..first + 2];
            each(&mut x[0], &mut r[0], &mut low[0]);
            each(&mut x[1], &mut r[1], &mut low[1]);
        }
        for ((x, r), low) in last_x.iter_mut().zip(last_r).zip(last_low) {
            each(x, r, &mut low[j]);
        }
    }
}

/// The rounded sum, and what the rounding left out of it: exactly if `value` is the larger, else at least no more than
/// rounding leaves out anyway.
#[inline(always)]
fn add<T: Real>(value: T, change: T) -> (T, T) {
    let sum = value + change;
    (sum, change - (sum - value))
}
