//! Growth with the number of unknowns and of runs, rows at hand: the blocked factor beside a decomposition of the whole matrix.

use crate::dense::solve;
use crate::time;
use nalgebra::{DMatrix, DVector};
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{Block, Columns, ROWS, estimator};

/// Rows of a run, or of all where there is one.
const SAMPLES: usize = 100 * ROWS;
/// Unknowns that all runs have, and that each has of its own.
const COMMON: usize = 8;
const OWN: usize = 2;

/// Numbers between -1 and 1.
fn uniform() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// What a row takes in a blocked factor, and in a decomposition of all rows, ns.
fn compare(matrix: &DMatrix<f64>, y: &DVector<f64>) -> [f64; 2] {
    let (samples, unknowns) = matrix.shape();
    let columns = Columns { first: (0..unknowns).collect(), ..Columns::default() };
    let (mut block, mut readings) = (vec![[0.0; ROWS]; unknowns], [0.0; ROWS]);
    let blocked = time(|| {
        let mut problem = estimator(&columns).expect("a size");
        for start in (0..samples).step_by(ROWS) {
            for (k, column) in block.iter_mut().enumerate() {
                column.copy_from_slice(&matrix.as_slice()[k * samples + start..][..ROWS]);
            }
            readings.copy_from_slice(&y.as_slice()[start..][..ROWS]);
            let block = Block { columns: &mut block, y: &mut readings };
            problem.push(Step::First, block, ROWS, 1.0).expect("samples");
        }
        drop(problem.coefficients().expect("samples"));
    });
    let qr = time(|| drop(solve(matrix.clone(), y.clone())));
    [blocked, qr].map(|ns| ns / samples as f64)
}

pub fn unknowns() {
    let mut uniform = uniform();
    for unknowns in [2, 5, 10, 20, 40, 64] {
        let matrix = DMatrix::from_fn(SAMPLES, unknowns, |_, _| uniform());
        let [blocked, qr] = compare(&matrix, &DVector::from_fn(SAMPLES, |_, _| uniform()));
        println!("{unknowns},{blocked:.1},{qr:.1}");
    }
}

pub fn runs() {
    let mut uniform = uniform();
    for runs in [1, 2, 4, 8, 16] {
        let unknowns = COMMON + OWN * runs;
        let mut matrix = DMatrix::zeros(SAMPLES * runs, unknowns);
        for run in 0..runs {
            for column in (0..COMMON).chain((COMMON + OWN * run..).take(OWN)) {
                matrix.view_mut((SAMPLES * run, column), (SAMPLES, 1)).iter_mut().for_each(|x| *x = uniform());
            }
        }
        let [blocked, qr] = compare(&matrix, &DVector::from_fn(SAMPLES * runs, |_, _| uniform()));
        println!("{runs},{unknowns},{blocked:.1},{qr:.1}");
    }
}
