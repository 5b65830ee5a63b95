//! A factor filled by blocks is that of the same rows pushed one by one, however they are split, weighted and merged.

use nalgebra::SVector;
use proptest::prelude::*;
use trunnion_solver::Real;
use trunnion_solver::lstsq::{Blocked, Factor, Portable, ROWS, Rejected};

const P: usize = 5;

/// Rows of low powers with disturbances: dependent enough to show a loss of digits.
fn rows(count: usize, seed: u64) -> Vec<([f64; P], f64)> {
    let mut state = seed.wrapping_mul(2).wrapping_add(1);
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let row = |_| {
        let x = uniform();
        ([1.0, x, x * x, 3.0 * uniform(), 1e-3 * uniform()], 2.0 - x + 0.1 * uniform())
    };
    (0..count).map(row).collect()
}

fn streamed<T: Real>(rows: &[([f64; P], f64)], weights: impl Fn(usize) -> f64) -> Factor<T, P> {
    let mut factor = Factor::new();
    for (i, (row, y)) in rows.iter().enumerate() {
        factor.push_weighted(&SVector::from(row.map(T::of)), T::of(*y), T::of(weights(i))).unwrap();
    }
    factor
}

/// With room to work in.
fn push<T: Real>(blocked: &mut Blocked<T, P>, rows: &[([f64; P], f64)], weight: f64) -> Result<(), Rejected> {
    push_in(blocked, rows, weight, true)
}

fn push_in<T: Real>(
    blocked: &mut Blocked<T, P>,
    rows: &[([f64; P], f64)],
    weight: f64,
    room: bool,
) -> Result<(), Rejected> {
    let (mut columns, mut y) = ([[T::of(7.0); ROWS]; P], [T::of(7.0); ROWS]);
    for (i, (row, value)) in rows.iter().enumerate() {
        columns.iter_mut().zip(row).for_each(|(column, &x)| column[i] = T::of(x));
        y[i] = T::of(*value);
    }
    if !room {
        return blocked.push(&mut columns, &mut y, rows.len(), T::of(weight));
    }
    let mut work = [[T::of(7.0); ROWS]; P + 1];
    blocked.push_with(Portable, &mut columns, &mut y, rows.len(), T::of(weight), &mut work)
}

fn assert_same<T: Real>(a: &Factor<T, P>, b: &Factor<T, P>, tolerance: f64) {
    let f64_of = |x: T| x.to_f64().unwrap();
    assert_eq!(a.samples(), b.samples());
    let (one, other) = (a.solve().unwrap(), b.solve().unwrap());
    let std = one.std();
    for i in 0..P {
        let (x, y) = (f64_of(one.coefficients[i]), f64_of(other.coefficients[i]));
        assert!((x - y).abs() <= tolerance * (x.abs() + f64_of(std[i])), "coefficient {i}: {x} {y}");
    }
    let largest = one.covariance.iter().fold(0.0, |most, x| f64_of(*x).abs().max(most));
    for (x, y) in one.covariance.iter().zip(&other.covariance) {
        assert!((f64_of(*x) - f64_of(*y)).abs() <= 10.0 * tolerance * largest);
    }
    let (x, y) = (f64_of(one.residual_std), f64_of(other.residual_std));
    assert!((x - y).abs() <= tolerance * x, "residual {x} {y}");
}

fn split<T: Real>(count: usize, cuts: &[usize], merged_at: usize, seed: u64, tolerance: f64) {
    let rows = rows(count, seed);
    // Three weights in turn, from cut to cut; room to work in for three of five.
    let weight = |part: usize| [1.0, 0.25, 9.0][part % 3];
    let mut ends: Vec<usize> = cuts.iter().map(|c| c % count).chain([count]).collect();
    ends.sort_unstable();
    let part_of = |i: usize| ends.iter().filter(|end| **end <= i).count();
    let (mut blocked, mut before) = (Blocked::<T, P>::new(), Factor::new());
    let mut start = 0;
    for (part, &end) in ends.iter().enumerate() {
        for chunk in rows[start..end].chunks(ROWS) {
            push_in(&mut blocked, chunk, weight(part), (part + seed as usize) % 5 > 1).unwrap();
        }
        start = end;
        if part == merged_at {
            before.merge(&blocked.factor()).unwrap();
            blocked = Blocked::new();
        }
    }
    before.merge(&blocked.factor()).unwrap();
    assert_same(&streamed::<T>(&rows, |i| weight(part_of(i))), &before, tolerance);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_split_gives_the_same_in_f64(
        count in 10..6_000usize,
        cuts in prop::collection::vec(0..6_000usize, 0..6),
        merged_at in 0..6usize,
        seed in any::<u64>(),
    ) {
        split::<f64>(count, &cuts, merged_at, seed, 1e-10);
    }

    #[test]
    fn any_split_gives_the_same_in_f32(
        count in 10..6_000usize,
        cuts in prop::collection::vec(0..6_000usize, 0..6),
        merged_at in 0..6usize,
        seed in any::<u64>(),
    ) {
        split::<f32>(count, &cuts, merged_at, seed, 2e-2);
    }
}

#[test]
fn a_block_with_a_bad_row_is_refused_whole() {
    let good = rows(300, 1);
    let mut blocked = Blocked::<f64, P>::new();
    push(&mut blocked, &good[..100], 1.0).unwrap();
    let before = blocked.factor();
    for (bad, why) in [
        (f64::NAN, Rejected::NotFinite),
        (f64::INFINITY, Rejected::NotFinite),
        (1e200, Rejected::Overflow),
        (1e130, Rejected::Overflow),
    ] {
        for column in 0..P {
            let mut rows = good[100..200].to_vec();
            rows[50].0[column] = bad;
            assert_eq!(push(&mut blocked, &rows, 1.0), Err(why));
        }
        let mut rows = good[100..200].to_vec();
        rows[99].1 = bad;
        assert_eq!(push(&mut blocked, &rows, 1.0), Err(why));
    }
    for weight in [-1.0, f64::NAN, f64::INFINITY, 1e300, 1e-300] {
        assert_eq!(push(&mut blocked, &good[..10], weight), Err(Rejected::Weight));
    }
    assert_eq!(push(&mut blocked, &good[..10], 0.0), Ok(()));
    assert_eq!(blocked.factor(), before);
}

#[test]
fn columns_that_are_zero_or_dependent_are_found() {
    let mut blocked = Blocked::<f64, P>::new();
    let rows: Vec<_> =
        rows(1_000, 3).into_iter().map(|(x, y)| ([x[0], x[1], 0.0, x[3], x[0] - 2.0 * x[3]], y)).collect();
    rows.chunks(ROWS).for_each(|chunk| push(&mut blocked, chunk, 1.0).unwrap());
    let streamed = streamed::<f64>(&rows, |_| 1.0);
    assert_eq!(blocked.factor().solve(), streamed.solve());
    assert!(blocked.factor().solve().is_err());
}

/// Rows along an arc that each block prolongs: what a triangle of the first foretells worst.
fn along(count: usize) -> Vec<([f64; P], f64)> {
    let row = |i: usize| {
        let a = i as f64 * std::f64::consts::TAU / count as f64;
        let noise = 1e-4 * (997.0 * a * a).sin();
        ([1.0, a.sin(), a.cos(), (2.0 * a).sin(), a * a - 6.0 * a], 0.004 * a.sin().exp() + noise)
    };
    (0..count).map(row).collect()
}

/// Rows from all over first.
fn spread<R: Copy>(rows: &[R]) -> Vec<R> {
    let step = rows.len().div_ceil(ROWS);
    let first = rows.iter().step_by(step);
    first.chain(rows.iter().enumerate().filter(|(i, _)| i % step != 0).map(|(_, row)| row)).copied().collect()
}

#[test]
fn rows_in_the_order_of_a_sweep_and_from_all_over_give_the_same() {
    for count in [130, 360, 3_600, 36_000] {
        let rows = along(count);
        let streamed = streamed::<f64>(&rows, |_| 1.0);
        for rows in [spread(&rows), rows] {
            let mut blocked = Blocked::<f64, P>::new();
            rows.chunks(ROWS).for_each(|chunk| push(&mut blocked, chunk, 1.0).unwrap());
            assert_same(&streamed, &blocked.factor(), 1e-12);
        }
    }
}

#[test]
fn readings_that_the_rows_explain_leave_nothing() {
    let rows: Vec<_> = along(3_600).into_iter().map(|(x, _)| (x, 3.0 * x[0] - 2.0 * x[1] + 0.5 * x[4])).collect();
    let mut blocked = Blocked::<f64, P>::new();
    rows.chunks(ROWS).for_each(|chunk| push(&mut blocked, chunk, 1.0).unwrap());
    let solved = blocked.factor().solve().unwrap();
    for (value, exact) in solved.coefficients.iter().zip([3.0, -2.0, 0.0, 0.0, 0.5]) {
        assert!((value - exact).abs() < 1e-13, "{value} {exact}");
    }
    assert!(solved.residual_std < 1e-14, "{}", solved.residual_std);
}

#[test]
fn columns_that_the_factor_does_not_have_are_none() {
    let rows = rows(1_000, 5);
    let (mut five, mut seven) = (Blocked::<f64, P>::new(), Blocked::<f64, P>::new());
    for chunk in rows.chunks(ROWS) {
        let (mut columns, mut y) = ([[7.0; ROWS]; P + 2], [7.0; ROWS]);
        for (i, (row, value)) in chunk.iter().enumerate() {
            columns.iter_mut().zip(row).for_each(|(column, &x)| column[i] = x);
            y[i] = *value;
        }
        let mut work = [[0.0; ROWS]; P + 3];
        seven.push_with(Portable, &mut columns, &mut y, chunk.len(), 1.0, &mut work).unwrap();
        push(&mut five, chunk, 1.0).unwrap();
    }
    assert_eq!(five.factor(), seven.factor());
}

#[test]
fn blocks_of_fewer_columns_leave_those_behind_as_they_are() {
    let mut rows = rows(20 * ROWS, 6);
    for room in [false, true] {
        let mut blocked = Blocked::<f64, P>::new();
        for (chunk, width) in rows.chunks_mut(ROWS).zip([5, 5, 5, 5, 3, 3, 3, 3, 5, 2].into_iter().cycle()) {
            let (mut columns, mut y) = ([[0.0; ROWS]; P], [0.0; ROWS]);
            for (i, (row, value)) in chunk.iter_mut().enumerate() {
                row[width..].fill(0.0);
                columns.iter_mut().zip(&*row).for_each(|(column, &x)| column[i] = x);
                y[i] = *value;
            }
            let mut work = [[0.0; ROWS]; P + 1];
            let work = if room { work.as_mut_slice() } else { &mut [] };
            blocked.push_with(Portable, &mut columns[..width], &mut y, ROWS, 1.0, work).unwrap();
        }
        assert_same(&blocked.factor(), &streamed(&rows, |_| 1.0), 1e-10);
    }
}
