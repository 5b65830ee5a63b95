//! The triangular factor: samples in, constant memory.

use super::{Real, Rejected};
use nalgebra::SVector;

/// Square-root-free triangular factor of a weighted least-squares problem in `P` unknowns, built sample by sample.
///
/// With design X, weights W and measurements y it holds the unit upper triangular R, the diagonal D, q and the residual
/// sum of squares, such that `X'WX = R'DR` and `X'Wy = R'Dq`: Gentleman's form of Givens rotations (J. Inst. Maths
/// Applics 12, 1973; Miller's AS 274). Neither X nor X'X is ever formed.
///
/// R and q are weighted means of all samples, changed less and less by each: their sums are compensated (Kahan), which
/// keeps `f32` as accurate after 36,000 samples as after 360 and takes the room that a triangle leaves free.
///
/// A push costs O(P²) whatever came before it, without a square root, a panic or a heap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor<T, const P: usize> {
    /// D on the diagonal, R above it. Below it, at `[k][j]`, what rounding has left out of R at `[j][k]`.
    pub(super) dr: [[T; P]; P],
    pub(super) q: [T; P],
    /// What rounding has left out of q.
    pub(super) q_low: [T; P],
    pub(super) rss: T,
    pub(super) samples: u32,
}

impl<const P: usize> Factor<f32, P> {
    /// The factor of no samples, as a constant.
    pub const EMPTY: Self = Self { dr: [[0.0; P]; P], q: [0.0; P], q_low: [0.0; P], rss: 0.0, samples: 0 };
}

impl<const P: usize> Factor<f64, P> {
    /// The factor of no samples, as a constant.
    pub const EMPTY: Self = Self { dr: [[0.0; P]; P], q: [0.0; P], q_low: [0.0; P], rss: 0.0, samples: 0 };
}

impl<T: Real, const P: usize> Default for Factor<T, P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const P: usize> Factor<T, P> {
    /// The factor of no samples.
    pub fn new() -> Self {
        Self { dr: [[T::zero(); P]; P], q: [T::zero(); P], q_low: [T::zero(); P], rss: T::zero(), samples: 0 }
    }

    /// Number of samples of positive weight taken.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Weighted sum of the squared residuals of the least-squares solution, in the square of the unit of `y`.
    pub fn residual_sum_of_squares(&self) -> T {
        self.rss
    }

    /// Takes the sample `row · x = y` with weight one.
    ///
    /// # Errors
    /// As [`push_weighted`](Self::push_weighted).
    #[inline]
    pub fn push(&mut self, row: &SVector<T, P>, y: T) -> Result<(), Rejected> {
        self.push_weighted(row, y, T::one())
    }

    /// Takes the sample `row · x = y` with `weight` (one over the variance of `y`, up to a common factor). A weight of
    /// zero is no sample. Zero entries of `row` cost next to nothing.
    ///
    /// # Errors
    /// [`Rejected`], and the factor is unchanged, if a value is not finite, the weight negative or beyond
    /// [`Real::LEAST`] and its inverse, or `weight · (|row|² + y²)` beyond [`Real::MOST`].
    #[inline]
    pub fn push_weighted(&mut self, row: &SVector<T, P>, y: T, weight: T) -> Result<(), Rejected> {
        let [row] = row.data.0;
        if !acceptable(&row, y, weight) {
            return if weight == T::zero() && is_finite(&row, y) { Ok(()) } else { Err(refusal(&row, y, weight)) };
        }
        self.rotate(0, row, y, weight);
        self.samples = self.samples.saturating_add(1);
        Ok(())
    }

    /// Makes this the factor of both data sets, as if the samples of `other` had been pushed here: same result up to
    /// rounding, in any order.
    ///
    /// # Errors
    /// [`Rejected::Overflow`], and this factor is unchanged, for more than `u32::MAX` samples together.
    pub fn merge(&mut self, other: &Self) -> Result<(), Rejected> {
        self.samples = self.samples.checked_add(other.samples).ok_or(Rejected::Overflow)?;
        for (first, (row, &y)) in other.dr.iter().zip(&other.q).enumerate() {
            let (mut row, mut weight) = (*row, T::zero());
            if let Some(diagonal) = row.get_mut(first) {
                weight = core::mem::replace(diagonal, T::one());
            }
            if weight > T::zero() {
                self.rotate(first, row, y, weight);
            }
        }
        self.rss += other.rss;
        Ok(())
    }

    /// Rotates a weighted row into the factor; its entries before column `first` count as zero.
    ///
    /// Nothing overflows, so nothing has to be taken back. A rotation keeps `d rₖ² + w xₖ²` of every column k, so with
    /// N² = 2³² [`MOST`](Real::MOST) at or above the sum of `w xₖ²` over all samples,
    ///
    /// ```text
    /// |rₖ| ≤ N/√d,  |xₖ| ≤ N/√w,  d and w at or above LEAST  ⇒  |rₖ|, |xₖ| ≤ N/√LEAST
    /// ```
    ///
    /// and every product below is the difference of two such numbers. In `f32` that is 2¹¹¹, in `f64` 2⁸¹⁶: what is left to
    /// the end of the range is more than rounding adds up to.
    #[inline(always)]
    pub(super) fn rotate(&mut self, first: usize, mut x: [T; P], mut y: T, mut weight: T) {
        for j in first..P {
            let xj = x[j];
            if xj == T::zero() {
                continue;
            }
            let d = self.dr[j][j];
            let wx = weight * xj;
            let brought = wx * xj;
            let sum = d + brought;
            // A squared entry that has lost its digits to underflow counts as zero.
            if sum <= T::LEAST {
                continue;
            }
            self.dr[j][j] = sum;
            let q = self.q[j];
            if brought < d {
                let per_sum = sum.recip();
                let s = wx * per_sum;
                weight *= d * per_sum;
                // The old row dominates: adding a small correction to it rounds least.
                for k in j + 1..P {
                    let r = self.dr[j][k];
                    x[k] -= xj * r;
                    (self.dr[j][k], self.dr[k][j]) = add(r, s * x[k] + self.dr[k][j]);
                }
                y -= xj * q;
                (self.q[j], self.q_low[j]) = add(q, s * y + self.q_low[j]);
            } else {
                // The new row does. The old one may be arbitrarily large beside it: it is damped before anything is added to
                // it, and what is left of the two goes on in units of the old row.
                let (c, s, per_x) = (d / sum, wx / sum, xj.recip());
                for k in j + 1..P {
                    let r = self.dr[j][k];
                    (self.dr[j][k], self.dr[k][j]) = (c * r + s * x[k], T::zero());
                    x[k] = r - per_x * x[k];
                }
                (self.q[j], self.q_low[j]) = (c * q + s * y, T::zero());
                y = q - per_x * y;
                weight = d * (brought / sum);
            }
            if weight <= T::LEAST {
                return;
            }
        }
        self.rss += weight * y * y;
    }
}

/// Whether a factor may take a sample: all finite and within the range of its arithmetic.
#[inline(always)]
fn acceptable<T: Real, const P: usize>(row: &[T; P], y: T, weight: T) -> bool {
    let size = row.iter().fold(y * y, |sum, &x| sum + x * x);
    // No comparison with NaN holds.
    weight >= T::LEAST && weight <= T::LEAST.recip() && weight * size <= T::MOST
}

#[inline]
fn is_finite<T: Real, const P: usize>(row: &[T; P], y: T) -> bool {
    T::all_finite(row) && y.is_finite()
}

#[cold]
fn refusal<T: Real, const P: usize>(row: &[T; P], y: T, weight: T) -> Rejected {
    if !is_finite(row, y) {
        Rejected::NotFinite
    } else if !(weight >= T::LEAST && weight <= T::LEAST.recip()) {
        Rejected::Weight
    } else {
        Rejected::Overflow
    }
}

/// The rounded sum, and what the rounding left out of it: exactly if `value` is the larger, else at least no more than
/// rounding leaves out anyway.
#[inline(always)]
fn add<T: Real>(value: T, change: T) -> (T, T) {
    let sum = value + change;
    (sum, change - (sum - value))
}
