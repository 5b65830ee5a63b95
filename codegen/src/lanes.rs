//! Arithmetic on blocks of numbers.

/// Numbers in a block.
pub const LANES: usize = 64;

/// A block of numbers.
pub type Lanes = [f64; LANES];

/// The values in blocks, the last one filled up with zeros.
pub fn in_blocks(values: impl IntoIterator<Item = f64>) -> Vec<Lanes> {
    let mut blocks = Vec::new();
    for (i, value) in values.into_iter().enumerate() {
        if i % LANES == 0 {
            blocks.push([0.0; LANES]);
        }
        if let Some(block) = blocks.last_mut() {
            block[i % LANES] = value;
        }
    }
    blocks
}

/// `result = of(a)`.
#[inline(always)]
pub(crate) fn each(result: &mut Lanes, a: &Lanes, of: impl Fn(f64) -> f64) {
    for (result, &a) in result.iter_mut().zip(a) {
        *result = of(a);
    }
}

/// `result = of(a, b)`.
#[inline(always)]
pub(crate) fn both(result: &mut Lanes, a: &Lanes, b: &Lanes, of: impl Fn(f64, f64) -> f64) {
    for (result, (&a, &b)) in result.iter_mut().zip(a.iter().zip(b)) {
        *result = of(a, b);
    }
}

mod sine {
    include!("sine.rs");
}
use sine::{NEAR, near_sine_cosine};

/// Source of `near_sine_cosine`, for the solver's own build.
#[doc(hidden)]
pub const SINE: &str = include_str!("sine.rs");

/// Sines and cosines of angles in rad, within one of the last place.
#[inline(always)]
pub(crate) fn sine_cosine(a: &Lanes, sin: &mut Lanes, cos: &mut Lanes) {
    let near = a.iter().fold(true, |near, a| near & (a.abs() <= NEAR));
    let each = a.iter().zip(sin.iter_mut().zip(cos));
    if near {
        each.for_each(|(&a, (sin, cos))| (*sin, *cos) = near_sine_cosine(a));
    } else {
        each.for_each(|(&a, (sin, cos))| (*sin, *cos) = a.sin_cos());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_are_those_of_the_library() {
        let mut angles: Vec<f64> = (0..64 * 400).map(|i| (f64::from(i) - 12_800.0) * 0.037).collect();
        angles.extend((-640..640).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2));
        angles.extend([0.0, -0.0, 1e-300, 1e-9, 9.9e5, -9.9e5].into_iter().cycle().take(64));
        angles.extend([f64::NAN, f64::INFINITY, 1e7, 1e15].into_iter().cycle().take(64));
        for block in angles.as_chunks::<LANES>().0 {
            let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
            sine_cosine(block, &mut sin, &mut cos);
            for ((a, s), c) in block.iter().zip(sin).zip(cos) {
                let (exact_s, exact_c) = a.sin_cos();
                let near = |x: f64, y: f64| (x - y).abs() <= 2.3e-16 * y.abs().max(1e-4) || (x.is_nan() && y.is_nan());
                assert!(near(s, exact_s) && near(c, exact_c), "{a}: {s} {exact_s}, {c} {exact_c}");
            }
        }
    }
}
