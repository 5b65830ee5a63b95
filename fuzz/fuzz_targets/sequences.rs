//! Any sequence of samples, merges and solves, in `f32` and `f64`: a status or a finite result, never a panic or a NaN, and
//! a refused sample leaves no trace. `cargo +nightly fuzz run sequences`
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use nalgebra::{SMatrix, SVector};
use num_traits::{AsPrimitive, FloatConst};
use trunnion_solver::{
    Real,
    lstsq::{Factor, Solution},
    tilting::Joint,
};

const P: usize = 4;

#[derive(Arbitrary, Debug)]
enum Step {
    Push([f64; P], f64),
    /// Small whole numbers: dependent columns and exact zeros.
    PushWhole([i8; P], i8),
    Weighted([f64; P], f64, f64),
    Merge,
    Keep,
    Tilting(f64, f64, [f64; 2]),
    Separation(f64, f64),
    Restart(f64),
}

fuzz_target!(|steps: Vec<Step>| {
    run::<f32>(&steps);
    run::<f64>(&steps);
});

fn run<T: Real + FloatConst + 'static>(steps: &[Step])
where
    f64: AsPrimitive<T>,
{
    let mut factor = Factor::<T, P>::new();
    let mut kept = factor;
    let Ok(mut joint) = Joint::new(T::of(150.0)) else { return };
    for step in steps {
        let (before, joint_before) = (factor, joint);
        let row = |x: &[f64; P]| SVector::from(x.map(T::of));
        let outcome = match step {
            Step::Push(x, y) => factor.push(&row(x), T::of(*y)),
            Step::PushWhole(x, y) => factor.push(&row(&x.map(f64::from)), T::of(f64::from(*y))),
            Step::Weighted(x, y, weight) => factor.push_weighted(&row(x), T::of(*y), T::of(*weight)),
            Step::Merge => factor.merge(&kept),
            Step::Tilting(a, y, known) => joint.push_tilting(T::of(*a), T::of(*y), known.map(T::of)),
            Step::Separation(a, y) => joint.push_separation(T::of(*a), T::of(*y)),
            Step::Keep => {
                kept = factor;
                Ok(())
            }
            Step::Restart(radius) => {
                joint = Joint::new(T::of(*radius)).unwrap_or(joint);
                Ok(())
            }
        };
        assert!(outcome.is_ok() || (factor == before && joint == joint_before));
        sound(factor.solve().ok());
        sound(factor.solve_with_sigma(T::of(0.1)).ok());
        sound(factor.solve_given::<3, 1>(&SVector::from([T::one()]), &SMatrix::from([[T::one()]])).ok());
        if let Ok(condition) = factor.condition() {
            assert!(condition.number.is_finite());
        }
    }
    if let Ok(estimate) = joint.solve() {
        sound(Some(estimate.solution));
        for a in [T::zero(), T::one(), T::max_value(), T::nan()] {
            assert!(estimate.eps_xa(a).is_none_or(|(value, std)| value.is_finite() && std.is_finite()));
            assert!(estimate.band(a).is_none_or(|band| band.is_finite()));
        }
    }
}

fn sound<T: Real, const N: usize>(solution: Option<Solution<T, N>>) {
    let Some(solution) = solution else { return };
    assert!(solution.coefficients.iter().chain(&solution.covariance).all(|v| v.is_finite()));
    assert!(solution.residual_std.is_finite());
    assert!(solution.std().iter().all(|v| v.is_finite()));
}
