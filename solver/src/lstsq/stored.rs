//! A factor as numbers, to be kept or sent, and from them.

use super::{Factor, Real};

impl<T: Real, const P: usize> Factor<T, P> {
    /// How many numbers a factor of `n` columns is.
    pub const fn stored_len(n: usize) -> usize {
        n * (n + 2) + 1
    }

    /// The numbers of the first `n` columns, [`stored_len`](Self::stored_len) of them: for each column its row of D and R with what
    /// rounding has left out of R, then q and what rounding has left out of q; last the residual sum of squares.
    pub fn stored(&self, n: usize) -> impl Iterator<Item = T> {
        let n = n.min(P);
        let rows = self.dr.iter().take(n).flat_map(move |row| row.iter().take(n).copied());
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
        for row in factor.dr.iter_mut().take(n) {
            for entry in row.iter_mut().take(n) {
                *entry = numbers.next()?;
            }
        }
        for (q, low) in factor.q.iter_mut().zip(&mut factor.q_low).take(n) {
            (*q, *low) = (numbers.next()?, numbers.next()?);
        }
        factor.rss = numbers.next()?;
        (numbers.next().is_none() && factor.is_one()).then_some(factor)
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
            let d = row.get(j).copied().unwrap_or(T::zero());
            let (q, low) = (self.q.get(j), self.q_low.get(j));
            let above = row.iter().skip(j + 1).chain(q).chain(low);
            // What is left out of R stands below the diagonal, in the column of its row.
            let below = self.dr.iter().skip(j + 1).filter_map(|row| row.get(j));
            let mut all = above.chain(below);
            let kept = d == T::zero() || d > T::LEAST;
            kept && within(d) && all.all(|&r| r.is_finite() && (d == T::zero() || within(d * r * r)))
        });
        rows && within(self.rss)
    }
}
