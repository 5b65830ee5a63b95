//! The most that an error within its limit can add to a result.
//!
//! A motion error E is a sum of functions ψₖ with coefficients pₖ; the result has `Σ hₖ pₖ` in it. Any weights w over
//! coordinates with `Σ wᵢ ψₖ(xᵢ) = hₖ` for all k give `Σ hₖ pₖ = Σ wᵢ E(xᵢ)`, so that with |E| ≤ 1 it is at most `Σ |wᵢ|`; the
//! smallest such sum is the largest value. It is approached by least squares that are weighted anew with their own |w|.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Rounds of weighting anew: each gives a bound, the last is a few per cent above the smallest.
const ROUNDS: usize = 12;

/// An error's functions at the coordinates over which its limit holds: a row for each coordinate.
#[derive(Clone, Debug)]
pub struct Shape(DMatrix<f64>);

impl Shape {
    /// Of `functions` values at each of the coordinates.
    pub fn new(functions: usize, values: &[Vec<f64>]) -> Self {
        Self(DMatrix::from_fn(values.len(), functions, |i, k| values[i].get(k).copied().unwrap_or(0.0)))
    }

    /// The most that `Σ hₖ pₖ` can be with `|Σ pₖ ψₖ| ≤ 1` at every coordinate.
    pub fn largest(&self, h: &[f64]) -> f64 {
        let Self(psi) = self;
        let h = DVector::from_row_slice(h);
        if h.amax() == 0.0 || psi.nrows() == 0 {
            return 0.0;
        }
        let mut weights = DVector::from_element(psi.nrows(), 1.0);
        let mut bound = f64::INFINITY;
        for _ in 0..ROUNDS {
            let scaled = DMatrix::from_fn(psi.nrows(), psi.ncols(), |i, k| psi[(i, k)] * weights[i]);
            let normal = psi.tr_mul(&scaled);
            let eigen = SymmetricEigen::new(normal);
            let least = 1e-12 * eigen.eigenvalues.max();
            let inverse = eigen.eigenvalues.map(|value| if value > least { value.recip() } else { 0.0 });
            let z = &eigen.eigenvectors * inverse.component_mul(&eigen.eigenvectors.tr_mul(&h));
            let w = (psi * z).component_mul(&weights);
            let size = w.lp_norm(1);
            if !size.is_finite() || size >= bound * (1.0 - 1e-4) {
                bound = bound.min(size);
                break;
            }
            bound = size;
            weights = w.abs();
        }
        bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn circle(functions: &[fn(f64) -> f64]) -> Shape {
        let at = |i: usize| functions.iter().map(|f| f(TAU * i as f64 / 360.0)).collect();
        Shape::new(functions.len(), &(0..360).map(at).collect::<Vec<Vec<f64>>>())
    }

    #[test]
    fn one_harmonic_is_at_most_the_limit_and_two_may_hide_each_other() {
        let one = circle(&[f64::cos, f64::sin]);
        assert!((5.0..5.25).contains(&one.largest(&[3.0, 4.0])));
        // cos x + b cos 3x stays within 1 up to a coefficient of 2/√3 for cos x.
        let two = circle(&[f64::cos, |x| (3.0 * x).cos()]);
        let largest = two.largest(&[1.0, 0.0]);
        assert!((1.0..1.05).contains(&(largest / (2.0 / 3f64.sqrt()))), "{largest}");
    }

    #[test]
    fn no_error_within_its_limit_passes_it() {
        let shape = circle(&[f64::cos, f64::sin, |x| (2.0 * x).cos(), |x| (2.0 * x).sin()]);
        let h = [0.3, -1.2, 0.7, 0.1];
        let bound = shape.largest(&h);
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut nearest = 0.0f64;
        for _ in 0..20_000 {
            let p = [next(), next(), next(), next()];
            let largest = (shape.0.clone() * DVector::from_row_slice(&p)).amax();
            nearest = nearest.max(p.iter().zip(h).map(|(p, h)| p * h).sum::<f64>() / largest);
        }
        assert!(nearest <= bound && nearest > 0.9 * bound, "{nearest} of {bound}");
    }
}
