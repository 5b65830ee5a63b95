//! States in the caller's memory: checked before they are believed.

use crate::TrunnionStatus;
use core::ptr;

/// A C type that holds a `Fit` behind its mark.
///
/// # Safety
/// `Self` is plain words, at least as large and as aligned as [`Marked<Self::Fit>`].
pub unsafe trait State {
    /// What is inside.
    type Fit: Copy;
    /// Tells this kind of state from memory that is none.
    const MARK: u64;
}

/// A state's contents.
#[repr(C)]
pub struct Marked<Fit> {
    mark: u64,
    fit: Fit,
}

/// Whether words suffice for a state.
pub(crate) const fn fits<S: State>() -> bool {
    size_of::<S>() == size_of::<Marked<S::Fit>>().next_multiple_of(8) && align_of::<S>() >= align_of::<Marked<S::Fit>>()
}

/// Null and alignment.
pub(crate) fn check<T>(pointer: *const T) -> Result<(), TrunnionStatus> {
    match pointer {
        p if p.is_null() => Err(TrunnionStatus::NullPointer),
        p if !p.is_aligned() => Err(TrunnionStatus::Misaligned),
        _ => Ok(()),
    }
}

/// Puts a fit into the caller's memory.
///
/// # Safety
/// `state` is null or points to a `S` that may be written.
pub(crate) unsafe fn init<S: State, E: Into<TrunnionStatus>>(state: *mut S, fit: Result<S::Fit, E>) -> TrunnionStatus {
    let marked = state.cast::<Marked<S::Fit>>();
    match check(state).and(fit.map_err(Into::into)) {
        Err(status) => status,
        Ok(fit) => {
            // SAFETY: not null, aligned, of the caller's word writable, and large enough (`State`).
            unsafe { ptr::write(marked, Marked { mark: S::MARK, fit }) };
            TrunnionStatus::Ok
        }
    }
}

/// Changes the fit in a state.
///
/// # Safety
/// `state` is null or points to a `S` that nobody else uses meanwhile, whose words may be of any value.
pub(crate) unsafe fn with_mut<S: State>(
    state: *mut S,
    change: impl FnOnce(&mut S::Fit) -> TrunnionStatus,
) -> TrunnionStatus {
    // SAFETY: as required here.
    match unsafe { marked(state) } {
        Err(status) => status,
        // SAFETY: `init` has made it, and the caller says that nobody else uses it.
        Ok(()) => change(unsafe { &mut (*state.cast::<Marked<S::Fit>>()).fit }),
    }
}

/// A copy of the fit in a state.
///
/// # Safety
/// `state` is null or points to a `S` that nobody changes meanwhile, whose words may be of any value.
pub(crate) unsafe fn copied<S: State>(state: *const S) -> Result<S::Fit, TrunnionStatus> {
    // SAFETY: as required here.
    unsafe { marked(state) }?;
    // SAFETY: `init` has made it.
    Ok(unsafe { (*state.cast::<Marked<S::Fit>>()).fit })
}

/// Whether there is a state of this kind behind a pointer.
///
/// # Safety
/// `state` is null or points to a readable `S`.
unsafe fn marked<S: State>(state: *const S) -> Result<(), TrunnionStatus> {
    check(state)?;
    // SAFETY: not null and aligned; volatile, since memory that was never written has no value to reason about.
    let mark = unsafe { ptr::read_volatile(state.cast::<u64>()) };
    if mark == S::MARK { Ok(()) } else { Err(TrunnionStatus::NotInitialised) }
}
