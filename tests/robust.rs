//! Huber's estimator against one made of dense matrices, and on readings of which some are far off.

use chacha20::ChaCha8Rng;
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use trunnion::study::{ErrorLimits, Estimator, Fit, How, Observation, Setup, Simulation, fit, fit_recorded};

const K: f64 = 1.345;

fn measured(setup: &Setup, seed: u64, share: f64) -> Vec<Observation> {
    let limits = ErrorLimits::PAPER;
    let simulation = Simulation { seed, samples: 360, noise_um: 0.2, limits, range_deg: (0.0, 360.0) };
    let mut observations = simulation.measure(setup).observations.raw;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for sample in observations.iter_mut().flat_map(|o| &mut o.samples) {
        if random.random_bool(share) {
            sample.reading += 5e-3;
        }
    }
    observations
}

fn robust(setup: &Setup, observations: &[Observation], estimator: Estimator) -> Fit {
    fit_recorded(setup, observations, How { estimator, robust: true, ..How::default() }).unwrap().0
}

/// The joint design and readings of all observations.
fn dense(setup: &Setup, fit: &Fit, observations: &[Observation]) -> (DMatrix<f64>, DVector<f64>, Vec<usize>) {
    let (mut rows, mut y, mut of) = (Vec::new(), Vec::new(), Vec::new());
    for (at, o) in observations.iter().enumerate() {
        let mut row = setup.row(o.run);
        for s in &o.samples {
            let (x, factors) = row.at(s.sweep, s.direction);
            let mut all = vec![0.0; fit.base.len()];
            for (x, (base, _)) in x.iter().zip(&setup.derivation.runs[o.run].regressors) {
                all[fit.base.binary_search(base).unwrap()] = *x;
            }
            y.push(s.reading - factors.iter().zip(&s.known).map(|(f, k)| f * k).sum::<f64>());
            rows.push(all);
            of.push(at);
        }
    }
    (DMatrix::from_fn(rows.len(), fit.base.len(), |i, j| rows[i][j]), DVector::from_vec(y), of)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn it_is_the_fixed_point_of_weighting_anew() {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let observations = measured(&setup, 3, 0.05);
    let fitted = robust(&setup, &observations, Estimator::Joint);
    let (x, y, of) = dense(&setup, &fitted, &observations);
    let residuals = &y - &x * &fitted.values;
    let sizes = |at: usize| of.iter().zip(residuals.iter()).filter(|(o, _)| **o == at).map(|(_, e)| e.abs()).collect();
    for (at, down) in fitted.weighed_down.iter().enumerate() {
        assert!((down.scale / (median(sizes(at)) / 0.6745) - 1.0).abs() < 0.02, "the scale is known to 2 %");
    }
    let weight = |(e, at): (&f64, &usize)| (K * fitted.weighed_down[*at].scale / e.abs()).min(1.0);
    let w = DVector::from_iterator(y.len(), residuals.iter().zip(&of).map(weight));
    // X' W e = 0, columns scaled.
    let scores = x.tr_mul(&w.component_mul(&residuals));
    for (column, score) in x.column_iter().zip(scores.iter()) {
        assert!(score.abs() < 1e-5 * column.norm() * residuals.norm(), "{score}");
    }
    let counted = |at: usize| w.iter().zip(&of).filter(|(w, o)| **o == at && **w < 1.0).count();
    assert!(fitted.weighed_down.iter().enumerate().all(|(at, down)| down.samples == counted(at)));

    let (n, p) = (y.len() as f64, fitted.base.len() as f64);
    let whole = w.iter().filter(|w| **w == 1.0).count() as f64 / n;
    let squares: f64 = w.iter().zip(residuals.iter()).map(|(w, e)| (w * e).powi(2)).sum();
    let factor = (1.0 + p / n * (1.0 - whole) / whole).powi(2) * squares / (n - p) / whole.powi(2);
    let covariance = (x.tr_mul(&x)).try_inverse().unwrap() * factor;
    for (a, b) in fitted.covariance.diagonal().iter().zip(covariance.diagonal().iter()) {
        assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn readings_far_off_hardly_move_it_and_its_band_is_honest() {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let function = setup.estimated().next().unwrap();
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let (mut off, mut plain_off, mut inside, mut count) = (0.0f64, 0.0f64, 0, 0);
        for seed in 0..30 {
            let clean = fit(&setup, &measured(&setup, seed, 0.0), estimator).unwrap();
            let spoilt = measured(&setup, seed, 0.03);
            let (one, plain) = (robust(&setup, &spoilt, estimator), fit(&setup, &spoilt, estimator).unwrap());
            for x in [0.5, 1.5, 3.0, 4.5, 6.0] {
                let (truth, clean_std) = clean.function(&setup, function, x);
                let (value, std) = one.function(&setup, function, x);
                off += (value - truth).powi(2);
                plain_off += (plain.function(&setup, function, x).0 - truth).powi(2);
                // The clean fit is off the truth as well, so the difference is smaller than either.
                inside += usize::from((value - truth).abs() < 2.0 * std.hypot(clean_std));
                count += 1;
            }
        }
        assert!(off < 0.01 * plain_off, "{estimator}: {off:e} of {plain_off:e}");
        assert!(inside * 100 >= 95 * count, "{estimator}: {inside} of {count}");
    }
}

#[test]
fn without_such_readings_it_costs_a_few_per_cent() {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let observations = measured(&setup, 11, 0.0);
    let plain = fit(&setup, &observations, Estimator::Joint).unwrap();
    let fitted = robust(&setup, &observations, Estimator::Joint);
    let ratio = (fitted.covariance[(0, 0)] / plain.covariance[(0, 0)]).sqrt();
    assert!((0.9..1.15).contains(&ratio), "{ratio}");
    assert!(plain.weighed_down.is_empty());
}
