//! Cost of a fit: a generated row, a push, the paper's two runs, a Monte Carlo trial.

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;
use trunnion::study::{
    self, Arrays, Column, Draws, ErrorLimits, Estimator, How, KnownColumn, Sample, Setup, Simulation,
};
use trunnion_codegen::catalogue;
use trunnion_codegen::quantity::Unit;
use trunnion_solver::tilting::{self, Joint, Lengths, TwoStep};

const SAMPLES: usize = 360;
const BAR: Lengths<f64> = Lengths { r: 150.0 };

fn fit(c: &mut Criterion) {
    let sweeps = study::grid(SAMPLES, (0.0, TAU));
    let reading = |a: f64| 0.02 * (3.0 * a).sin();
    let mut group = c.benchmark_group("solver");
    group.bench_function("generated row, run 1", |b| b.iter(|| tilting::tilting(black_box(150.0), black_box(1.1))));
    group.bench_function("generated row, run 2", |b| b.iter(|| tilting::separation(black_box(150.0), black_box(1.1))));
    let mut joint = Joint::new(BAR).expect("a radius");
    let mut angle = 0.0;
    group.bench_function("row and push, joint", |b| {
        b.iter(|| {
            angle += 0.01;
            joint.push_tilting(black_box(angle), 0.001, 0.0, 0.0)
        });
    });
    group.throughput(Throughput::Elements(2 * SAMPLES as u64));
    group.bench_function("both runs, joint", |b| {
        b.iter(|| {
            let mut joint = Joint::new(BAR).expect("a radius");
            for &a in &sweeps {
                let _ = joint.push_tilting(a, reading(a), 0.0, 0.0);
                let _ = joint.push_separation(a, reading(a));
            }
            joint.solve()
        });
    });
    group.bench_function("both runs, two-step", |b| {
        b.iter(|| {
            let mut two = TwoStep::new(BAR).expect("a radius");
            for &a in &sweeps {
                let _ = two.push_tilting(a, reading(a), 0.0, 0.0);
                let _ = two.push_separation(a, reading(a));
            }
            two.solve()
        });
    });
    group.finish();
}

/// What a call from another language comes to: its arrays are checked, gone through twice, and nothing of them is copied.
fn arrays(c: &mut Criterion) {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).expect("a set-up");
    let limits = ErrorLimits::PAPER;
    let simulation = Simulation { seed: 1, samples: 36_000, noise_um: 0.1, limits, range_deg: (0.0, 360.0) };
    let observations = simulation.measure(&setup).observations;
    let column = |samples: &[Sample], of: &dyn Fn(&Sample) -> f64| samples.iter().map(of).collect::<Vec<f64>>();
    let known = |samples: &[Sample], at: usize| column(samples, &|sample| sample.known[at]);
    let columns: Vec<_> = observations
        .iter()
        .map(|o| {
            let known: Vec<_> = (0..o.samples[0].known.len()).map(|at| known(&o.samples, at)).collect();
            (o.run, column(&o.samples, &|s| s.sweep), column(&o.samples, &|s| s.reading), known)
        })
        .collect();
    let rad = |values| Column { values, unit: Unit::Rad };
    let mm = |values| Column { values, unit: Unit::Mm };
    let mut group = c.benchmark_group("study");
    group.sample_size(20).throughput(Throughput::Elements(2 * simulation.samples as u64));
    group.bench_function("arrays of 36,000 samples a run", |b| {
        b.iter(|| {
            let arrays: Vec<Arrays> = columns
                .iter()
                .map(|(run, sweep, reading, known)| {
                    let named = ["dya", "dza"].into_iter().zip(known);
                    let known = named.map(|(name, values)| KnownColumn { name, values: mm(values), std: None });
                    let known: Vec<_> = known.collect();
                    Arrays::new(&setup, *run, rad(sweep), mm(reading), &known).expect("a run")
                })
                .collect();
            study::fit_recorded(&setup, &arrays, How::default()).expect("a fit")
        });
    });
    group.finish();
}

/// Trials on one core; the set-up before the first one is shared by many thousands.
fn monte_carlo(c: &mut Criterion) {
    let model = catalogue::model("tilting-table-a").expect("in the catalogue").expect("a model");
    let setup = Setup::new(model, &[("R", 150.0)]).expect("a set-up");
    let function = setup.estimated().next().expect("an estimated function");
    let asked = [(Estimator::Joint, function)];
    let draws = |trials| Draws {
        trials,
        samples: SAMPLES,
        range: (0.0, TAU),
        limits: ErrorLimits::PAPER,
        noise: 1e-4,
        seed: 1,
    };
    let one_core = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let timed = |work: &(dyn Fn() + Sync)| {
        let start = Instant::now();
        one_core.install(work);
        start.elapsed()
    };
    let mut group = c.benchmark_group("study");
    group.sampling_mode(SamplingMode::Flat).sample_size(20);
    group.bench_function("Monte Carlo trial, noise alone", |b| {
        b.iter_custom(|trials| timed(&|| drop(study::noise_alone(&setup, draws(trials), &asked, &|| {}))));
    });
    group.bench_function("Monte Carlo trial, exact machine", |b| {
        b.iter_custom(|trials| timed(&|| drop(study::monte_carlo(&setup, draws(trials), &asked, &|| {}))));
    });
    group.finish();
}

criterion_group!(benches, fit, arrays, monte_carlo);
criterion_main!(benches);
