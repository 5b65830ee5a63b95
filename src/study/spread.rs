//! How the largest errors of many drawn machines are distributed.

/// A distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// 95 % are smaller.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Distribution of `values`; `None` for no values.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let quantile = |p: f64| {
            let at = p * (values.len() - 1) as f64;
            let (low, high) = (values[at.floor() as usize], values[at.ceil() as usize]);
            low + (high - low) * at.fract()
        };
        let max = *values.last()?;
        Some(Self {
            mean: values.iter().sum::<f64>() / values.len() as f64,
            median: quantile(0.5),
            p95: quantile(0.95),
            max,
        })
    }
}
