//! Rows of a block are those of its samples one by one, whatever the angles.

use proptest::prelude::*;
use trunnion_solver::Real;
use trunnion_solver::lstsq::{Column, ROWS};
use trunnion_solver::tilting::{rows_of_separation, rows_of_tilting, separation, tilting};

fn assert_same<T: Real>(r: T, a: &Column<T>) {
    let mut of_tilting = [[T::zero(); ROWS]; 12];
    let mut of_separation = [[T::zero(); ROWS]; 8];
    rows_of_tilting(r, a, &mut of_tilting);
    rows_of_separation(r, a, &mut of_separation);
    for (i, &a) in a.iter().enumerate() {
        let (row, factors) = tilting(r, a);
        let one: Vec<T> = row.into_iter().chain(factors).chain(separation(r, a)).collect();
        let many = of_tilting.iter().chain(&of_separation).map(|column| column[i]);
        for (at, (x, y)) in many.zip(one).enumerate() {
            let close = (x - y).abs() <= T::of(16.0) * T::epsilon() * (y.abs() + T::of(1e-3) * r * r * r);
            assert!(close || (x.is_nan() && y.is_nan()), "{a}, result {at}: {x} {y}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn near_angles(from in -7.0..7.0_f64, step in -0.1..0.1_f64, r in 1.0..500.0_f64) {
        assert_same(r, &std::array::from_fn(|i| from + step * i as f64));
        assert_same(r as f32, &std::array::from_fn(|i| (from + step * i as f64) as f32));
    }

    #[test]
    fn one_that_is_far(at in 0..ROWS, angle in prop::sample::select(vec![1e6, 2e6, -3e9, f64::MAX, f64::INFINITY, f64::NAN])) {
        assert_same(150.0, &std::array::from_fn(|i| if i == at { angle } else { 0.05 * i as f64 }));
    }
}
