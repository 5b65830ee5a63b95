//! The paper's two steps: run 2 gives what run 1 is corrected by.

use crate::estimate::{failure, give};
use crate::state::{State, copied, fits, init, with_mut};
use crate::status::status;
use crate::{TrunnionEstimate, TrunnionStatus};
use trunnion_solver::tilting::{Lengths, TwoStep};

/// Size of the state in words of eight bytes.
pub const TRUNNION_TWO_STEP_F32_WORDS: usize = 104;

/// The state, in memory that the caller gives. Its contents are nobody else's.
#[repr(C)]
pub struct TrunnionTwoStepF32 {
    opaque: [u64; TRUNNION_TWO_STEP_F32_WORDS],
}

// SAFETY: plain words; that they suffice is asserted below.
unsafe impl State for TrunnionTwoStepF32 {
    type Fit = TwoStep<f32>;
    const MARK: u64 = 0x7472_7332_f032_0001;
}
const _: () = assert!(fits::<TrunnionTwoStepF32>());

/// Makes a state of no samples for a bar of nominal length `radius`, mm.
///
/// # Safety
/// `state` is null or points to writable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f32_init(state: *mut TrunnionTwoStepF32, radius: f32) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { init(state, TwoStep::new(Lengths { r: radius })) }
}

/// Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.
///
/// # Safety
/// `state` is null or points to memory of its type that nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f32_push_tilting(
    state: *mut TrunnionTwoStepF32,
    a: f32,
    deviation: f32,
    known_y: f32,
    known_z: f32,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_tilting(a, deviation, known_y, known_z))) }
}

/// Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.
///
/// # Safety
/// As [`trunnion_two_step_f32_push_tilting`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f32_push_separation(
    state: *mut TrunnionTwoStepF32,
    a: f32,
    deviation: f32,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_separation(a, deviation))) }
}

/// The estimate from all samples so far. If there is none, the result is marked invalid.
///
/// # Safety
/// `state` is null or points to readable memory of its type, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f32_solve(
    state: *const TrunnionTwoStepF32,
    result: *mut TrunnionEstimate<f32>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe {
        let fit = copied(state).map_err(|status| (status, 0));
        give(fit.and_then(|fit| fit.solve().map_err(|e| failure(e.why))), result)
    }
}

/// Size of the state in words of eight bytes.
pub const TRUNNION_TWO_STEP_F64_WORDS: usize = 206;

/// The state, in memory that the caller gives. Its contents are nobody else's.
#[repr(C)]
pub struct TrunnionTwoStepF64 {
    opaque: [u64; TRUNNION_TWO_STEP_F64_WORDS],
}

// SAFETY: plain words; that they suffice is asserted below.
unsafe impl State for TrunnionTwoStepF64 {
    type Fit = TwoStep<f64>;
    const MARK: u64 = 0x7472_7332_f064_0001;
}
const _: () = assert!(fits::<TrunnionTwoStepF64>());

/// Makes a state of no samples for a bar of nominal length `radius`, mm.
///
/// # Safety
/// `state` is null or points to writable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f64_init(state: *mut TrunnionTwoStepF64, radius: f64) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { init(state, TwoStep::new(Lengths { r: radius })) }
}

/// Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.
///
/// # Safety
/// `state` is null or points to memory of its type that nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f64_push_tilting(
    state: *mut TrunnionTwoStepF64,
    a: f64,
    deviation: f64,
    known_y: f64,
    known_z: f64,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_tilting(a, deviation, known_y, known_z))) }
}

/// Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.
///
/// # Safety
/// As [`trunnion_two_step_f64_push_tilting`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f64_push_separation(
    state: *mut TrunnionTwoStepF64,
    a: f64,
    deviation: f64,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_separation(a, deviation))) }
}

/// The estimate from all samples so far. If there is none, the result is marked invalid.
///
/// # Safety
/// `state` is null or points to readable memory of its type, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_two_step_f64_solve(
    state: *const TrunnionTwoStepF64,
    result: *mut TrunnionEstimate<f64>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe {
        let fit = copied(state).map_err(|status| (status, 0));
        give(fit.and_then(|fit| fit.solve().map_err(|e| failure(e.why))), result)
    }
}
