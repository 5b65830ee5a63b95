//! Circles through any points, in `f32` and `f64`: finite or refused, and no zone wider than the least-squares circle's.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use trunnion_fuzz::{finite, repeated};
use trunnion_solver::{
    Real,
    circle::{least_squares, minimum_zone},
};

#[derive(Arbitrary, Debug)]
enum Points {
    Any(Vec<[f64; 2]>),
    /// Equal points, lines, squares.
    Whole(Vec<[i8; 2]>),
    /// Near a circle: turns of 1/256 and deviations.
    Near {
        centre: [i16; 2],
        radius: u16,
        deviations: Vec<(u8, i8)>,
    },
}

impl Points {
    fn list(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Any(points) => points.clone(),
            Self::Whole(points) => points.iter().map(|p| p.map(f64::from)).collect(),
            Self::Near { centre, radius, deviations } => {
                let [x, y] = centre.map(f64::from);
                let point = |(turn, deviation): &(u8, i8)| {
                    let (s, c) = (f64::from(*turn) * std::f64::consts::TAU / 256.0).sin_cos();
                    let r = f64::from(*radius) + 1e-3 * f64::from(*deviation);
                    [x + r * c, y + r * s]
                };
                deviations.iter().map(point).collect()
            }
        }
    }
}

fuzz_target!(|points: Points| {
    let mut list = points.list();
    list.truncate(100);
    check::<f32>(&list);
    check::<f64>(&list);
});

fn check<T: Real>(points: &[[f64; 2]]) {
    let points: Vec<[T; 2]> = points.iter().map(|p| p.map(T::of)).collect();
    let (fit, zone) = repeated(|| (least_squares(&points), minimum_zone(&points)));
    finite(&fit.ok());
    finite(&zone.ok());
    if let (Ok(fit), Ok(zone)) = (fit, zone) {
        let size = points.iter().flatten().fold(zone.outer, |size, x| size.max(x.abs()));
        assert!(zone.width() <= fit.roundness() + T::of(1e3) * T::epsilon() * size, "{zone:?} {fit:?}");
    }
}
