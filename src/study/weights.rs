//! How an estimate depends on the readings it was made from.

/// ∂ estimate / ∂ reading, for every sample of every observation of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(pub(super) Vec<Vec<f64>>);

impl Weights {
    /// Those of each observation's samples, in the order in which the fit was given them.
    pub fn observations(&self) -> impl Iterator<Item = &[f64]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// The estimate that these readings give, mm at every sample of every observation.
    pub fn apply(&self, readings: &[Vec<f64>]) -> f64 {
        let part = |(weights, y): (&[f64], &Vec<f64>)| weights.iter().zip(y).map(|(w, y)| w * y).sum::<f64>();
        self.observations().zip(readings).map(part).sum()
    }
}
