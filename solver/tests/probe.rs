//! Offsets from touches that are made from them.

use trunnion_solver::probe::*;

const OFFSET: [f64; 2] = [0.21, 0.16];
const RADIUS: f64 = 17.0005;
const HALF_TURN: f64 = std::f64::consts::PI;

/// The spindle axis touching in direction `angle` (of the ball from the ring's centre).
fn touch(angle: f64, turned: f64, centre: [f64; 2]) -> Touch<f64> {
    let on_ring = [centre[0] + RADIUS * angle.cos(), centre[1] + RADIUS * angle.sin()];
    Touch { position: ball(on_ring, turned, OFFSET.map(|o| -o)), turned }
}

/// The paper's procedure: the ball centred at p1, reversed, moved along x, and along y.
fn reversal([ox, oy]: [f64; 2]) -> Reversal<f64> {
    let centre = [-0.625 - ox, 200.914 - oy];
    let along = |across: f64| (RADIUS * RADIUS - 4.0 * across * across).sqrt();
    let x = [centre[0] + 2.0 * ox + along(oy), centre[1]];
    Reversal { centre, x, y: [centre[0], centre[1] + 2.0 * oy + along(ox)], radius: RADIUS }
}

#[test]
fn the_reversal_gives_the_offset_exactly() {
    for offset in [OFFSET, [0.0, 0.0], [-0.3, 1.2], [2.0, -1.0]] {
        let found = reversal(offset).exact().unwrap();
        assert!((found[0] - offset[0]).abs() < 1e-13 && (found[1] - offset[1]).abs() < 1e-13, "{found:?}");
        let near = reversal(offset).small_angle();
        // E(9) drops o⊥²/ρ.
        for (near, (own, across)) in near.iter().zip([(offset[0], offset[1]), (offset[1], offset[0])]) {
            let dropped = own - near;
            assert!((dropped - across * across / RADIUS).abs() < 0.02 * across * across / RADIUS + 1e-13, "{dropped}");
        }
    }
    // Touches beside the lines through p1 are as good.
    let at = reversal(OFFSET);
    let turned = |angle: f64| {
        let ball = [at.centre[0] + 2.0 * OFFSET[0], at.centre[1] + 2.0 * OFFSET[1]];
        [ball[0] + RADIUS * angle.cos(), ball[1] + RADIUS * angle.sin()]
    };
    let found = Reversal { x: turned(0.1), y: turned(1.7), ..at }.exact().unwrap();
    assert!((found[0] - OFFSET[0]).abs() < 1e-13 && (found[1] - OFFSET[1]).abs() < 1e-13, "{found:?}");
    let dropped = OFFSET[0] - reversal(OFFSET).small_angle()[0];
    assert!((1.4e-3..2.7e-3).contains(&dropped), "the corrections name 1.5 to 2.6 µm: {dropped}");
}

#[test]
fn the_reversal_s_covariance_is_that_of_its_derivatives() {
    let at = reversal(OFFSET);
    let (touch, radius) = (0.125e-3, 0.5e-3);
    let changed = |change: &dyn Fn(&mut Reversal<f64>, f64)| {
        let [up, down] = [1e-5, -1e-5].map(|h| {
            let mut moved = at;
            change(&mut moved, h);
            moved.exact().unwrap()
        });
        [up[0] - down[0], up[1] - down[1]].map(|difference| difference / 2e-5)
    };
    let parts = [
        (changed(&|r, h| r.x[0] += h), 1.5 * touch * touch),
        (changed(&|r, h| r.y[1] += h), 1.5 * touch * touch),
        (changed(&|r, h| r.radius += h), radius * radius),
    ];
    let covariance = at.covariance(touch, radius).unwrap();
    for i in 0..2 {
        for j in 0..2 {
            let expected: f64 = parts.iter().map(|(g, variance)| g[i] * g[j] * variance).sum();
            assert!((covariance[i][j] - expected).abs() < 1e-5 * covariance[i][i]);
        }
    }
}

#[test]
fn any_touches_give_offset_centre_and_radius() {
    let centre = [-319.135, 198.236];
    // Turned by anything, in any direction; the smallest number among them.
    for n in [5, 6, 8, 36] {
        let touches: Vec<_> =
            (0..n).map(|k| touch(f64::from(k) * 2.4, [0.0, HALF_TURN, 0.3][k as usize % 3], centre)).collect();
        let fit = offset(&touches, 0.125e-3).unwrap();
        let off = [fit.offset[0] - 0.21, fit.offset[1] - 0.16, fit.centre[0] - centre[0], fit.radius - RADIUS];
        assert!(off.iter().all(|v| v.abs() < 1e-11), "{n}: {off:?}");
        assert!(fit.covariance[(0, 0)] > 0.0);
        // As many touches as unknowns leave no residuals.
        assert_eq!(fit.residual_std.is_none(), n == 5);
        assert!(fit.residual_std.is_none_or(|std| std < 1e-11));
    }
}

#[test]
fn four_touches_each_way_have_half_a_touch_s_uncertainty() {
    let quarter = |k: i32| f64::from(k) * HALF_TURN / 2.0;
    let touches: Vec<_> = (0..8).map(|k| touch(quarter(k), if k < 4 { 0.0 } else { HALF_TURN }, [0.0; 2])).collect();
    let fit = offset(&touches, 0.125e-3).unwrap();
    // ox = (mean of 2 − mean of 2)/2: σ/2.
    assert!((fit.covariance[(0, 0)].sqrt() - 0.0625e-3).abs() < 1e-9);
}

#[test]
fn touches_without_an_offset_to_find() {
    let plain: Vec<_> = (0..8).map(|k| touch(f64::from(k), 0.0, [0.0; 2])).collect();
    assert_eq!(offset(&plain, 1e-4).unwrap_err(), ProbeError::NotSeparated);
    assert_eq!(offset(&plain[..3], 1e-4).unwrap_err(), ProbeError::TooFewTouches { touches: 3, needed: 5 });
    assert_eq!(offset::<f64>(&[], 1e-4).unwrap_err(), ProbeError::TooFewTouches { touches: 0, needed: 5 });
    let nan = Touch { position: [f64::NAN, 0.0], turned: 0.0 };
    assert_eq!(offset(&[nan; 6], 1e-4).unwrap_err(), ProbeError::NotFinite);
    let at = reversal(OFFSET);
    assert_eq!(Reversal { radius: 0.0, ..at }.exact(), Err(ProbeError::Radius));
    assert_eq!(Reversal { x: [f64::NAN, 0.0], ..at }.exact(), Err(ProbeError::NotFinite));
    assert_eq!(Reversal { x: [500.0, 0.0], ..at }.exact(), Err(ProbeError::BeyondRing));
}

/// Found by fuzzing: the squares of these overflow.
#[test]
fn lengths_beyond_numbers_are_refused() {
    let far = Reversal { radius: 1e200, ..reversal(OFFSET) };
    assert_eq!(far.exact(), Err(ProbeError::NotFinite));
    let touches: Vec<_> = (0..8).map(|k| touch(f64::from(k), f64::from(k % 2) * HALF_TURN, [0.0; 2])).collect();
    assert!(offset(&touches, 1e-3).is_ok());
    assert_eq!(offset(&touches, 1e200), Err(ProbeError::NotFinite));
}
