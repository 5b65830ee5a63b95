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
    /// One over D on the diagonal, zero where D is; R above it. Below it, where `rotate` says, what rounding has left out
    /// of R.
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
        self.rotate(0, row, y, weight.recip());
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
            let (mut row, mut v) = (*row, T::zero());
            if let Some((diagonal, before)) = row.get_mut(..=first).and_then(|row| row.split_last_mut()) {
                v = core::mem::replace(diagonal, T::one());
                before.fill(T::zero());
            }
            if v > T::zero() {
                self.rotate(first, row, y, v);
            }
        }
        self.rss += other.rss;
        Ok(())
    }

    /// D of column `j`: zero where there is none yet.
    #[inline(always)]
    pub(super) fn d(&self, j: usize) -> T {
        match self.dr.get(j).and_then(|row| row.get(j)) {
            Some(e) if *e > T::zero() => e.recip(),
            _ => T::zero(),
        }
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
