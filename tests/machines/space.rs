//! Dense least squares by singular values: what a matrix tells of its parameters, and its solution.

use nalgebra::{DMatrix, DVector, RowDVector};

/// Singular values above this share of the largest count, below the other they are zero, and none may be between.
const COUNTS: f64 = 1e-10;
const VANISHES: f64 = 1e-12;

/// `A x = r` with x within a given space.
pub struct Space {
    /// Estimate per reading: the solution of least squares, shortest where there are many.
    pub inverse: DMatrix<f64>,
    /// Directions within the space that A does not see.
    pub null: DMatrix<f64>,
    pub rank: usize,
    /// Largest over smallest singular value that counts.
    pub condition: f64,
    within: DMatrix<f64>,
}

impl Space {
    /// x in the span of the columns of `within`.
    ///
    /// # Panics
    /// The rank is not clear.
    pub fn new(a: &DMatrix<f64>, within: &DMatrix<f64>) -> Self {
        let inside = a * within;
        let (left, v) = orthogonal(inside.clone());
        let rest = (&left * v.transpose() - &inside).amax();
        assert!(rest <= VANISHES * inside.amax(), "not decomposed: {rest:e}");
        let sizes: Vec<f64> = left.column_iter().map(|c| c.norm()).collect();
        let largest = sizes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let share = |i: &usize| sizes[*i] / largest;
        let unclear: Vec<f64> =
            (0..sizes.len()).map(|i| share(&i)).filter(|s| (VANISHES..COUNTS).contains(s)).collect();
        assert!(unclear.is_empty(), "neither zero nor not: {unclear:?}");
        let (seen, unseen): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|i| share(i) >= COUNTS);
        let mut scaled = v.select_columns(&seen);
        scaled.column_iter_mut().zip(&seen).for_each(|(mut column, i)| column /= sizes[*i] * sizes[*i]);
        Self {
            inverse: within * scaled * left.select_columns(&seen).transpose(),
            null: within * v.select_columns(&unseen),
            rank: seen.len(),
            condition: seen.iter().map(share).fold(1.0, f64::min).recip(),
            within: within.clone(),
        }
    }

    /// Whether A tells a linear function of x: it vanishes on what A does not see.
    pub fn tells(&self, functional: &RowDVector<f64>) -> bool {
        let (all, unseen) = ((functional * &self.within).norm(), (functional * &self.null).norm());
        let share = if all > 0.0 { unseen / all } else { 0.0 };
        assert!(!(1e-6..1e-4).contains(&share), "neither told nor not: {share}");
        share < 1e-6
    }
}

/// `A = Q R` by Gram and Schmidt, twice for the last digits; where a column adds nothing Q has none. (That of nalgebra 0.35
/// is another matrix where columns depend on each other.)
fn triangular(a: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let (mut q, mut r) = (a.clone(), DMatrix::zeros(a.ncols(), a.ncols()));
    for j in 0..a.ncols() {
        let mut rest = a.column(j).into_owned();
        for i in (0..j).chain(0..j) {
            let share = q.column(i).dot(&rest);
            rest.axpy(-share, &q.column(i), 1.0);
            r[(i, j)] += share;
        }
        let adds = rest.norm() > 1e-14 * a.column(j).norm();
        r[(j, j)] = if adds { rest.norm() } else { 0.0 };
        q.set_column(j, &if adds { rest.normalize() } else { rest * 0.0 });
    }
    (q, r)
}

/// `A V` with columns square to each other, and the orthogonal V, by Jacobi's rotations of pairs of columns.
fn orthogonal(a: DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let width = a.ncols();
    if a.nrows() > width {
        let (q, r) = triangular(&a);
        let (left, v) = orthogonal(r);
        return (q * left, v);
    }
    let (mut a, mut v) = (a, DMatrix::identity(width, width));
    let floor = (f64::EPSILON * a.norm()).powi(2);
    let mut turning = true;
    while turning {
        turning = false;
        for i in 0..width {
            for j in i + 1..width {
                let (p, q, both) =
                    (a.column(i).norm_squared(), a.column(j).norm_squared(), a.column(i).dot(&a.column(j)));
                if both.abs() <= 4.0 * f64::EPSILON * (p * q).sqrt() + floor {
                    continue;
                }
                turning = true;
                let zeta = (q - p) / (2.0 * both);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = (1.0 + tangent * tangent).sqrt().recip();
                for m in [&mut a, &mut v] {
                    let (x, y) = (m.column(i).into_owned(), m.column(j).into_owned());
                    m.set_column(i, &((&x - &y * tangent) * cosine));
                    m.set_column(j, &((x * tangent + y) * cosine));
                }
            }
        }
    }
    (a, v)
}

/// The columns of `within` in units of what A makes of them.
pub fn in_units(a: &DMatrix<f64>, mut within: DMatrix<f64>) -> DMatrix<f64> {
    let made = a * &within;
    let used = within.column_iter_mut().zip(made.column_iter()).filter(|(_, made)| made.norm() > 0.0);
    used.for_each(|(mut column, made)| column /= made.norm());
    within
}

/// The columns that no earlier one makes up.
pub fn independent(a: &DMatrix<f64>) -> Vec<usize> {
    let mut found: Vec<(usize, DVector<f64>)> = Vec::new();
    for (j, column) in a.column_iter().enumerate() {
        let mut rest = column.into_owned();
        // Twice, for its last digits.
        for _ in 0..2 {
            found.iter().for_each(|(_, unit)| rest -= unit * unit.dot(&rest));
        }
        if rest.norm() > 1e-7 * column.norm() {
            found.push((j, rest.normalize()));
        }
    }
    found.into_iter().map(|(j, _)| j).collect()
}
