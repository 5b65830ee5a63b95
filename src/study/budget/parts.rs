//! What sources of uncertainty hand on.

use crate::study::weights::Weights;
use nalgebra::{DMatrix, DVector};
use trunnion_codegen::algebra::ErrorId;

/// A source's uncorrelated parts: each column is what one standard deviation of a part adds to the base parameters.
pub(super) type Parts = DMatrix<f64>;

/// Standard uncertainty of `functional · base parameters` from these parts.
pub(super) fn std(parts: &Parts, functional: &DVector<f64>) -> f64 {
    parts.tr_mul(functional).norm()
}

/// Motion errors that are taken as zero or come without a table, each with its factors in every reading.
pub(in crate::study) type Ignored = Vec<(ErrorId, Vec<Vec<f64>>)>;

/// The most that a motion error within 1 mm or 1 rad, of whatever shape, adds through its factors in the readings.
pub(in crate::study) fn any_shape(weights: &Weights, factors: &[Vec<f64>]) -> f64 {
    let part = |(w, f): (&[f64], &Vec<f64>)| w.iter().zip(f).map(|(w, f)| (w * f).abs()).sum::<f64>();
    weights.observations().zip(factors).map(part).sum()
}
