//! How well the data separate the coefficients, and which they separate worst.

use super::solution::dot;
use super::triangle::Triangle;
use super::{Factor, Real, SolveError, Subset};

/// Sweeps over all pairs of columns. Convergence is quadratic: five or six do; this only bounds the time.
const SWEEPS: usize = 16;

/// Condition of a design whose columns are scaled to unit norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition<T, const P: usize> {
    /// Ratio of the largest to the smallest singular value; 1 is best. Roughly, the relative error of the measurement
    /// is carried into the coefficients multiplied by this.
    pub number: T,
    /// The coefficients that take part in the combination which the data determine worst: those with at least a tenth
    /// of the right singular vector of the smallest singular value.
    pub weakest: Subset<P>,
}

impl<T: Real, const P: usize> Factor<T, P> {
    /// Condition of all `P` columns, scaled to unit norm.
    ///
    /// # Errors
    /// [`SolveError::RankDeficient`] if the columns are dependent (in which case the ratio would be that of two
    /// roundings), [`SolveError::NotFinite`] if their norms overflow.
    pub fn condition(&self) -> Result<Condition<T, P>, SolveError<P>> {
        self.condition_of_first(P)
    }

    /// Condition of the first `n` columns, as if there were no others.
    pub(crate) fn condition_of_first(&self, n: usize) -> Result<Condition<T, P>, SolveError<P>> {
        let triangle = Triangle::leading(self, n);
        triangle.independent().map_err(SolveError::RankDeficient)?;
        let (n, norm2) = (n.min(P), triangle.squared_norms());
        // Rows of the scaled factor A: rotating them into orthogonality (one-sided Jacobi on A') leaves each as a
        // singular value times its right singular vector.
        let mut rows = [[T::zero(); P]; P];
        for j in 0..n {
            let root = self.d(j).sqrt();
            rows[j][j] = root / norm2[j].sqrt();
            for k in j + 1..n {
                rows[j][k] = root * self.dr[j][k] / norm2[k].sqrt();
            }
        }
        orthogonalise(&mut rows, n);

        let (mut largest, mut smallest, mut weakest) = (T::zero(), T::infinity(), [T::zero(); P]);
        for row in rows.into_iter().take(n) {
            let norm2 = dot(&row, &row);
            largest = largest.max(norm2);
            if norm2 < smallest {
                (smallest, weakest) = (norm2, row);
            }
        }
        let number = (largest / smallest).sqrt();
        if !number.is_finite() {
            return Err(SolveError::NotFinite);
        }
        let notable = T::of(0.01) * smallest;
        Ok(Condition { number, weakest: Subset::from_mask(weakest.map(|v| v * v >= notable)) })
    }
}

/// One-sided Jacobi: rotates pairs of the first `n` rows until all are orthogonal to working precision.
fn orthogonalise<T: Real, const P: usize>(rows: &mut [[T; P]; P], n: usize) {
    let (n, two) = (n.min(P), T::one() + T::one());
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for i in 0..n {
            for j in i + 1..n {
                let (above, below) = rows.split_at_mut(j);
                let (Some(a), Some(b)) = (above.get_mut(i), below.first_mut()) else { continue };
                // What is behind is zero.
                let (a, b) = (&mut a[..n], &mut b[..n]);
                let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
                if ab.abs() <= T::epsilon() * aa.sqrt() * bb.sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (bb - aa) / (two * ab);
                let t = zeta.signum() / (zeta.abs() + (T::one() + zeta * zeta).sqrt());
                let c = T::one() / (T::one() + t * t).sqrt();
                let s = c * t;
                for (a, b) in a.iter_mut().zip(b) {
                    (*a, *b) = (c * *a - s * *b, s * *a + c * *b);
                }
            }
        }
        if !rotated {
            return;
        }
    }
}
