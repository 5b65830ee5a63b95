//! Mistakes, made on the target: each must be answered by a status. Prints how many were not.
#![no_std]
#![no_main]

use core::mem::MaybeUninit;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use panic_semihosting as _;
use trunnion_capi::{TrunnionEstimate, TrunnionJointF32, TrunnionStatus, joint};
use trunnion_solver::{
    Real,
    lstsq::{Rejected, SolveError},
    tilting::{Joint, Lengths},
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

fn rust<T: Real>() -> [bool; 12] {
    let (zero, one, nan, infinite) = (T::zero(), T::one(), T::nan(), T::infinity());
    let joint = |r| Joint::new(Lengths { r });
    let Ok(mut fit) = joint(T::of(150.0)) else { return [false; 12] };
    let refused = |outcome| outcome == Err(Rejected::NotFinite);
    let no_samples = matches!(fit.solve(), Err(SolveError::TooFewSamples { .. }));
    let one_angle =
        (0..100).all(|_| fit.push_tilting(one, one, zero, zero).is_ok() & fit.push_separation(one, one).is_ok());
    let before = fit;
    [
        joint(zero).is_err(),
        joint(-one).is_err(),
        joint(nan).is_err(),
        joint(infinite).is_err(),
        refused(fit.push_tilting(nan, zero, zero, zero)),
        refused(fit.push_tilting(infinite, zero, zero, zero)),
        refused(fit.push_tilting(one, nan, zero, zero)),
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
    let mut estimate = MaybeUninit::<TrunnionEstimate<f32>>::uninit();
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
