//! Numbers for symbols: what a polynomial is at a value of its sweep.

use super::{Alphabet, Nominal, NominalId, Poly};

/// Value of a polynomial along a path: the sweep's value in rad, the constants in mm.
pub fn at(poly: &Poly, alphabet: &Alphabet, sweep: f64, constant: impl Fn(&str) -> f64) -> f64 {
    poly.evaluate(|id| nominal_value(id, alphabet, sweep, &constant), |_| 0.0)
}

/// Value of a nominal symbol along a path.
pub fn nominal_value(id: NominalId, alphabet: &Alphabet, sweep: f64, constant: impl Fn(&str) -> f64) -> f64 {
    match alphabet.nominal(id) {
        Nominal::Pi => core::f64::consts::PI,
        Nominal::Root2 => core::f64::consts::SQRT_2,
        Nominal::Constant(name) => constant(name),
        Nominal::Sweep(_) => sweep,
        Nominal::Sin(_) => sweep.sin(),
        Nominal::Cos(_) => sweep.cos(),
    }
}
