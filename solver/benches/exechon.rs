//! Cost of a pose: inverse kinematics along a path (warm) and from home (cold), forward, dependent rotation.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use trunnion_solver::exechon::{Dimensions, Home, Limits, Machine, Range, Target, Tilted};

fn machine() -> Machine<f64> {
    let dimensions =
        Dimensions { xu: 450.0, ys2: 450.0, xr: 150.0, yr5: 150.0, ycp: 25.0, zc: 375.0, yt: -30.0, tz: 380.0 };
    let home = Home { strut: 1438.0, a: -std::f64::consts::FRAC_PI_4 };
    let limits = Limits {
        struts: Range { low: 950.0, high: 1650.0 },
        a: Range { low: -1.58, high: 1.58 },
        c: Range { low: -4.8, high: 4.8 },
    };
    Machine::new(dimensions, home, limits).unwrap()
}

/// A path through the workspace, a point every millimetre or so.
fn path(machine: &Machine<f64>) -> Vec<Target<f64>> {
    let frame = machine.frame();
    let point = |k: i32| {
        let t = f64::from(k) / 4096.0 * std::f64::consts::TAU;
        [300.0 * t.cos(), 200.0 * (2.0 * t).sin() + 100.0, -150.0 + 80.0 * (3.0 * t).sin()]
    };
    let target = |k| Target::new(frame.point_to_base(point(k)), *machine.home().direction()).unwrap();
    (0..4096).map(target).collect()
}

fn exechon(c: &mut Criterion) {
    let machine = machine();
    let (home, path) = (machine.home().start(), path(&machine));
    let mut group = c.benchmark_group("exechon");
    group.bench_function("inverse, from the previous pose", |b| {
        let (mut targets, mut start) = (path.iter().cycle(), home);
        b.iter(|| {
            let pose = machine.inverse(black_box(targets.next().unwrap()), &start).unwrap();
            start = pose.start();
            pose
        });
    });
    group.bench_function("inverse, from home", |b| {
        let mut targets = path.iter().cycle();
        b.iter(|| machine.inverse(black_box(targets.next().unwrap()), &home).unwrap());
    });
    let poses: Vec<_> = path.iter().map(|target| machine.inverse(target, &home).unwrap()).collect();
    group.bench_function("forward, from home", |b| {
        let mut poses = poses.iter().cycle();
        b.iter(|| machine.forward(black_box(&poses.next().unwrap().joints), &home).unwrap());
    });
    group.bench_function("dependent rotation", |b| {
        let mut poses = poses.iter().cycle();
        b.iter(|| machine.dependent_rotation(black_box(poses.next().unwrap()), Tilted::Projected).unwrap());
    });
}

criterion_group!(benches, exechon);
criterion_main!(benches);
