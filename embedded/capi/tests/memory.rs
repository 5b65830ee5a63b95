//! The C interface on the memory of Rust, for Miri: garbage, a state copied by its bytes, a state merged with itself.

use std::mem::MaybeUninit;
use std::ptr;
use trunnion_capi::{TrunnionEpsXa, TrunnionEstimate, TrunnionJointF64, TrunnionStatus, estimate, joint};

#[test]
fn states_are_plain_memory() {
    let mut memory = MaybeUninit::<TrunnionJointF64>::zeroed();
    let mut result = MaybeUninit::<TrunnionEstimate<f64>>::zeroed();
    let mut at = MaybeUninit::<TrunnionEpsXa<f64>>::zeroed();
    let state = memory.as_mut_ptr();
    // SAFETY: every pointer is to memory of its type.
    unsafe {
        assert_eq!(joint::trunnion_joint_f64_push_separation(state, 0.0, 0.0), TrunnionStatus::NotInitialised);
        assert_eq!(joint::trunnion_joint_f64_init(state, runs::RADIUS), TrunnionStatus::Ok);
        for s in runs::turn().step_by(12) {
            let [y, z] = s.known;
            assert_eq!(joint::trunnion_joint_f64_push_tilting(state, s.angle, s.tilting, y, z), TrunnionStatus::Ok);
            assert_eq!(joint::trunnion_joint_f64_push_separation(state, s.angle, s.separation), TrunnionStatus::Ok);
        }
        let mut moved = MaybeUninit::<TrunnionJointF64>::uninit();
        ptr::copy_nonoverlapping(state, moved.as_mut_ptr(), 1);
        let state = moved.as_mut_ptr();
        assert_eq!(joint::trunnion_joint_f64_merge(state, state), TrunnionStatus::Ok);
        assert_eq!(joint::trunnion_joint_f64_solve(state, result.as_mut_ptr()), TrunnionStatus::Ok);
        assert_eq!(result.assume_init_ref().degrees_of_freedom, 4 * 30 - 13);
        assert_eq!(estimate::trunnion_eps_xa_f64(result.as_ptr(), 1.0, at.as_mut_ptr()), TrunnionStatus::Ok);
        assert!(at.assume_init_ref().value.is_finite() && at.assume_init_ref().band > 0.0);
    }
}
