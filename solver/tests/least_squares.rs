//! The streamed solution against other ways to it, and against what must not change it.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use trunnion_solver::lstsq::{Factor, Rejected, SolveError};

const P: usize = 5;
type Sample = (SVector<f64, P>, f64);

/// Seeded numbers in [-1, 1).
fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn samples(n: usize, seed: u64) -> Vec<Sample> {
    let mut next = uniform(seed);
    (0..n).map(|_| (SVector::from_fn(|_, _| next()), next())).collect()
}

fn factor_of(samples: &[Sample]) -> Factor<f64, P> {
    let mut factor = Factor::new();
    samples.iter().for_each(|(x, y)| factor.push(x, *y).unwrap());
    factor
}

fn assert_near<const R: usize, const C: usize>(a: &SMatrix<f64, R, C>, b: &SMatrix<f64, R, C>) {
    let scale = b.amax().max(1e-300);
    assert!((a - b).amax() <= 1e-11 * scale, "{a} {b}");
}

fn dense(samples: &[Sample]) -> (DMatrix<f64>, DVector<f64>) {
    let x = DMatrix::from_fn(samples.len(), P, |i, j| samples[i].0[j]);
    (x, DVector::from_iterator(samples.len(), samples.iter().map(|s| s.1)))
}

#[test]
fn agrees_with_dense_decompositions() {
    for seed in 0..50 {
        let data = samples(6 + 3 * seed as usize, seed);
        let (x, y) = dense(&data);
        let fit = factor_of(&data).solve().unwrap();

        let svd = x.clone().svd(true, true).solve(&y, 0.0).unwrap();
        assert_near(&fit.coefficients, &svd.fixed_rows::<P>(0).into_owned());
        let dof = data.len() - P;
        let s2 = (&y - &x * &svd).norm_squared() / dof as f64;
        let r = x.clone().qr().r();
        let inverse = r.try_inverse().unwrap();
        let covariance = &inverse * inverse.transpose() * s2;
        assert_near(&fit.covariance, &covariance.fixed_view::<P, P>(0, 0).into_owned());
        assert!((fit.residual_std / s2.sqrt() - 1.0).abs() < 1e-11);
        assert_eq!(fit.degrees_of_freedom as usize, dof);

        let mut scaled = x;
        scaled.column_iter_mut().for_each(|mut c| {
            c.normalize_mut();
        });
        let svd = scaled.svd(false, true);
        let condition = factor_of(&data).condition().unwrap();
        let expected = svd.singular_values.max() / svd.singular_values.min();
        assert!((condition.number / expected - 1.0).abs() < 1e-11);
        let weakest = svd.v_t.unwrap().row(svd.singular_values.imin()).map(|v| v.abs() >= 0.1);
        assert!((0..P).all(|i| condition.weakest.contains(i) == weakest[i]));
    }
}

#[test]
fn order_and_partition_do_not_matter() {
    let data = samples(200, 1);
    let whole = factor_of(&data).solve().unwrap();
    let reversed: Vec<_> = data.iter().rev().copied().collect();
    assert_near(&factor_of(&reversed).solve().unwrap().coefficients, &whole.coefficients);
    for cut in [0, 1, 3, 100, 199, 200] {
        let (first, second) = data.split_at(cut);
        let mut merged = factor_of(second);
        merged.merge(&factor_of(first)).unwrap();
        let fit = merged.solve().unwrap();
        assert_near(&fit.coefficients, &whole.coefficients);
        assert_near(&fit.covariance, &whole.covariance);
        assert_eq!(fit.degrees_of_freedom, whole.degrees_of_freedom);
    }
}

#[test]
fn a_weight_repeats_a_sample() {
    let data = samples(30, 2);
    let (mut weighted, mut repeated) = (Factor::<f64, P>::new(), Factor::<f64, P>::new());
    for (i, (x, y)) in data.iter().enumerate() {
        let times = i % 4;
        weighted.push_weighted(x, *y, times as f64).unwrap();
        (0..times).for_each(|_| repeated.push(x, *y).unwrap());
    }
    assert_eq!(weighted.samples(), 22);
    let (weighted, repeated) = (weighted.solve_with_sigma(0.3).unwrap(), repeated.solve_with_sigma(0.3).unwrap());
    assert_near(&weighted.coefficients, &repeated.coefficients);
    assert_near(&weighted.covariance, &repeated.covariance);
}

#[test]
fn units_do_not_matter() {
    let data = samples(40, 3);
    let units = SVector::<f64, P>::from([1e-9, 1e6, 1.0, 1e9, 1e-3]);
    let rescaled: Vec<_> = data.iter().map(|(x, y)| (x.component_mul(&units), *y)).collect();
    let (a, b) = (factor_of(&data), factor_of(&rescaled));
    let (fit, other) = (a.solve().unwrap(), b.solve().unwrap());
    assert_near(&fit.coefficients, &other.coefficients.component_mul(&units));
    assert_near(&fit.std(), &other.std().component_mul(&units));
    let (a, b) = (a.condition().unwrap(), b.condition().unwrap());
    assert!((a.number / b.number - 1.0).abs() < 1e-10);
    assert_eq!(a.weakest, b.weakest);
}

#[test]
fn a_functional_has_the_variance_of_the_coefficients() {
    let factor = factor_of(&samples(40, 4));
    let fit = factor.solve().unwrap();
    assert_eq!(factor.coefficients(), Ok(fit.coefficients));
    let g = SVector::<f64, P>::from([1.0, -2.0, 0.5, 0.0, 3.0]);
    let variance = (g.transpose() * fit.covariance * g).x;
    assert!((fit.variance_of(&g).unwrap() / variance - 1.0).abs() < 1e-12);
    assert!((fit.value_of(&g).unwrap() - g.dot(&fit.coefficients)).abs() < 1e-12);
    assert_eq!(fit.variance_of(&SVector::from_element(f64::NAN)), None);
}

#[test]
fn bad_samples_are_refused_and_leave_no_trace() {
    let data = samples(10, 7);
    let mut factor = factor_of(&data);
    let before = factor;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..P {
            let mut x = data[0].0;
            x[i] = bad;
            assert_eq!(factor.push(&x, 1.0), Err(Rejected::NotFinite));
        }
        assert_eq!(factor.push(&data[0].0, bad), Err(Rejected::NotFinite));
        assert_eq!(factor.push_weighted(&data[0].0, 1.0, bad), Err(Rejected::Weight));
    }
    assert_eq!(factor.push_weighted(&data[0].0, 1.0, -1.0), Err(Rejected::Weight));
    assert_eq!(factor.push(&SVector::from_element(1e200), 1.0), Err(Rejected::Overflow));
    assert_eq!(factor.push(&data[0].0, 1e200), Err(Rejected::Overflow));
    assert_eq!(factor, before);
}

#[test]
fn too_few_samples_are_counted() {
    let too_few = |samples, needed| Some(SolveError::TooFewSamples { samples, needed });
    let none = Factor::<f64, P>::new();
    assert_eq!(none, Factor::<f64, P>::EMPTY);
    assert_eq!(none.solve().err(), too_few(0, 6));
    let five = factor_of(&samples(5, 8));
    assert_eq!(five.solve().err(), too_few(5, 6));
    assert_eq!(five.solve_with_sigma(1.0).unwrap().degrees_of_freedom, 0);
    assert!(five.coefficients().is_ok());
    assert_eq!(five.solve_with_sigma(f64::NAN), Err(SolveError::NotFinite));
}

#[test]
fn confounded_coefficients_are_named() {
    const NAMES: [&str; P] = ["k1", "k2", "k3", "k4", "k5"];
    let involved = |make: fn(SVector<f64, P>) -> [f64; P], n| {
        let data: Vec<Sample> = samples(n, 9).into_iter().map(|(x, y)| (make(x).into(), y)).collect();
        match factor_of(&data).solve() {
            Err(SolveError::RankDeficient(c)) => (c.involved.names(&NAMES).collect::<Vec<_>>(), c.pivot, c.rank),
            other => panic!("{other:?}"),
        }
    };
    for n in [6, 100, 36_000] {
        // One column is a sum of two others, in whatever unit; then a zero column; then the same sample every time.
        let sum = involved(|x| [x[0], 1e-6 * x[1], x[2], x[0] - 3.0 * x[1], x[4]], n);
        assert_eq!(sum, (vec!["k1", "k2", "k4"], 3, 4));
        assert_eq!(involved(|x| [x[0], x[1], 0.0, x[3], x[4]], n), (vec!["k3"], 2, 4));
        assert_eq!(involved(|_| [0.1, 0.7, -0.3, 2.0, 5.0], n), (vec!["k1", "k2"], 1, 1));
    }
}

#[test]
fn rank_is_decided_alike_in_f32_after_many_samples() {
    for n in [20, 360, 36_000] {
        let (mut dependent, mut nearly) = (Factor::<f32, P>::new(), Factor::<f32, P>::new());
        for (x, y) in samples(n, 10) {
            let x = x.map(|v| v as f32);
            let sum = x[0] + x[1] - x[2];
            dependent.push(&[x[0], x[1], x[2], sum, x[4]].into(), y as f32).unwrap();
            nearly.push(&[x[0], x[1], x[2], sum + 1e-3 * x[3], x[4]].into(), y as f32).unwrap();
        }
        assert!(
            matches!(dependent.solve(), Err(SolveError::RankDeficient(c)) if c.pivot == 3 && c.involved.len() == 4)
        );
        assert!(nearly.solve().is_ok());
        let condition = nearly.condition().unwrap();
        assert!(condition.number > 1e3 && condition.weakest.iter().eq(0..4));
    }
}

#[test]
fn the_state_fits_a_controller() {
    assert!(size_of::<Factor<f32, 8>>() <= 400);
}
