//! A factor as numbers, to be kept or sent, and from them.

use super::{Factor, Real};

impl<T: Real, const P: usize> Factor<T, P> {
    /// How many numbers a factor of `n` columns is.
    pub const fn stored_len(n: usize) -> usize {
        n * (n + 2) + 1
    }

    /// The numbers of the first `n` columns, [`stored_len`](Self::stored_len) of them: for each column one over its D, zero where D is,
    /// behind that its row of R, before it what rounding has left out of R in that column; then q and what rounding has left out of q; last the residual sum of squares.
    pub fn stored(&self, n: usize) -> impl Iterator<Item = T> {
        let n = n.min(P);
        let rows = self.dr.iter().take(n).enumerate().flat_map(move |(j, row)| {
            row.iter().take(n).enumerate().map(move |(k, &r)| if k < j { self.low(k, j) } else { r })
        });
        let q = self.q.iter().take(n).zip(self.q_low.iter().take(n)).flat_map(|(&q, &low)| [q, low]);
        rows.chain(q).chain([self.rss])
    }

    /// The factor of `samples` samples whose [`stored`](Self::stored) numbers these are; `None` where they are none of a factor:
    /// too few or too many, not finite, or beyond what samples within the range of the arithmetic make.
    pub fn of_stored(n: usize, numbers: impl IntoIterator<Item = T>, samples: u32) -> Option<Self> {
        if n > P {
            return None;
        }
        let mut factor = Self { samples, ..Self::new() };
        let mut numbers = numbers.into_iter();
        for j in 0..n {
            for k in 0..n {
                let (at, of) = if k < j { low_at::<P>(k, j) } else { (j, k) };
                *factor.dr.get_mut(at)?.get_mut(of)? = numbers.next()?;
            }
        }
        for (q, low) in factor.q.iter_mut().zip(&mut factor.q_low).take(n) {
            (*q, *low) = (numbers.next()?, numbers.next()?);
        }
        factor.rss = numbers.next()?;
        (numbers.next().is_none() && factor.is_one()).then_some(factor)
    }

    /// What rounding has left out of R at `[j][k]`.
    fn low(&self, j: usize, k: usize) -> T {
        let (at, of) = low_at::<P>(j, k);
        self.dr.get(at).and_then(|row| row.get(of)).copied().unwrap_or(T::zero())
    }

    /// Whether it is within what pushing keeps: d·r² and d·q² of all samples together at most [`Real::MOST`] a sample, see
    /// `rotate`.
    fn is_one(&self) -> bool {
        let samples = T::of_count(self.samples.max(1));
        // Rounding adds to each.
        let most = (samples + samples) * T::MOST;
        // No comparison with NaN holds.
        let within = |x: T| x >= T::zero() && x <= most;
        let rows = self.dr.iter().enumerate().all(|(j, row)| {
            let e = row.get(j).copied().unwrap_or(T::zero());
            let (q, low) = (self.q.get(j), self.q_low.get(j));
            let lows = (j + 1..P).map(|k| self.low(j, k));
            let mut all = row.iter().skip(j + 1).chain(q).chain(low).copied().chain(lows);
            let kept = e == T::zero() || (e > T::zero() && e < T::LEAST.recip() && within(e.recip()));
            kept && all.all(|r| r.is_finite() && (e == T::zero() || within(r / e * r)))
        });
        rows && within(self.rss)
    }
}

/// Where a factor keeps what rounding has left out of R at `[j][k]`, see `rotate`.
fn low_at<const P: usize>(j: usize, k: usize) -> (usize, usize) {
    // Two of the same block, and an odd last column, stand as in the transpose.
    if j | 1 == k | 1 || k | 1 >= P { (k, j) } else { (k & !1 | j & 1, j & !1 | k & 1) }
}
