//! A probe's offset from any touches, in `f32` and `f64`: finite or refused.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use trunnion_fuzz::{finite, repeated};
use trunnion_solver::{
    Real,
    probe::{Reversal, Touch, offset},
};

#[derive(Arbitrary, Debug)]
enum Input {
    Any(Vec<([f64; 2], f64)>, f64),
    /// In a ring: the touch's direction and the spindle in turns of 1/256, and what is off, µm.
    Ring {
        offset: [i16; 2],
        radius: u8,
        touches: Vec<(u8, u8, i8)>,
    },
    Reversal {
        places: [[f64; 2]; 3],
        radius: f64,
        touch: f64,
        ring: f64,
    },
}

fuzz_target!(|input: Input| {
    check::<f32>(&input);
    check::<f64>(&input);
});

fn check<T: Real>(input: &Input) {
    let turn = |of: u8| f64::from(of) * std::f64::consts::TAU / 256.0;
    let touch = |position: [f64; 2], turned: f64| Touch { position: position.map(T::of), turned: T::of(turned) };
    match input {
        Input::Any(touches, sigma) => {
            let touches: Vec<_> = touches.iter().map(|(position, turned)| touch(*position, *turned)).collect();
            finite(&repeated(|| offset(&touches, T::of(*sigma))).ok());
        }
        Input::Ring { offset: [x, y], radius, touches } => {
            let ring = |(direction, spindle, off): &(u8, u8, i8)| {
                let (r, offset) = (f64::from(*radius) + 1e-3 * f64::from(*off), [*x, *y].map(|o| 1e-3 * f64::from(o)));
                let ((s, c), (sin, cos)) = (turn(*direction).sin_cos(), turn(*spindle).sin_cos());
                let at = [r * c - cos * offset[0] + sin * offset[1], r * s - sin * offset[0] - cos * offset[1]];
                touch(at, turn(*spindle))
            };
            let touches: Vec<_> = touches.iter().map(ring).collect();
            finite(&repeated(|| offset(&touches, T::of(1e-3))).ok());
        }
        Input::Reversal { places, radius, touch, ring } => {
            let [centre, x, y] = places.map(|p| p.map(T::of));
            let touches = Reversal { centre, x, y, radius: T::of(*radius) };
            finite(&repeated(|| touches.exact()).ok());
            finite(&repeated(|| touches.covariance(T::of(*touch), T::of(*ring))).ok());
        }
    }
}
