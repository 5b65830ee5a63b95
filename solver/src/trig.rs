//! Sine and cosine of `f32` in `f32`, and of many `f64`.
//!
//! `libm` works out a sine of `f32` in `f64`, which a processor with single-precision hardware emulates: some 2,000
//! instructions on a Cortex-M4F, more than all the rest of a sample. The one here stays in `f32` and takes about fifty.

/// Of `f64`, from the generator.
pub(crate) mod double {
    include!(concat!(env!("OUT_DIR"), "/sine.rs"));
}

/// Beyond this, rad, the reduction below would lose digits.
const NEAR: f32 = 256.0;

/// π/2 in three parts. The first two have eleven bits: their products with a count of quarter turns are exact.
const HALF_PI: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// `sin r = r + r³ S(r²)` on an eighth of a turn either way: minimax, 2⁻²⁸ of the sine.
const S: [f32; 3] = [-0.166_666_55, 0.008_332_158, -0.000_195_149_57];
/// `cos r = 1 − r²/2 + r⁴ C(r²)`: 2⁻³³ of the cosine.
const C: [f32; 3] = [0.041_666_646, -0.001_388_731_3, 2.443_278_4e-5];

/// Sine and cosine of `a` in rad, within 0.9 of their own last place or, where they vanish, 10⁻¹².
pub(crate) fn sin_cos(a: f32) -> (f32, f32) {
    if a.is_nan() || a.abs() > NEAR {
        return num_traits::Float::sin_cos(a);
    }
    // Adding 1.5·2²³ leaves no room for a fraction: the sum's last bits are the nearest count of quarter turns.
    const WHOLE: f32 = 12_582_912.0;
    let shifted = a * core::f32::consts::FRAC_2_PI + WHOLE;
    let quarters = shifted - WHOLE;
    let near = (a - quarters * HALF_PI[0]) - quarters * HALF_PI[1];
    let last = quarters * HALF_PI[2];
    let r = near - last;
    let low = (near - r) - last;

    let z = r * r;
    let sin = r + (low + r * z * (S[0] + z * (S[1] + z * S[2])));
    let half = 0.5 * z;
    let most = 1.0 - half;
    let cos = most + (((1.0 - most) - half) + (z * z * (C[0] + z * (C[1] + z * C[2])) - r * low));
    match shifted.to_bits() & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error in units of the value's last place, after 10⁻¹² are forgiven.
    fn error(value: f32, exact: f64) -> f64 {
        let nearest = exact.abs() as f32;
        let unit = f64::from(f32::from_bits(nearest.to_bits() + 1)) - f64::from(nearest);
        ((f64::from(value) - exact).abs() - 1e-12).max(0.0) / unit
    }

    #[test]
    fn sine_and_cosine_are_right_to_the_last_place() {
        let mut worst = 0.0_f64;
        let mut check = |a: f32| {
            let (s, c) = sin_cos(a);
            let (sin, cos) = num_traits::Float::sin_cos(f64::from(a));
            worst = worst.max(error(s, sin)).max(error(c, cos));
        };
        // A step that is no multiple of anything, from the smallest to the largest angle; then around the quarter turns.
        for bits in (0..(NEAR + 1.0).to_bits()).step_by(1009) {
            check(f32::from_bits(bits));
            check(-f32::from_bits(bits));
        }
        for quarter in -160..=160 {
            let a = (f64::from(quarter) * core::f64::consts::FRAC_PI_2) as f32;
            (0..64).for_each(|ulp| check(f32::from_bits(a.to_bits().wrapping_sub(32).wrapping_add(ulp))));
        }
        assert!(worst < 0.9, "{worst}");
    }

    #[test]
    fn far_and_impossible_angles_are_answered() {
        let far = 12_345.678_f32;
        assert!((f64::from(sin_cos(far).0) - num_traits::Float::sin(f64::from(far))).abs() < 1e-7);
        for a in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let (s, c) = sin_cos(a);
            assert!(s.is_nan() && c.is_nan());
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }
}
