//! Dense least squares by singular values: what a matrix tells of its parameters, and its solution.

use nalgebra::{DMatrix, DVector, RowDVector};

/// Singular values above this share of the largest count, and none may come near: derivations and double precision leave
/// several digits between what is zero and what is not.
const COUNTS: f64 = 1e-9;
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
        let (samples, width) = inside.shape();
        // As many rows as columns at least, so that there is a singular vector for each column.
        let svd = inside.resize_vertically(samples.max(width), 0.0).svd(true, true);
        let (u, v) = (svd.u.expect("was asked for"), svd.v_t.expect("was asked for").transpose());
        let mut order: Vec<usize> = (0..width).collect();
        order.sort_by(|a, b| svd.singular_values[*b].total_cmp(&svd.singular_values[*a]));
        let share = |i: usize| svd.singular_values[i] / svd.singular_values[order[0]].max(f64::MIN_POSITIVE);
        let unclear: Vec<f64> = (0..width).map(share).filter(|s| (VANISHES..COUNTS).contains(s)).collect();
        assert!(unclear.is_empty(), "neither zero nor not: {unclear:?}");
        let rank = order.iter().filter(|i| share(**i) >= COUNTS).count();
        let (seen, unseen) = order.split_at(rank);
        let mut scaled = u.select_columns(seen).rows(0, samples).transpose();
        scaled.row_iter_mut().zip(seen).for_each(|(mut row, i)| row /= svd.singular_values[*i]);
        Self {
            inverse: within * v.select_columns(seen) * scaled,
            null: within * v.select_columns(unseen),
            rank,
            condition: seen.last().map_or(1.0, |last| share(*last).recip()),
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

/// Lengths of the columns, 1 for those that are zero.
pub fn scales(a: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_iterator(a.ncols(), a.column_iter().map(|c| Some(c.norm()).filter(|n| *n > 0.0).unwrap_or(1.0)))
}

/// All x for which `conditions · x = 0`, in units of `1 / scales`.
pub fn satisfying(conditions: &DMatrix<f64>, scales: &DVector<f64>) -> DMatrix<f64> {
    let units = DMatrix::from_diagonal(&scales.map(f64::recip));
    let mut scaled = conditions * &units;
    scaled.row_iter_mut().for_each(|mut row| {
        row.normalize_mut();
    });
    let null = Space::new(&scaled, &DMatrix::identity(scales.len(), scales.len())).null;
    units * null.map(|v| if v.abs() < VANISHES { 0.0 } else { v })
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
