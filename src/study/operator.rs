//! From readings to functions: an estimate is linear in the readings, so that its matrix serves every measurement along the same
//! runs.

use super::weights::Weights;

/// Numbers in so many sums that do not wait for each other.
const PART: usize = 8;

/// Combinations of the readings of all runs, which stand one behind the other.
pub(super) struct Operator {
    /// Readings, filled up to whole parts.
    length: usize,
    rows: Vec<f64>,
}

impl Operator {
    /// The combinations with these weights, in their order, of so many readings.
    pub fn new(readings: usize, weights: impl IntoIterator<Item = Weights>) -> Self {
        let length = readings.next_multiple_of(PART);
        let mut rows = Vec::new();
        for (i, weights) in weights.into_iter().enumerate() {
            rows.extend(weights.observations().flatten());
            rows.resize((i + 1) * length, 0.0);
        }
        Self { length, rows }
    }

    /// Room for readings.
    pub fn readings(&self) -> Vec<f64> {
        vec![0.0; self.length]
    }

    /// Room for combinations.
    pub fn combinations(&self) -> Vec<f64> {
        vec![0.0; self.rows.len() / self.length.max(1)]
    }

    /// Writes the combinations of readings with zeros behind the last one.
    pub fn apply(&self, readings: &[f64], combinations: &mut [f64]) {
        for (row, combination) in self.rows.chunks_exact(self.length.max(1)).zip(combinations) {
            let mut sums = [0.0; PART];
            for (weights, readings) in row.as_chunks::<PART>().0.iter().zip(readings.as_chunks::<PART>().0) {
                for (sum, (w, y)) in sums.iter_mut().zip(weights.iter().zip(readings)) {
                    *sum += w * y;
                }
            }
            *combination = sums.iter().sum();
        }
    }
}

/// A function's basis at points.
pub(super) struct Profile {
    terms: usize,
    /// For so many points after another, all terms of the basis; the last point is repeated.
    basis: Vec<[f64; PART]>,
}

impl Profile {
    /// Of the basis' values at every point.
    pub fn new(terms: usize, points: &[Vec<f64>]) -> Self {
        let part = |points: &[Vec<f64>]| -> Vec<[f64; PART]> {
            let term =
                |t: usize| std::array::from_fn(|i| points.get(i).or(points.last()).map_or(0.0, |point| point[t]));
            (0..terms).map(term).collect()
        };
        Self { terms, basis: points.chunks(PART).flat_map(part).collect() }
    }

    /// The largest size of the function with these coefficients.
    pub fn largest(&self, coefficients: &[f64]) -> f64 {
        let mut most = [0.0; PART];
        for part in self.basis.chunks_exact(self.terms.max(1)) {
            let mut values = [0.0; PART];
            for (basis, c) in part.iter().zip(coefficients) {
                values.iter_mut().zip(basis).for_each(|(value, b)| *value += b * c);
            }
            for (most, value) in most.iter_mut().zip(values.map(f64::abs)) {
                *most = if value > *most { value } else { *most };
            }
        }
        most.into_iter().fold(0.0, f64::max)
    }
}
