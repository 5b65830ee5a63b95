//! Instructions, counted by the system timer.
//!
//! QEMU does not model the cycle counter. Under `-icount shift=0` an instruction takes one nanosecond, and the timer runs at
//! the board's 25 MHz: one tick is forty instructions. Sums over many calls resolve far below a tick.

use cortex_m::peripheral::{SYST, syst::SystClkSource};

/// Instructions per tick of the timer.
pub const TICK: u32 = 40;
/// The timer counts down over 24 bits.
const RANGE: u32 = 0x00ff_ffff;

/// The running timer.
pub struct Clock {
    overhead: u32,
}

/// What a series of calls took, instructions.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    ticks: u32,
    calls: u32,
    most: u32,
}

impl Clock {
    /// Starts the timer, and measures what measuring takes.
    pub fn new(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(RANGE);
        timer.clear_current();
        timer.enable_counter();
        let mut clock = Self { overhead: 0 };
        let mut nothing = Cost::default();
        (0..1000).for_each(|_| clock.time(&mut nothing, || ()));
        clock.overhead = nothing.mean(0);
        clock
    }

    /// Calls `f` and adds what it took to `cost`.
    #[inline(never)]
    pub fn time<R>(&self, cost: &mut Cost, f: impl FnOnce() -> R) -> R {
        let before = SYST::get_current();
        let result = f();
        let ticks = before.wrapping_sub(SYST::get_current()) & RANGE;
        cost.ticks = cost.ticks.wrapping_add(ticks);
        cost.calls += 1;
        cost.most = cost.most.max(ticks);
        result
    }

    /// Mean of the calls, without what measuring takes.
    pub fn mean(&self, cost: &Cost) -> u32 {
        cost.mean(self.overhead)
    }

    /// A bound of the longest call: at most a tick above it.
    pub fn most(&self, cost: &Cost) -> u32 {
        ((cost.most + 1) * TICK).saturating_sub(self.overhead)
    }
}

impl Cost {
    fn mean(&self, overhead: u32) -> u32 {
        let mean = u64::from(self.ticks) * u64::from(TICK) / u64::from(self.calls.max(1));
        u32::try_from(mean).unwrap_or(u32::MAX).saturating_sub(overhead)
    }
}
