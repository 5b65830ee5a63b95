//! Dense matrices and a QR decomposition, as a program without a streaming solver would do it.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use trunnion_solver::tilting::{separation, tilting};

pub const RADIUS: f64 = 150.0;

/// Readings with something to find in them, and a disturbance.
fn reading(a: f64, run: f64) -> f64 {
    0.004 * (a + run).sin().exp() + 1e-4 * (997.0 * a * run).sin() + 1e-7 * a * (a - TAU)
}

/// Angles of a turn, and what both runs read there.
pub fn data(samples: usize) -> (Vec<f64>, [Vec<f64>; 2]) {
    let angles: Vec<f64> = (0..samples).map(|i| TAU * i as f64 / samples as f64).collect();
    let readings = [1.0, 2.0].map(|run| angles.iter().map(|&a| reading(a, run)).collect());
    (angles, readings)
}

pub fn solve(matrix: DMatrix<f64>, mut y: DVector<f64>) -> DVector<f64> {
    let (columns, qr) = (matrix.ncols(), matrix.qr());
    qr.q_tr_mul(&mut y);
    qr.r().solve_upper_triangular(&y.rows(0, columns)).expect("full rank")
}

/// The paper's two steps; coefficients by their positions in `tilting::NAMES`.
pub fn two_steps(angles: &[f64], readings: &[Vec<f64>; 2]) -> [f64; 13] {
    let n = angles.len();
    let mut second = DMatrix::zeros(n, 8);
    for (i, &a) in angles.iter().enumerate() {
        second.row_mut(i).copy_from_slice(&separation(RADIUS, a));
    }
    let k = solve(second, DVector::from_column_slice(&readings[1]));
    let mut own = DMatrix::zeros(n, 5);
    let mut rest = DVector::zeros(n);
    for (i, &a) in angles.iter().enumerate() {
        let (row, _) = tilting(RADIUS, a);
        rest[i] = readings[0][i] - (0..5).map(|j| row[2 + j] * k[j]).sum::<f64>();
        own.row_mut(i).copy_from_slice(&[row[0], row[1], row[7], row[8], row[9]]);
    }
    let e = solve(own, rest);
    [e[0], e[1], k[0], k[1], k[2], k[3], k[4], e[2], e[3], e[4], k[5], k[6], k[7]]
}
