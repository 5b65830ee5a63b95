//! Cost of a derivation, step by step: both runs of the paper.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use trunnion_codegen::algebra::Order;
use trunnion_codegen::emit::rust::{Support, model_source};
use trunnion_codegen::identify::derive;
use trunnion_codegen::measurement::reading;
use trunnion_codegen::{catalogue, model};

fn derivation(c: &mut Criterion) {
    let source = catalogue::source("tilting-table-a").expect("in the catalogue");
    let read = || model::read(source).expect("a model");
    let model = read();
    let derived = derive(&model).expect("a derivation");
    let mut group = c.benchmark_group("derivation");
    group.bench_function("read the model file", |b| b.iter(read));
    for order in 1..=3 {
        let order = Order::new(order).expect("a small order");
        let both =
            || model.runs.iter().map(|run| reading(black_box(&model), run, order)).collect::<Result<Vec<_>, _>>();
        group.bench_function(format!("both readings, order {}", order.get()), |b| b.iter(both));
    }
    group.bench_function("with base parameters", |b| b.iter(|| derive(black_box(&model))));
    group
        .bench_function("Rust source", |b| b.iter(|| model_source(black_box(&model), &derived, &Support::of_solver())));
    group.finish();
}

criterion_group!(benches, derivation);
criterion_main!(benches);
