//! Arithmetic on blocks of numbers.

use std::f64::consts::FRAC_2_PI;

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

/// Beyond this, rad, the reduction below would lose digits: the product of a count of quarter turns and 33 bits is exact.
const NEAR: f64 = 1e6;
/// Adding it leaves no room for a fraction: 1.5·2⁵².
const WHOLE: f64 = 6_755_399_441_055_744.0;
/// π/2 in three parts, the first two of 33 bits (fdlibm).
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// `sin r = r + r³ S(r²)` on an eighth of a turn either way (fdlibm).
const S: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// `cos r = 1 − r²/2 + r⁴ C(r²)`.
const C: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sines and cosines of angles in rad, within one of the last place.
#[inline(always)]
pub(crate) fn sine_cosine(a: &Lanes, sin: &mut Lanes, cos: &mut Lanes) {
    let near = a.iter().fold(true, |near, a| near & (a.abs() <= NEAR));
    if !near {
        for (a, (sin, cos)) in a.iter().zip(sin.iter_mut().zip(cos)) {
            (*sin, *cos) = a.sin_cos();
        }
        return;
    }
    for (&a, (sin, cos)) in a.iter().zip(sin.iter_mut().zip(cos)) {
        // The sum's last bits are the nearest count of quarter turns.
        let shifted = a * FRAC_2_PI + WHOLE;
        let quarters = shifted - WHOLE;
        let r = ((a - quarters * HALF_PI[0]) - quarters * HALF_PI[1]) - quarters * HALF_PI[2];
        let z = r * r;
        let s = S[0] + z * (S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5]))));
        let c = C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5]))));
        let half = 0.5 * z;
        let most = 1.0 - half;
        let (s, c) = (r + r * z * s, most + (((1.0 - most) - half) + z * z * c));
        let (s, c) = (s.to_bits(), c.to_bits());
        // An odd count exchanges them, and the count's second bit is the sign.
        let count = shifted.to_bits();
        let odd = 0_u64.wrapping_sub(count & 1);
        let pick = |even: u64, other: u64| (even & !odd) | (other & odd);
        *sin = f64::from_bits(pick(s, c) ^ (count & 2) << 62);
        *cos = f64::from_bits(pick(c, s) ^ (count.wrapping_add(1) & 2) << 62);
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
