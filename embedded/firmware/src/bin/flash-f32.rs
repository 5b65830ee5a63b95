//! The joint estimator in `f32` and nothing else: how much flash it takes.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m_rt::entry;
use trunnion_solver::tilting::{Joint, Lengths};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[entry]
fn main() -> ! {
    let Ok(mut fit) = Joint::<f32>::new(Lengths { r: black_box(150.0) }) else { loop {} };
    loop {
        let _ = black_box(fit.push_tilting(black_box(1.0), black_box(0.0), black_box(0.0), black_box(0.0)));
        let _ = black_box(fit.push_separation(black_box(1.0), black_box(0.0)));
        if let Ok(estimate) = fit.solve() {
            let _ = black_box(estimate.e_xa(black_box(1.0)));
            black_box(estimate);
        }
    }
}
