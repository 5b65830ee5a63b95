//! Mistakes, made on the target: each must be answered by a status. Prints how many were not.
#![no_std]
#![no_main]

use core::mem::MaybeUninit;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use num_traits::{AsPrimitive, FloatConst};
use panic_semihosting as _;
use trunnion_capi::{TrunnionEstimateF32, TrunnionJointF32, TrunnionStatus, joint};
use trunnion_solver::{
    Real,
    lstsq::{Rejected, SolveError},
    tilting::Joint,
};

#[entry]
fn main() -> ! {
    let (single, double, c) = (rust::<f32>(), rust::<f64>(), c());
    let answered = || single.iter().chain(&double).chain(&c);
    let wrong = answered().filter(|answered| !**answered).count();
    hprintln!("mistakes made = {}", answered().count());
    hprintln!("mistakes answered wrongly = {}", wrong);
    debug::exit(if wrong == 0 { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("the debugger has ended the program")
}

fn rust<T: Real + FloatConst + 'static>() -> [bool; 12]
where
    f64: AsPrimitive<T>,
{
    let (zero, one, nan, infinite) = (T::zero(), T::one(), T::nan(), T::infinity());
    let Ok(mut fit) = Joint::new(T::of(150.0)) else { return [false; 12] };
    let refused = |outcome| outcome == Err(Rejected::NotFinite);
    let no_samples = matches!(fit.solve(), Err(SolveError::TooFewSamples { .. }));
    let one_angle =
        (0..100).all(|_| fit.push_tilting(one, one, [zero; 2]).is_ok() & fit.push_separation(one, one).is_ok());
    let before = fit;
    [
        Joint::new(zero).is_err(),
        Joint::new(-one).is_err(),
        Joint::new(nan).is_err(),
        Joint::new(infinite).is_err(),
        refused(fit.push_tilting(nan, zero, [zero; 2])),
        refused(fit.push_tilting(infinite, zero, [zero; 2])),
        refused(fit.push_tilting(one, nan, [zero; 2])),
        refused(fit.push_separation(one, -infinite)),
        fit.push_separation(one, T::max_value()) == Err(Rejected::Overflow),
        fit == before,
        no_samples,
        one_angle && matches!(fit.solve(), Err(SolveError::RankDeficient(_))),
    ]
}

/// Through the C interface, where memory may be anything.
fn c() -> [bool; 6] {
    use TrunnionStatus as Status;
    let mut filled = MaybeUninit::<TrunnionJointF32>::uninit();
    let mut estimate = MaybeUninit::<TrunnionEstimateF32>::uninit();
    let (state, result) = (filled.as_mut_ptr(), estimate.as_mut_ptr());
    let odd = state.cast::<u8>().wrapping_add(1).cast();
    // SAFETY: each pointer is null, misaligned, or points to memory of its type; that this is told apart is the test.
    unsafe {
        state.cast::<u8>().write_bytes(0x5a, size_of::<TrunnionJointF32>());
        [
            joint::trunnion_joint_f32_push_separation(state, 1.0, 0.0) == Status::NotInitialised,
            joint::trunnion_joint_f32_solve(state, result) == Status::NotInitialised,
            joint::trunnion_joint_f32_init(core::ptr::null_mut(), 150.0) == Status::NullPointer,
            joint::trunnion_joint_f32_init(odd, 150.0) == Status::Misaligned,
            joint::trunnion_joint_f32_init(state, f32::NAN) == Status::ImpossibleRadius,
            joint::trunnion_joint_f32_init(state, 150.0) == Status::Ok
                && joint::trunnion_joint_f32_push_separation(state, f32::NAN, 0.0) == Status::NotFinite,
        ]
    }
}
