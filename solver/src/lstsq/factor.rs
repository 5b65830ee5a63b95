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
    q_low: [T; P],
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
    /// [`Rejected`], and the factor is unchanged, if a value is not finite, the weight negative, or the result would
    /// overflow.
    #[inline]
    pub fn push_weighted(&mut self, row: &SVector<T, P>, y: T, weight: T) -> Result<(), Rejected> {
        let [row] = row.data.0;
        if !row.iter().fold(y, |sum, &x| sum + x * T::zero()).is_finite() {
            return Err(Rejected::NotFinite);
        }
        if !(weight >= T::zero() && weight.is_finite()) {
            return Err(Rejected::Weight);
        }
        if weight == T::zero() {
            return Ok(());
        }
        let mut next = *self;
        next.rotate(0, row, y, weight);
        next.samples = self.samples.saturating_add(1);
        self.replace(next)
    }

    /// Makes this the factor of both data sets, as if the samples of `other` had been pushed here: same result up to
    /// rounding, in any order.
    ///
    /// # Errors
    /// [`Rejected::Overflow`], and this factor is unchanged.
    pub fn merge(&mut self, other: &Self) -> Result<(), Rejected> {
        let mut next = *self;
        for (first, (row, &y)) in other.dr.iter().zip(&other.q).enumerate() {
            let (mut row, mut weight) = (*row, T::zero());
            if let Some(diagonal) = row.get_mut(first) {
                weight = core::mem::replace(diagonal, T::one());
            }
            if weight > T::zero() {
                next.rotate(first, row, y, weight);
            }
        }
        next.rss += other.rss;
        next.samples = self.samples.saturating_add(other.samples);
        self.replace(next)
    }

    /// Rotates a weighted row into the factor; its entries before column `first` count as zero.
    #[inline(always)]
    fn rotate(&mut self, first: usize, mut x: [T; P], mut y: T, mut weight: T) {
        // Below this a squared entry has lost digits to underflow: the entry counts as zero.
        let tiny = T::min_positive_value() / T::epsilon();
        let half = T::of(0.5);
        for j in first..P {
            let xj = x[j];
            if xj == T::zero() {
                continue;
            }
            let d = self.dr[j][j];
            let wx = weight * xj;
            let sum = d + wx * xj;
            if sum <= tiny {
                continue;
            }
            let (c, s) = (d / sum, wx / sum);
            self.dr[j][j] = sum;
            let q = self.q[j];
            let y_rest = y - xj * q;
            // Where the old row dominates, adding the small correction rounds least; where the new one does, the old
            // row may be arbitrarily large beside it and must be damped before anything is added to it.
            if c > half {
                for k in j + 1..P {
                    let r = self.dr[j][k];
                    x[k] -= xj * r;
                    (self.dr[j][k], self.dr[k][j]) = add(r, s * x[k] + self.dr[k][j]);
                }
                (self.q[j], self.q_low[j]) = add(q, s * y_rest + self.q_low[j]);
            } else {
                for k in j + 1..P {
                    let r = self.dr[j][k];
                    (self.dr[j][k], self.dr[k][j]) = (c * r + s * x[k], T::zero());
                    x[k] -= xj * r;
                }
                (self.q[j], self.q_low[j]) = (c * q + s * y, T::zero());
            }
            y = y_rest;
            weight *= c;
            if weight == T::zero() {
                return;
            }
        }
        self.rss += weight * y * y;
    }

    /// Takes `next` for the state if all of it is finite.
    #[inline(always)]
    fn replace(&mut self, next: Self) -> Result<(), Rejected> {
        let mut finite = next.rss.is_finite();
        for (row, q) in next.dr.iter().zip(&next.q) {
            finite &= q.is_finite();
            for v in row {
                finite &= v.is_finite();
            }
        }
        if !finite {
            return Err(Rejected::Overflow);
        }
        *self = next;
        Ok(())
    }
}

/// The rounded sum, and what the rounding left out of it: exactly if `value` is the larger, else at least no more than
/// rounding leaves out anyway.
#[inline(always)]
fn add<T: Real>(value: T, change: T) -> (T, T) {
    let sum = value + change;
    (sum, change - (sum - value))
}
