//! Whatever is pushed, merged and solved: a status, never a panic, never a NaN in a result.

use nalgebra::SVector;
use proptest::prelude::*;
use trunnion_solver::{
    DoubleDouble, Real,
    lstsq::{Factor, Order, Solution},
};

const P: usize = 4;

const ORDER: Order<P, P, P> = match Order::new(&[2, 3], &[0, 1], &[2, 3]) {
    Ok(order) => order,
    Err(_) => panic!("an order of two steps"),
};

/// Numbers a broken sensor or a hostile caller might send, among ordinary ones.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -10.0..10.0f64,
        2 => Just(0.0),
        1 => Just(1.0),
        1 => any::<f64>(),
        1 => (-320..308i32).prop_map(|e| 10f64.powi(e)),
        1 => prop::sample::select(&[-100, -50, -45, 44, 45, -800, -700, -400, -350, 349, 350, 399, 400, 700]).prop_map(|e| 2f64.powi(e)),
        1 => (-45..38i32).prop_map(|e| -(10f64.powi(e))),
    ]
}

#[derive(Clone, Debug)]
enum Step {
    Push([f64; P], f64),
    Weighted([f64; P], f64, f64),
    /// Merges the factor with an earlier state of itself.
    Merge,
    Keep,
}

fn step() -> impl Strategy<Value = Step> {
    let row = || prop::array::uniform4(number());
    prop_oneof![
        6 => (row(), number()).prop_map(|(x, y)| Step::Push(x, y)),
        3 => (row(), number(), number()).prop_map(|(x, y, w)| Step::Weighted(x, y, w)),
        1 => Just(Step::Merge),
        1 => Just(Step::Keep),
    ]
}

fn assert_sound<T: Real, const N: usize>(solution: Solution<T, N>) {
    assert!(solution.coefficients.iter().all(|v| v.is_finite()));
    assert!(solution.covariance.iter().all(|v| v.is_finite()));
    assert!(solution.std().iter().all(|v| v.is_finite() && *v >= T::zero()));
    assert!(solution.residual_std.is_finite() && solution.residual_std >= T::zero());
    let g = SVector::from_element(T::one());
    assert!(solution.variance_of(&g).is_none_or(|v| v.is_finite() && v >= T::zero()));
    assert!(solution.value_of(&g).is_none_or(|v| v.is_finite()));
}

fn run<T: Real>(steps: &[Step]) {
    let mut factor = Factor::<T, P>::new();
    let mut kept = factor;
    for step in steps {
        let before = factor;
        let of = |x: &[f64; P]| SVector::from(x.map(T::of));
        let outcome = match step {
            Step::Push(x, y) => factor.push(&of(x), T::of(*y)),
            Step::Weighted(x, y, w) => factor.push_weighted(&of(x), T::of(*y), T::of(*w)),
            Step::Merge => factor.merge(&kept),
            Step::Keep => {
                kept = factor;
                Ok(())
            }
        };
        if outcome.is_err() {
            assert_eq!(factor, before, "a rejected sample leaves no trace");
        }
        assert!(factor.residual_sum_of_squares() >= T::zero());
        let copy = factor;
        assert_eq!(factor, copy, "nothing in it is NaN, so nothing was infinite where it was used");
        if let Ok(solution) = factor.solve() {
            assert_sound(solution);
        }
        if let Ok(solution) = factor.solve_with_sigma(T::of(0.1)) {
            assert_sound(solution);
        }
        // The second step takes what the first gives, whatever that is.
        if let Ok(solution) = ORDER.solve(&kept, &factor) {
            assert_sound(solution);
        }
        if let Ok(condition) = factor.condition() {
            assert!(condition.number >= T::one() - T::of(16.0) * T::epsilon() && condition.number.is_finite());
            assert!(!condition.weakest.is_empty());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_sequence_in_f64(steps in prop::collection::vec(step(), 0..24)) {
        run::<f64>(&steps);
    }

    #[test]
    fn any_sequence_in_double_double(steps in prop::collection::vec(step(), 0..24)) {
        run::<DoubleDouble>(&steps);
    }

    #[test]
    fn any_sequence_in_f32(steps in prop::collection::vec(step(), 0..24)) {
        run::<f32>(&steps);
    }
}
