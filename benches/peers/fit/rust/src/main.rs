//! Times the paper's two steps on both runs: rows built from the angles, everything fitted. Prints `name,ns`, nanoseconds for a
//! sample of each run, median of the repetitions, and ε_xa at 90° in µrad to show that all do the same.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::hint::black_box;
use std::time::Instant;
use trunnion_solver::tilting::{self, Joint, Lengths, TwoStep};

const RADIUS: f64 = 150.0;

/// Readings with something to find in them, and a disturbance.
fn reading(a: f64, run: f64) -> f64 {
    0.01 * (run * a).sin() + 1e-4 * (997.0 * a * run).sin() + 1e-7 * a * (a - TAU)
}


/// Dense matrices and a QR decomposition, as a program without a streaming solver would do it.
fn nalgebra_qr(angles: &[f64], readings: &[[f64; 2]]) -> f64 {
    let n = angles.len();
    let solve = |matrix: DMatrix<f64>, mut y: DVector<f64>| {
        let (columns, qr) = (matrix.ncols(), matrix.qr());
        qr.q_tr_mul(&mut y);
        qr.r().solve_upper_triangular(&y.rows(0, columns)).expect("full rank")
    };
    let mut second = DMatrix::zeros(n, 8);
    for (i, &a) in angles.iter().enumerate() {
        second.row_mut(i).copy_from_slice(&tilting::separation(RADIUS, a));
    }
    let k = solve(second, DVector::from_iterator(n, readings.iter().map(|r| r[1])));
    let mut own = DMatrix::zeros(n, 5);
    let mut rest = DVector::zeros(n);
    for (i, &a) in angles.iter().enumerate() {
        let (row, _) = tilting::tilting(RADIUS, a);
        rest[i] = readings[i][0] - (0..5).map(|j| row[2 + j] * k[j]).sum::<f64>();
        own.row_mut(i).copy_from_slice(&[row[0], row[1], row[7], row[8], row[9]]);
    }
    let e = solve(own, rest);
    let [f1, f2] = tilting::e_xa(RADIUS, FRAC_PI_2);
    e[0] * f1 + e[1] * f2
}

fn time(name: &str, samples: usize, run: impl Fn() -> f64) {
    let value = run();
    let mut times: Vec<f64> = (0..25)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("{name},{:.1},{:.6}", times[12] * 1e9 / samples as f64, value * 1e6);
}

fn main() {
    let samples = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(36_000);
    let angles: Vec<f64> = (0..samples).map(|i| TAU * i as f64 / samples as f64).collect();
    let readings: Vec<[f64; 2]> = angles.iter().map(|&a| [reading(a, 1.0), reading(a, 2.0)]).collect();
    let (angles32, readings32): (Vec<f32>, Vec<[f32; 2]>) =
        angles.iter().zip(&readings).map(|(&a, r)| (a as f32, r.map(|r| r as f32))).unzip();
    macro_rules! stream {
        ($estimator:ident, $t:ty) => {
            |angles: &[$t], readings: &[[$t; 2]]| {
                let mut fit = $estimator::new(Lengths { r: RADIUS as $t }).expect("a radius");
                for (&a, y) in angles.iter().zip(readings) {
                    fit.push_tilting(a, y[0], 0.0, 0.0).expect("a sample");
                    fit.push_separation(a, y[1]).expect("a sample");
                }
                let estimate = fit.solve().expect("a whole turn");
                f64::from(estimate.e_xa(FRAC_PI_2 as $t).expect("an angle").0)
            }
        };
    }
    time("Trunnion two-step streamed f64", samples, || stream!(TwoStep, f64)(&angles, &readings));
    time("Trunnion two-step streamed f32", samples, || stream!(TwoStep, f32)(&angles32, &readings32));
    time("Trunnion joint streamed f64", samples, || stream!(Joint, f64)(&angles, &readings));
    time("nalgebra QR two steps", samples, || nalgebra_qr(&angles, &readings));
}
