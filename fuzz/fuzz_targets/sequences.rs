//! Any sequence of samples, merges and solves, in `f32` and `f64`: a status or a finite result, never a panic or a NaN, and
//! a refused sample leaves no trace.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use nalgebra::SVector;
use trunnion_solver::{
    Real,
    lstsq::{Factor, Order, Solution},
    tilting::{Joint, Lengths, TwoStep},
};

const P: usize = 4;
const STEPS: Order<5, P, P> = match Order::new(&[0, 1, 2, 3], &[4], &[2, 0, 1]) {
    Ok(order) => order,
    Err(_) => panic!("not an order of two steps"),
};

#[derive(Arbitrary, Debug)]
enum Step {
    Push([f64; P], f64),
    /// Small whole numbers: dependent columns and exact zeros.
    PushWhole([i8; P], i8),
    Weighted([f64; P], f64, f64),
    Merge,
    Keep,
    Tilting(f64, [f64; 3]),
    Separation(f64, f64),
    Restart(f64),
}

fuzz_target!(|steps: Vec<Step>| {
    run::<f32>(&steps);
    run::<f64>(&steps);
});

fn run<T: Real>(steps: &[Step]) {
    let mut factor = Factor::<T, P>::new();
    let mut kept = factor;
    let lengths = Lengths { r: T::of(150.0) };
    let (Ok(mut joint), Ok(mut two_step)) = (Joint::new(lengths), TwoStep::new(lengths)) else { return };
    for step in steps {
        let (before, joint_before, two_step_before) = (factor, joint, two_step);
        let row = |x: &[f64; P]| SVector::from(x.map(T::of));
        let outcome = match step {
            Step::Push(x, y) => factor.push(&row(x), T::of(*y)),
            Step::PushWhole(x, y) => factor.push(&row(&x.map(f64::from)), T::of(f64::from(*y))),
            Step::Weighted(x, y, weight) => factor.push_weighted(&row(x), T::of(*y), T::of(*weight)),
            Step::Merge => factor.merge(&kept),
            Step::Tilting(a, values) => {
                let [y, y_a, z_a] = values.map(T::of);
                let taken = two_step.push_tilting(T::of(*a), y, y_a, z_a);
                assert!(taken.is_ok() || two_step == two_step_before);
                joint.push_tilting(T::of(*a), y, y_a, z_a)
            }
            Step::Separation(a, y) => {
                let taken = two_step.push_separation(T::of(*a), T::of(*y));
                assert!(taken.is_ok() || two_step == two_step_before);
                joint.push_separation(T::of(*a), T::of(*y))
            }
            Step::Keep => {
                kept = factor;
                Ok(())
            }
            Step::Restart(radius) => {
                joint = Joint::new(Lengths { r: T::of(*radius) }).unwrap_or(joint);
                Ok(())
            }
        };
        assert!(outcome.is_ok() || (factor == before && joint == joint_before));
        sound(factor.solve().ok());
        sound(factor.solve_with_sigma(T::of(0.1)).ok());
        sound(STEPS.solve(&kept, &factor).ok());
        sound(STEPS.solve_with_sigma(&kept, &factor, T::of(0.1)).ok());
        if let Ok(condition) = factor.condition() {
            assert!(condition.number.is_finite());
        }
    }
    for estimate in [joint.solve().ok(), two_step.solve().ok()].into_iter().flatten() {
        sound(Some(estimate.solution));
        for a in [T::zero(), T::one(), T::max_value(), T::nan()] {
            assert!(estimate.e_xa(a).ok().is_none_or(|(value, std)| value.is_finite() && std.is_finite()));
        }
    }
}

fn sound<T: Real, const N: usize>(solution: Option<Solution<T, N>>) {
    let Some(solution) = solution else { return };
    assert!(solution.coefficients.iter().chain(&solution.covariance).all(|v| v.is_finite()));
    assert!(solution.residual_std.is_finite());
    assert!(solution.std().iter().all(|v| v.is_finite()));
}
