//! Digits of the worst coefficient on NIST's linear sets, x shifted to the middle of its range and scaled by a power of two: the
//! fitted coefficients are those of the shifted variable, whose certified values come from `exact.py`.

use crate::dense::solve;
use nalgebra::{DMatrix, DVector};
use serde_json::Value;
use std::fs;
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{Block, Columns, ROWS, estimator};

fn digits(values: &[f64], exact: &[f64]) -> f64 {
    let one = |(v, e): (&f64, &f64)| (-((v - e) / if *e == 0.0 { 1.0 } else { *e }).abs().log10()).clamp(0.0, 15.0);
    values.iter().zip(exact).map(one).fold(15.0, f64::min)
}

/// Reads the sets that `exact.py strd` has written: rows, readings, coefficients.
pub fn run(directory: &str) {
    let mut files: Vec<_> = fs::read_dir(directory).expect("a directory").map(|f| f.expect("a file").path()).collect();
    files.sort();
    for file in files {
        let set: Value = serde_json::from_str(&fs::read_to_string(&file).expect("a file")).expect("JSON");
        let numbers = |v: &Value| v.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect();
        let rows: Vec<Vec<f64>> = set["rows"].as_array().expect("rows").iter().map(numbers).collect();
        let (y, exact): (Vec<f64>, Vec<f64>) = (numbers(&set["y"]), numbers(&set["exact"]));
        let unknowns = exact.len();
        let matrix = DMatrix::from_fn(rows.len(), unknowns, |i, j| rows[i][j]);
        let qr = solve(matrix, DVector::from_column_slice(&y));
        let columns = Columns { first: (0..unknowns).collect(), ..Columns::default() };
        let mut problem = estimator(&columns).expect("a size");
        for (rows, y) in rows.chunks(ROWS).zip(y.chunks(ROWS)) {
            let (mut block, mut readings) = (vec![[0.0; ROWS]; unknowns], [0.0; ROWS]);
            for (i, row) in rows.iter().enumerate() {
                block.iter_mut().zip(row).for_each(|(column, x)| column[i] = *x);
                readings[i] = y[i];
            }
            let block = Block { columns: &mut block, y: &mut readings };
            problem.push(Step::First, block, rows.len(), 1.0).expect("samples");
        }
        let blocked = problem.solve(Some(1.0)).map(|s| s.coefficients.as_slice().to_vec()).unwrap_or_default();
        let name = file.file_stem().and_then(|n| n.to_str()).unwrap_or_default().to_owned();
        println!(
            "{name},{:.1},{:.1},{:.1}",
            digits(&blocked, &exact),
            digits(qr.as_slice(), &exact),
            set["numpy"].as_f64().expect("a number")
        );
    }
}
