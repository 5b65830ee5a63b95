//! Stack, by painting it and looking how far down the paint is gone.

use core::ptr;

const PAINT: u32 = 0xa5c3_96e1;
/// How much is painted, bytes; what takes more is reported as this.
const DEPTH: u32 = 64 * 1024;

/// Bytes of stack that `f` takes.
#[inline(never)]
pub fn used_by(f: impl FnOnce()) -> u32 {
    let top = cortex_m::register::msp::read();
    let words = (top - DEPTH..top).step_by(4);
    for address in words.clone() {
        // SAFETY: below the stack pointer nothing lives, no interrupt is enabled, and the bank of RAM is far larger.
        unsafe { ptr::write_volatile(address as *mut u32, PAINT) };
    }
    call(f);
    let mut deepest = top;
    for address in words {
        // SAFETY: as above; what `f` left there is read as plain words.
        if unsafe { ptr::read_volatile(address as *const u32) } != PAINT {
            deepest = address;
            break;
        }
    }
    top - deepest
}

#[inline(never)]
fn call(f: impl FnOnce()) {
    f();
}
