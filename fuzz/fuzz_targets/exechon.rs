//! Kinematics of any machine, in `f32` and `f64`: finite or refused.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use trunnion_fuzz::{finite, repeated};
use trunnion_solver::{
    Real,
    exechon::{Branch, Dimensions, Home, Joints, Limits, Machine, Start, Target, Tilted},
};

/// Of a machine that there is; all else differs from it.
const XT700: [f64; 10] = [450.0, 450.0, 150.0, 150.0, 25.0, 375.0, -30.0, 380.0, 1438.0, -std::f64::consts::FRAC_PI_4];

#[derive(Arbitrary, Debug)]
enum Numbers {
    Any([f64; 10]),
    /// Hundredths by which each differs.
    Near([i8; 10]),
}

#[derive(Arbitrary, Debug)]
struct Input {
    machine: Numbers,
    /// Tenths of mm from home, and a direction in base coordinates.
    near: Vec<([i16; 3], [i8; 3])>,
    any: Option<([f64; 3], [f64; 3], f64)>,
    platform: [i16; 3],
    positive: bool,
}

fuzz_target!(|input: Input| {
    check::<f32>(&input);
    check::<f64>(&input);
});

fn check<T: Real>(input: &Input) {
    let numbers = match input.machine {
        Numbers::Any(numbers) => numbers,
        Numbers::Near(by) => std::array::from_fn(|k| XT700[k] * (1.0 + f64::from(by[k]) / 100.0)),
    };
    let [xu, ys2, xr, yr5, ycp, zc, yt, tz, strut, a] = numbers.map(T::of);
    let (dimensions, home) = (Dimensions { xu, ys2, xr, yr5, ycp, zc, yt, tz }, Home { strut, a });
    let Ok(machine) = repeated(|| Machine::new(dimensions, home, Limits::none())) else { return };
    finite(machine.home());
    finite(&machine.frame());
    let branch = if input.positive { Branch::Positive } else { Branch::Negative };
    let elsewhere = Start { platform: input.platform.map(|x| T::of(f64::from(x))), branch };
    for start in [machine.home().start(), elsewhere] {
        for (off, direction) in &input.near {
            let from = machine.home().point;
            let point = std::array::from_fn(|k| from[k] + T::of(0.1 * f64::from(off[k])));
            let [i, j, k] = direction.map(f64::from);
            let length = (i * i + j * j + k * k).sqrt();
            solve(&machine, point, [i, j, k].map(|d| T::of(d / length)), &start);
        }
        if let Some((point, direction, turn)) = input.any {
            solve(&machine, point.map(T::of), direction.map(T::of), &start);
            let joints = Joints { struts: point.map(T::of), a: T::of(direction[0]), c: T::of(turn) };
            finite(&repeated(|| machine.forward(&joints, &start)).ok());
        }
    }
}

fn solve<T: Real>(machine: &Machine<T>, point: [T; 3], direction: [T; 3], start: &Start<T>) {
    let Ok(target) = repeated(|| Target::new(point, direction)) else { return };
    let Ok(pose) = repeated(|| machine.inverse(&target, start)) else { return };
    finite(&pose);
    finite(&repeated(|| machine.forward(&pose.joints, start)).ok());
    for tilted in [Tilted::Projected, Tilted::Carried] {
        finite(&repeated(|| machine.dependent_rotation(&pose, tilted)).ok());
    }
}
