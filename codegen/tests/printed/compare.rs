//! Points to compare at, and when two values agree.

/// Repeatable points, uniform in each input's range, by a linear congruential generator (Knuth, MMIX).
pub fn points(ranges: &[(f64, f64)], count: usize) -> Vec<Vec<f64>> {
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut point = || ranges.iter().map(|(low, high)| low + (high - low) * uniform()).collect();
    (0..count).map(|_| point()).collect()
}

pub const TILTING: [(f64, f64); 2] = [(50.0, 300.0), (-7.0, 7.0)];
pub const STRUT: [(f64, f64); 5] = [(0.3, 0.9), (0.2, 0.8), (0.4, 1.2), (0.1, 0.5), (0.0, 1.0)];

/// `scale` is the size of what is added up to give the value: cancellation is the expression's, not the printer's.
pub fn assert_close(actual: f64, expected: f64, scale: f64, epsilon: f64, what: &str) {
    let ulps = (actual - expected).abs() / (expected.abs().max(scale) * epsilon);
    assert!(ulps <= 4.0, "{what}: {actual:e} instead of {expected:e}, {ulps} units of the last place");
}

/// The size of the terms that cancel in output `index` of the tilting row at `point`: those of the quartics, the turns that are
/// taken off, and the angle of the high harmonic.
pub fn tilting_scale(index: usize, point: &[f64]) -> f64 {
    let (pi, a) = (std::f64::consts::PI, point[1].abs());
    match index {
        8 => point[0] * (a.powi(4) + 2.0 * pi * a.powi(3) + 2.0 * pi * pi * a * a + 4.0 * pi.powi(3) * a),
        9 => point[0] * (a.powi(3) + 3.0 * pi * a * a + 2.0 * pi * pi * a),
        10 => a + 2.0 * pi,
        11 => 3.0 * a + 2.0 * pi,
        12 => 64.0 * a,
        _ => 0.0,
    }
}

/// The strut's outputs are differences of values of order one.
pub const STRUT_SCALE: f64 = 1.0;
