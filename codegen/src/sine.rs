// `trunnion-solver`, which this crate does not know, is built with this text too.

/// Beyond this, rad, the reduction below would lose digits: the product of a count of quarter turns and 33 bits is exact.
pub const NEAR: f64 = 1e6;
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

/// Sine and cosine of an angle in rad, within one of the last place; of an angle that is not near, no numbers. Without a branch: a
/// loop of it becomes vector instructions.
#[inline(always)]
pub fn near_sine_cosine(a: f64) -> (f64, f64) {
    // The sum's last bits are the nearest count of quarter turns.
    let shifted = a * core::f64::consts::FRAC_2_PI + WHOLE;
    let quarters = shifted - WHOLE;
    let r = ((a - quarters * HALF_PI[0]) - quarters * HALF_PI[1]) - quarters * HALF_PI[2];
    let r = if a.abs() <= NEAR { r } else { f64::NAN };
    let z = r * r;
    // Two halves of each polynomial at once.
    let (w, half) = (z * z, 0.5 * z);
    let s = S[0] + z * ((S[1] + z * (S[2] + z * S[3])) + (z * w) * (S[4] + z * S[5]));
    let c = (C[0] + z * (C[1] + z * C[2])) + (z * w) * (C[3] + z * (C[4] + z * C[5]));
    let most = 1.0 - half;
    let (s, c) = (r + (r * z) * s, most + (((1.0 - most) - half) + w * c));
    let (s, c) = (s.to_bits(), c.to_bits());
    // An odd count exchanges them, and the count's second bit is the sign.
    let count = shifted.to_bits();
    let odd = 0_u64.wrapping_sub(count & 1);
    let pick = |even: u64, other: u64| (even & !odd) | (other & odd);
    let sin = f64::from_bits(pick(s, c) ^ (count & 2) << 62);
    let cos = f64::from_bits(pick(c, s) ^ (count.wrapping_add(1) & 2) << 62);
    (sin, cos)
}
