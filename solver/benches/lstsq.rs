//! Cost of the factor's steps: push, merge, solve with covariance, condition.

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::SVector;
use std::hint::black_box;
use trunnion_solver::{DoubleDouble, Real, lstsq::Factor};

/// A dense row that differs from sample to sample.
fn row<T: Real, const P: usize>(i: u32) -> SVector<T, P> {
    SVector::from_fn(|j, _| T::of((f64::from(i) * 0.1 * (j as f64 + 1.0) + j as f64).cos()))
}

fn benches_of<T: Real, const P: usize>(c: &mut Criterion, float: &str) {
    let rows: Vec<_> = (0..1024).map(|i| (row::<T, P>(i), T::of(f64::from(i).sin()))).collect();
    let mut factor = Factor::<T, P>::new();
    rows.iter().for_each(|(x, y)| factor.push(x, *y).unwrap());

    let mut group = c.benchmark_group(format!("{float}/{P}"));
    let mut samples = rows.iter().cycle();
    group.bench_function("push", |b| {
        let mut factor = factor;
        b.iter(|| {
            let (x, y) = samples.next().unwrap();
            factor.push(black_box(x), *y)
        });
    });
    group.bench_function("merge", |b| {
        b.iter(|| {
            let mut both = factor;
            both.merge(black_box(&factor)).map(|()| both)
        })
    });
    group.bench_function("solve", |b| b.iter(|| black_box(&factor).solve()));
    group.bench_function("condition", |b| b.iter(|| black_box(&factor).condition()));
}

fn lstsq(c: &mut Criterion) {
    benches_of::<f32, 8>(c, "f32");
    benches_of::<f64, 8>(c, "f64");
    benches_of::<f32, 13>(c, "f32");
    benches_of::<f64, 13>(c, "f64");
    benches_of::<DoubleDouble, 13>(c, "double-double");
}

criterion_group!(benches, lstsq);
criterion_main!(benches);
