//! Both runs at once: every coefficient from all samples, with an honest covariance.

use crate::estimate::{failure, give};
use crate::state::{State, copied, fits, init, with_mut};
use crate::status::status;
use crate::{TrunnionEstimate, TrunnionStatus};
use trunnion_solver::tilting::{Joint, Lengths};

/// Size of the state in words of eight bytes.
pub const TRUNNION_JOINT_F32_WORDS: usize = 100;

/// The state, in memory that the caller gives. Its contents are nobody else's.
#[repr(C)]
pub struct TrunnionJointF32 {
    opaque: [u64; TRUNNION_JOINT_F32_WORDS],
}

// SAFETY: plain words; that they suffice is asserted below.
unsafe impl State for TrunnionJointF32 {
    type Fit = Joint<f32>;
    const MARK: u64 = 0x7472_6a31_f032_0001;
}
const _: () = assert!(fits::<TrunnionJointF32>());

/// Makes a state of no samples for a bar of nominal length `radius`, mm.
///
/// # Safety
/// `state` is null or points to writable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f32_init(state: *mut TrunnionJointF32, radius: f32) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { init(state, Joint::new(Lengths { r: radius })) }
}

/// Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.
///
/// # Safety
/// `state` is null or points to memory of its type that nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f32_push_tilting(
    state: *mut TrunnionJointF32,
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
/// As [`trunnion_joint_f32_push_tilting`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f32_push_separation(
    state: *mut TrunnionJointF32,
    a: f32,
    deviation: f32,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_separation(a, deviation))) }
}

/// Adds the samples of `other`, which may be the state itself.
///
/// # Safety
/// As [`trunnion_joint_f32_push_tilting`], and `other` is null or points to readable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f32_merge(
    state: *mut TrunnionJointF32,
    other: *const TrunnionJointF32,
) -> TrunnionStatus {
    // SAFETY: as required here.
    match unsafe { copied(other) } {
        Err(status) => status,
        // SAFETY: as required here.
        Ok(other) => unsafe { with_mut(state, |fit| status(fit.merge(&other))) },
    }
}

/// The estimate from all samples so far. If there is none, the result is marked invalid.
///
/// # Safety
/// `state` is null or points to readable memory of its type, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f32_solve(
    state: *const TrunnionJointF32,
    result: *mut TrunnionEstimate<f32>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe {
        let fit = copied(state).map_err(|status| (status, 0));
        give(fit.and_then(|fit| fit.solve().map_err(failure)), result)
    }
}

/// Size of the state in words of eight bytes.
pub const TRUNNION_JOINT_F64_WORDS: usize = 199;

/// The state, in memory that the caller gives. Its contents are nobody else's.
#[repr(C)]
pub struct TrunnionJointF64 {
    opaque: [u64; TRUNNION_JOINT_F64_WORDS],
}

// SAFETY: plain words; that they suffice is asserted below.
unsafe impl State for TrunnionJointF64 {
    type Fit = Joint<f64>;
    const MARK: u64 = 0x7472_6a31_f064_0001;
}
const _: () = assert!(fits::<TrunnionJointF64>());

/// Makes a state of no samples for a bar of nominal length `radius`, mm.
///
/// # Safety
/// `state` is null or points to writable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f64_init(state: *mut TrunnionJointF64, radius: f64) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { init(state, Joint::new(Lengths { r: radius })) }
}

/// Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.
///
/// # Safety
/// `state` is null or points to memory of its type that nothing else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f64_push_tilting(
    state: *mut TrunnionJointF64,
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
/// As [`trunnion_joint_f64_push_tilting`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f64_push_separation(
    state: *mut TrunnionJointF64,
    a: f64,
    deviation: f64,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { with_mut(state, |fit| status(fit.push_separation(a, deviation))) }
}

/// Adds the samples of `other`, which may be the state itself.
///
/// # Safety
/// As [`trunnion_joint_f64_push_tilting`], and `other` is null or points to readable memory of its type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f64_merge(
    state: *mut TrunnionJointF64,
    other: *const TrunnionJointF64,
) -> TrunnionStatus {
    // SAFETY: as required here.
    match unsafe { copied(other) } {
        Err(status) => status,
        // SAFETY: as required here.
        Ok(other) => unsafe { with_mut(state, |fit| status(fit.merge(&other))) },
    }
}

/// The estimate from all samples so far. If there is none, the result is marked invalid.
///
/// # Safety
/// `state` is null or points to readable memory of its type, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_joint_f64_solve(
    state: *const TrunnionJointF64,
    result: *mut TrunnionEstimate<f64>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe {
        let fit = copied(state).map_err(|status| (status, 0));
        give(fit.and_then(|fit| fit.solve().map_err(failure)), result)
    }
}
