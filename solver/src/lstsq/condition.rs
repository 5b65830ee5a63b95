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
    /// As [`condition_of_first`](Self::condition_of_first).
    pub fn condition(&self) -> Result<Condition<T, P>, SolveError<P>> {
        self.condition_of_first::<P>()
    }

    /// Condition of the first `E` columns, scaled to unit norm: what matters to [`solve_given`](Self::solve_given).
    ///
    /// # Errors
    /// [`SolveError::RankDeficient`] if the columns are dependent (in which case the ratio would be that of two
    /// roundings), [`SolveError::NotFinite`] if their norms overflow.
    pub fn condition_of_first<const E: usize>(&self) -> Result<Condition<T, E>, SolveError<E>> {
        let triangle = Triangle::<T, E>::leading(self);
        triangle.independent(&triangle.inverse()).map_err(SolveError::RankDeficient)?;
        // Rows of the scaled factor A: rotating them into orthogonality (one-sided Jacobi on A') leaves each as a
        // singular value times its right singular vector.
        let mut rows = [[T::zero(); E]; E];
        for j in 0..E {
            let root = triangle.d[j].sqrt();
            rows[j][j] = root / triangle.norm2[j].sqrt();
            for k in j + 1..E {
                rows[j][k] = root * triangle.r[j][k] / triangle.norm2[k].sqrt();
            }
        }
        orthogonalise(&mut rows);

        let (mut largest, mut smallest, mut weakest) = (T::zero(), T::infinity(), [T::zero(); E]);
        for row in rows {
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

/// One-sided Jacobi: rotates pairs of rows until all are orthogonal to working precision.
fn orthogonalise<T: Real, const E: usize>(rows: &mut [[T; E]; E]) {
    let two = T::one() + T::one();
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for i in 0..E {
            for j in i + 1..E {
                let (a, b) = (rows[i], rows[j]);
                let (aa, bb, ab) = (dot(&a, &a), dot(&b, &b), dot(&a, &b));
                if ab.abs() <= T::epsilon() * aa.sqrt() * bb.sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (bb - aa) / (two * ab);
                let t = zeta.signum() / (zeta.abs() + (T::one() + zeta * zeta).sqrt());
                let c = T::one() / (T::one() + t * t).sqrt();
                let s = c * t;
                for (x, (&a, &b)) in rows[i].iter_mut().zip(a.iter().zip(&b)) {
                    *x = c * a - s * b;
                }
                for (x, (&a, &b)) in rows[j].iter_mut().zip(a.iter().zip(&b)) {
                    *x = s * a + c * b;
                }
            }
        }
        if !rotated {
            return;
        }
    }
}
