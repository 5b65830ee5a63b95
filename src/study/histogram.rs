//! How often residuals of which size are, counted exactly in constant memory though nobody knows beforehand how large they get.

/// Bins of a count on either side of zero.
const HALF: usize = 5000;
/// Bins of a histogram within one robust standard deviation, about, of as many residuals as one likes.
const PER_DEVIATION: f64 = 4.0;
/// Of fewer the least width, in standard deviations, times the cube root of how many there are: Freedman and Diaconis have twice the
/// interquartile range, 2.7, which 1, 2 and 5 are rounded to by 1.6 at most.
const FEW: f64 = 2.7 / 1.6;
/// Robust standard deviations that a histogram shows on either side: beyond are the few that are counted together.
const SHOWN: f64 = 5.0;

/// Residuals counted in bins of one width.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// The lower end of the first bin, mm.
    pub from: f64,
    /// Width of each, mm.
    pub width: f64,
    /// Residuals in each; one on an end is in the upper bin.
    pub counts: Vec<usize>,
    /// Residuals below the first bin, and those above the last.
    pub beyond: [usize; 2],
}

impl Histogram {
    /// Of residuals of this standard deviation, mm.
    pub fn of(residuals: impl IntoIterator<Item = f64>, deviation: f64) -> Self {
        let mut counting = Counting::default();
        residuals.into_iter().for_each(|residual| counting.add(residual));
        counting.histogram(deviation)
    }
}

/// A width: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Width {
    digit: u32,
    power: i32,
}

impl Width {
    fn mm(self) -> f64 {
        let ten = 10f64.powi(self.power.abs());
        if self.power < 0 { f64::from(self.digit) / ten } else { f64::from(self.digit) * ten }
    }

    fn next(self) -> Self {
        match self.digit {
            1 => Self { digit: 2, ..self },
            2 => Self { digit: 5, ..self },
            _ => Self { digit: 1, power: self.power + 1 },
        }
    }

    /// How many of `finer` it is, if they fit.
    fn of(self, finer: Self) -> Option<i64> {
        let ten = 10_i64.checked_pow(u32::try_from(self.power - finer.power).ok()?)?;
        let whole = i64::from(self.digit).checked_mul(ten)?;
        (whole % i64::from(finer.digit) == 0).then(|| whole / i64::from(finer.digit))
    }
}

/// A count on its way.
#[derive(Clone, Debug, Default)]
pub(super) struct Counting {
    /// None before the first residual that is not zero.
    width: Option<Width>,
    counts: Vec<usize>,
    zeros: usize,
}

impl Counting {
    /// The next residual, mm.
    pub fn add(&mut self, residual: f64) {
        if residual == 0.0 || !residual.is_finite() {
            self.zeros += 1;
            return;
        }
        let mut width = *self.width.get_or_insert_with(|| {
            self.counts = vec![0; 2 * HALF];
            // In the first bins: whatever comes later is larger, or makes no difference.
            Width { digit: 1, power: (residual.abs().log10().floor() as i32 - 3).max(-300) }
        });
        let at = loop {
            let bin = (residual / width.mm()).floor();
            if bin >= -(HALF as f64) && bin < HALF as f64 {
                break bin as i64;
            }
            width = self.coarser(width);
        };
        self.counts[(at + HALF as i64) as usize] += 1;
    }

    /// Puts bins together, two or five.
    fn coarser(&mut self, from: Width) -> Width {
        let to = if from.digit == 1 { from.next() } else { Width { digit: 1, power: from.power + 1 } };
        let Some(each) = to.of(from) else { return from };
        let before = std::mem::replace(&mut self.counts, vec![0; 2 * HALF]);
        for (bin, count) in (-(HALF as i64)..).zip(before).filter(|(_, count)| *count > 0) {
            self.counts[(bin.div_euclid(each) + HALF as i64) as usize] += count;
        }
        self.width = Some(to);
        to
    }

    /// What was counted, in bins that suit this robust standard deviation, mm.
    pub fn histogram(&self, deviation: f64) -> Histogram {
        let Some(fine) = self.width else { return Histogram::default() };
        let counted = self.zeros + self.counts.iter().sum::<usize>();
        let least = (deviation * (FEW / (counted as f64).cbrt()).max(1.0 / PER_DEVIATION)).max(fine.mm());
        let mut width = fine;
        while width.mm() < least * (1.0 - 1e-9) || width.of(fine).is_none() {
            width = width.next();
        }
        let each = width.of(fine).unwrap_or(1);
        let most = if deviation > 0.0 { (SHOWN * deviation / width.mm()).ceil() as i64 } else { i64::MAX };
        let mut bins: std::collections::BTreeMap<i64, usize> = std::collections::BTreeMap::new();
        let zeros = (self.zeros > 0).then_some((0, self.zeros));
        let fine = (-(HALF as i64)..).zip(self.counts.iter().copied()).filter(|(_, count)| *count > 0);
        for (bin, count) in fine.map(|(bin, count)| (bin.div_euclid(each), count)).chain(zeros) {
            *bins.entry(bin).or_default() += count;
        }
        let shown = |bin: &i64| -most <= *bin && *bin < most;
        let first = bins.keys().copied().find(shown).unwrap_or(0);
        let last = bins.keys().copied().rfind(shown).unwrap_or(-1);
        let beyond = [bins.range(..first).map(|(_, n)| n).sum(), bins.range(last + 1..).map(|(_, n)| n).sum()];
        let counts = (first..=last).map(|bin| bins.get(&bin).copied().unwrap_or(0)).collect();
        Histogram { from: first as f64 * width.mm(), width: width.mm(), counts, beyond }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_residual_is_in_its_bin() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        // Small ones first, then larger ones, zeros and outliers.
        let mut residuals: Vec<f64> = (0..1000).map(|_| 1e-6 * next()).collect();
        residuals.extend((0..3000).map(|_| 1e-4 * (next() + next() + next())));
        residuals.extend([0.0, 0.0, 0.02, -0.03]);
        let Histogram { from, width, counts, beyond } = Histogram::of(residuals.iter().copied(), 1e-4);
        assert_eq!((width, beyond), (5e-5, [1, 1]));
        for (bin, count) in counts.iter().enumerate() {
            let low = from + bin as f64 * width;
            // Ends are worked out otherwise here: what is on one may be in either.
            let inside =
                |slack: f64| residuals.iter().filter(|r| low - slack <= **r && **r < low + width + slack).count();
            assert!(inside(-1e-15) <= *count && *count <= inside(1e-15), "{bin}: {count}");
        }
        assert_eq!(counts.iter().sum::<usize>() + 2, residuals.len());
    }

    #[test]
    fn few_residuals_have_few_bins() {
        let residuals = |n: i32| (0..n).map(move |k| 1e-4 * f64::from((k * 7919) % n - n / 2) / f64::from(n));
        let widths = [27, 300, 100_000].map(|n| Histogram::of(residuals(n), 1e-4).width);
        assert_eq!(widths, [1e-4, 5e-5, 5e-5]);
        assert_eq!(Histogram::of(residuals(27), 1e-4).counts, [13, 14]);
    }

    #[test]
    fn nothing_and_zeros_have_no_bins() {
        let mut counting = Counting::default();
        counting.add(0.0);
        assert_eq!(counting.histogram(0.0), Histogram::default());
        counting.add(3e-7);
        assert_eq!(counting.histogram(0.0).counts.iter().sum::<usize>(), 2);
    }
}
