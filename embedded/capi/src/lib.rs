//! The estimators of [`trunnion_solver::tilting`] for programs in C; `include/trunnion.h` is generated from here.
//!
//! The caller gives the memory, every function answers with a [`TrunnionStatus`], and nothing is allocated. A state carries
//! a mark that `…_init` sets, so that memory which was never initialised, or is a state of another kind, is refused.
//!
//! This is the one crate of the project with `unsafe` in it: what is behind a pointer is the caller's word. The checks are in
//! [`state`]: null, misaligned, unmarked. A pointer to memory that is not there cannot be seen from here.
#![no_std]

pub mod estimate;
pub mod joint;
pub mod state;
pub mod status;
pub mod two_step;

pub use estimate::{TrunnionEpsXa, TrunnionEstimate};
pub use joint::{TrunnionJointF32, TrunnionJointF64};
pub use status::TrunnionStatus;
pub use two_step::{TrunnionTwoStepF32, TrunnionTwoStepF64};

/// The library has no way to panic. Should a change give it one, this call remains in it and nothing links any more.
#[cfg(feature = "standalone")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn trunnion_can_panic() -> !;
    }
    // SAFETY: never called: it is defined nowhere.
    unsafe { trunnion_can_panic() }
}
