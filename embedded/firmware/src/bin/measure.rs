//! Prints what the solver costs on this processor, one `name = number` a line: bytes of state and stack, instructions.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware::{clock::Clock, clock::Cost, stack};
use nalgebra::SVector;
use panic_semihosting as _;
use trunnion_solver::{
    Machine, Real,
    lstsq::Factor,
    tilting::{self, Joint, Lengths, TwoStep},
};

/// A machine of one's own: a rotary table and the bar that is held against it.
#[derive(Machine)]
#[machine(constants(R), estimate(EXC))]
#[run(
    along_x,
    sweep = "c",
    at(C = "c"),
    workpiece_ball(setup(w_x, w_y, w_z)),
    tool_ball(at("R", "0", "0"), setup(t_x, t_y, t_z)),
    bar = "R"
)]
#[function(EXC = polynomial(4, "f(0) = 0", "f(2*pi) = f(0)"))]
pub struct Table {
    /// Angle of the table, rad.
    #[workpiece(rotary = "z", location(EX0C, EY0C))]
    pub c: f64,
}
/// So many the documentation says.
const _: () = assert!(Table::NAMES.len() == 6);

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

fn measure<T: Real>(clock: &Clock, kind: &str) {
    let radius = T::of(runs::RADIUS);
    let (mut row, mut push, mut both) = (Cost::default(), Cost::default(), Cost::default());
    let (mut tilting, mut separation, mut two_step_both) = (Cost::default(), Cost::default(), Cost::default());
    let mut eight = Factor::<T, 8>::new();
    let mut again = Factor::<T, 8>::new();
    let (mut own_row, mut own_sample) = (Cost::default(), Cost::default());
    let lengths = Lengths { r: radius };
    let (Ok(mut joint), Ok(mut two_step)) = (Joint::new(lengths), TwoStep::new(lengths)) else { return };
    let Ok(mut own) = Table::fit(TableLengths { r: radius }) else { return };
    for sample in runs::turn() {
        let a = black_box(T::of(sample.angle));
        let y = [sample.tilting, sample.separation].map(|y| black_box(T::of(y)));
        let [y_a, z_a] = black_box(sample.known.map(T::of));
        let x = SVector::from(clock.time(&mut row, || black_box(tilting::separation(black_box(radius), a))));
        let taken = clock.time(&mut push, || black_box(&mut again).push(black_box(&x), y[1])).is_ok()
            & clock
                .time(&mut both, || {
                    black_box(&mut eight).push(&SVector::from(tilting::separation(black_box(radius), a)), y[1])
                })
                .is_ok()
            & clock.time(&mut tilting, || black_box(&mut joint).push_tilting(a, y[0], y_a, z_a)).is_ok()
            & clock.time(&mut separation, || black_box(&mut joint).push_separation(a, y[1])).is_ok()
            & clock.time(&mut two_step_both, || {
                let two_step = black_box(&mut two_step);
                two_step.push_tilting(a, y[0], y_a, z_a).is_ok() & two_step.push_separation(a, y[1]).is_ok()
            })
            & clock.time(&mut own_sample, || black_box(&mut own).push_along_x(a, y[1])).is_ok();
        clock.time(&mut own_row, || black_box(Table::along_x(black_box(radius), a)));
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
    hprintln!("{} own machine, row = {}", kind, clock.mean(&own_row));
    hprintln!("{} own machine, sample = {}", kind, clock.mean(&own_sample));

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
    let of_eight = |x: T| SVector::from(tilting::separation(black_box(radius), x));
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
            let _ = black_box(black_box(&mut joint).push_tilting(a, a, a, a));
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
