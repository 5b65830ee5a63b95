//! Growth with the number of unknowns, rows at hand: the blocked factor beside a decomposition of the whole matrix.

use crate::dense::solve;
use crate::time;
use nalgebra::{DMatrix, DVector};
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{Block, Columns, ROWS, estimator};

const SAMPLES: usize = 12_800;

pub fn run() {
    let mut state = 1u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for unknowns in [2, 5, 10, 20, 40, 64] {
        let matrix = DMatrix::from_fn(SAMPLES, unknowns, |_, _| uniform());
        let y = DVector::from_fn(SAMPLES, |_, _| uniform());
        let columns = Columns { first: (0..unknowns).collect(), ..Columns::default() };
        let (mut block, mut readings) = (vec![[0.0; ROWS]; unknowns], [0.0; ROWS]);
        let blocked = time(|| {
            let mut problem = estimator(&columns).expect("a size");
            for start in (0..SAMPLES).step_by(ROWS) {
                for (k, column) in block.iter_mut().enumerate() {
                    column.copy_from_slice(&matrix.as_slice()[k * SAMPLES + start..][..ROWS]);
                }
                readings.copy_from_slice(&y.as_slice()[start..][..ROWS]);
                let block = Block { columns: &mut block, y: &mut readings };
                problem.push(Step::First, block, ROWS, 1.0).expect("samples");
            }
            drop(problem.coefficients());
        });
        let qr = time(|| drop(solve(matrix.clone(), y.clone())));
        println!("{unknowns},{:.1},{:.1}", blocked / SAMPLES as f64, qr / SAMPLES as f64);
    }
}
