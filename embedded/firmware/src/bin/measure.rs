//! Prints what the solver costs on this processor, one `name = number` a line: bytes of state and stack, instructions.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware::{clock::Clock, clock::Cost, stack};
use nalgebra::SVector;
use num_traits::{AsPrimitive, FloatConst};
use panic_semihosting as _;
use trunnion_solver::{
    Real,
    lstsq::Factor,
    tilting::{Joint, TwoStep, regressors},
};

#[entry]
fn main() -> ! {
    if let Some(peripherals) = cortex_m::Peripherals::take() {
        let clock = Clock::new(peripherals.SYST);
        // A loop of known length (two instructions a turn) shows that an instruction is counted as one.
        let mut delay = Cost::default();
        (0..100).for_each(|_| clock.time(&mut delay, || cortex_m::asm::delay(10_000)));
        hprintln!("delay of 10000 = {}", clock.mean(&delay));
        measure::<f32>(&clock, "f32");
        measure::<f64>(&clock, "f64");
        debug::exit(debug::EXIT_SUCCESS);
    }
    debug::exit(debug::EXIT_FAILURE);
    unreachable!("the debugger has ended the program")
}

fn measure<T: Real + FloatConst + 'static>(clock: &Clock, kind: &str)
where
    f64: AsPrimitive<T>,
{
    let radius = T::of(runs::RADIUS);
    let (mut row, mut push, mut both) = (Cost::default(), Cost::default(), Cost::default());
    let (mut tilting, mut separation, mut two_step_both) = (Cost::default(), Cost::default(), Cost::default());
    let mut eight = Factor::<T, 8>::new();
    let mut again = Factor::<T, 8>::new();
    let (Ok(mut joint), Ok(mut two_step)) = (Joint::new(radius), TwoStep::new(radius)) else { return };
    for sample in runs::turn() {
        let a = black_box(T::of(sample.angle));
        let y = [sample.tilting, sample.separation].map(|y| black_box(T::of(y)));
        let known = black_box(sample.known.map(T::of));
        let x = SVector::from(clock.time(&mut row, || black_box(regressors::separation(black_box(radius), a))));
        let taken = clock.time(&mut push, || black_box(&mut again).push(black_box(&x), y[1])).is_ok()
            & clock
                .time(&mut both, || {
                    black_box(&mut eight).push(&SVector::from(regressors::separation(black_box(radius), a)), y[1])
                })
                .is_ok()
            & clock.time(&mut tilting, || black_box(&mut joint).push_tilting(a, y[0], known)).is_ok()
            & clock.time(&mut separation, || black_box(&mut joint).push_separation(a, y[1])).is_ok()
            & clock.time(&mut two_step_both, || {
                let two_step = black_box(&mut two_step);
                two_step.push_tilting(a, y[0], known).is_ok() & two_step.push_separation(a, y[1]).is_ok()
            });
        if !taken {
            hprintln!("a sample was rejected");
        }
    }
    hprintln!("{} row of 8 = {}", kind, clock.mean(&row));
    hprintln!("{} push of 8 = {}", kind, clock.mean(&push));
    hprintln!("{} row and push of 8 = {}", kind, clock.mean(&both));
    hprintln!("{} row and push of 8, longest = {}", kind, clock.most(&both));
    hprintln!("{} joint, sample of run 1 = {}", kind, clock.mean(&tilting));
    hprintln!("{} joint, sample of run 2 = {}", kind, clock.mean(&separation));
    hprintln!("{} two-step, sample of each run = {}", kind, clock.mean(&two_step_both));

    let (mut of_eight, mut of_joint, mut of_two_step) = (Cost::default(), Cost::default(), Cost::default());
    for _ in 0..40 {
        let _ = black_box(clock.time(&mut of_eight, || black_box(&eight).solve()));
        let _ = black_box(clock.time(&mut of_joint, || black_box(&joint).solve()));
        let _ = black_box(clock.time(&mut of_two_step, || black_box(&two_step).solve()));
    }
    hprintln!("{} solve of 8 = {}", kind, clock.mean(&of_eight));
    hprintln!("{} solve, joint = {}", kind, clock.mean(&of_joint));
    hprintln!("{} solve, two-step = {}", kind, clock.mean(&of_two_step));

    hprintln!("{} state of 8 = {}", kind, size_of::<Factor<T, 8>>());
    hprintln!("{} state, joint = {}", kind, size_of::<Joint<T>>());
    hprintln!("{} state, two-step = {}", kind, size_of::<TwoStep<T>>());

    let a = black_box(T::one());
    let of_eight = |x: T| SVector::from(regressors::separation(black_box(radius), x));
    hprintln!(
        "{} stack, row and push of 8 = {}",
        kind,
        stack::used_by(|| {
            let _ = black_box(black_box(&mut eight).push(&of_eight(a), a));
        })
    );
    hprintln!(
        "{} stack, joint sample = {}",
        kind,
        stack::used_by(|| {
            let _ = black_box(black_box(&mut joint).push_tilting(a, a, [a, a]));
        })
    );
    hprintln!(
        "{} stack, solve of 8 = {}",
        kind,
        stack::used_by(|| {
            let _ = black_box(black_box(&eight).solve());
        })
    );
    hprintln!(
        "{} stack, solve, joint = {}",
        kind,
        stack::used_by(|| {
            let _ = black_box(black_box(&joint).solve());
        })
    );
    hprintln!(
        "{} stack, solve, two-step = {}",
        kind,
        stack::used_by(|| {
            let _ = black_box(black_box(&two_step).solve());
        })
    );
}
