//! Numbers for symbols: what a polynomial is at a value of its sweep.

use super::{Alphabet, Harmonic, Harmonics, Nominal, NominalId, Poly, Terms, to_f64};

/// Value of a polynomial along a path: the sweep's value in rad, the constants in mm.
pub fn at(poly: &Poly, alphabet: &Alphabet, sweep: f64, constant: impl Fn(&str) -> f64) -> f64 {
    value(poly, alphabet, sweep, &constant)
}

fn value(poly: &Poly, alphabet: &Alphabet, sweep: f64, constant: &dyn Fn(&str) -> f64) -> f64 {
    let Some(harmonics) = Harmonics::of(poly, alphabet) else {
        return poly.evaluate(|id| nominal_value(id, alphabet, sweep, constant), |_| 0.0);
    };
    let product =
        |(harmonic, factor): &(Harmonic, Poly)| harmonic.value(sweep) * value(factor, alphabet, sweep, constant);
    harmonics.terms.iter().map(product).sum()
}

/// Value of a nominal symbol along a path on which the sweep increases.
pub fn nominal_value(id: NominalId, alphabet: &Alphabet, sweep: f64, constant: &dyn Fn(&str) -> f64) -> f64 {
    let power = |id| nominal_value(id, alphabet, sweep, constant);
    let of_terms = |terms: &Terms| terms.iter().map(|(m, c)| to_f64(c) * m.evaluate(power)).sum::<f64>();
    match alphabet.nominal(id) {
        Nominal::Pi => core::f64::consts::PI,
        Nominal::Root2 => core::f64::consts::SQRT_2,
        Nominal::Constant(name) => constant(name),
        Nominal::Sweep(_) => sweep,
        Nominal::Sin(_) => sweep.sin(),
        Nominal::Cos(_) => sweep.cos(),
        Nominal::Wrapped { angle, .. } => wrapped_value(f64::from(angle.multiple) * sweep, angle.start),
        Nominal::Root { root, .. } => of_terms(&root.of).sqrt(),
        Nominal::Arctangent { angle, .. } => of_terms(&angle.sin).atan2(of_terms(&angle.cos)),
        Nominal::Sense { sense, .. } => sign(of_terms(&sense.of)),
    }
}

/// 1 or −1; 0 of a velocity that is none but for the rounding of an angle in single precision, as at a reversal.
fn sign(velocity: f64) -> f64 {
    if velocity.abs() < 1.0 / 1_048_576.0 { 0.0 } else { velocity.signum() }
}

/// An angle less whole turns, in `start · π/12` and a turn from there, rad.
pub fn wrapped_value(angle: f64, start: i32) -> f64 {
    let start = f64::from(start) * core::f64::consts::PI / 12.0;
    angle - core::f64::consts::TAU * whole_turns((angle - start) / core::f64::consts::TAU)
}

/// The largest whole number not above `turns`; NaN from 2²⁶ turns on, where half the digits of what is left over are lost.
pub fn whole_turns(turns: f64) -> f64 {
    if turns.abs() < f64::from(1 << 26) { turns.floor() } else { f64::NAN }
}
