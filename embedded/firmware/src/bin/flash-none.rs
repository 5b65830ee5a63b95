//! Nothing but the start-up code: what the other `flash-…` are compared with.
#![no_std]
#![no_main]

use cortex_m_rt::entry;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[entry]
fn main() -> ! {
    loop {
        cortex_m::asm::nop();
    }
}
