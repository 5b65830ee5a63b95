//! The closed form E(4) against the joints themselves, without using it.
//!
//! Each strut is a chain of its own: a gimbal with two angles at the base, the strut's length, revolute joints at the
//! platform. Where the chains of the three struts meet in one rigid platform, the machine is closed; that is solved here by
//! Newton with difference quotients over all joint angles, knowing nothing of E(4).

use nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Vector3};
use trunnion_solver::exechon::{Dimensions, Home, Joints, Limits, Machine};

/// Joint angles: outer and inner gimbal and platform hinge of struts 1 and 3; outer and inner gimbal, turn about the
/// strut, and hinge of strut 2.
type Angles = SVector<f64, 10>;

struct Chain {
    end: Vector3<f64>,
    platform: Matrix3<f64>,
}

fn x(angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::x_axis(), angle)
}

fn y(angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::y_axis(), angle)
}

fn z(angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), angle)
}

/// Outer gimbal about the common x axis, inner about y, the strut along z, hinge about y (R4, R6 have axes along the
/// platform's y).
fn outer_strut(base: Vector3<f64>, arm: Vector3<f64>, length: f64, angles: [f64; 3]) -> Chain {
    let along = x(angles[0]) * y(angles[1]);
    let platform = along * y(angles[2]);
    Chain { end: base + along * Vector3::new(0.0, 0.0, length) - platform * arm, platform: platform.into_inner() }
}

/// The same with a turn about the strut and the hinge about x (R5 has its axis along the platform's x).
fn middle_strut(base: Vector3<f64>, arm: Vector3<f64>, length: f64, angles: [f64; 4]) -> Chain {
    let along = x(angles[0]) * y(angles[1]) * z(angles[2]);
    let platform = along * x(angles[3]);
    Chain { end: base + along * Vector3::new(0.0, 0.0, length) - platform * arm, platform: platform.into_inner() }
}

fn dimensions() -> Dimensions<f64> {
    Dimensions { xu: 450.0, ys2: 450.0, xr: 150.0, yr5: 150.0, ycp: 25.0, zc: 375.0, yt: -30.0, tz: 380.0 }
}

fn chains(struts: [f64; 3], q: &Angles) -> [Chain; 3] {
    let d = dimensions();
    let on_x = |value| Vector3::new(value, 0.0, 0.0);
    let on_y = |value| Vector3::new(0.0, value, 0.0);
    [
        outer_strut(on_x(-d.xu), on_x(-d.xr), struts[0], [q[0], q[1], q[2]]),
        outer_strut(on_x(d.xu), on_x(d.xr), struts[2], [q[3], q[4], q[5]]),
        middle_strut(on_y(d.ys2), on_y(d.yr5), struts[1], [q[6], q[7], q[8], q[9]]),
    ]
}

/// How far the chains are from one platform: 6 numbers for places, 18 for orientations (in mm, over an arm of 1 m).
fn gap(struts: [f64; 3], q: &Angles) -> SVector<f64, 24> {
    let [first, third, second] = chains(struts, q);
    let mut gap = SVector::<f64, 24>::zeros();
    for (at, other) in [third, second].iter().enumerate() {
        gap.fixed_rows_mut::<3>(12 * at).copy_from(&(other.end - first.end));
        let turned = (other.platform - first.platform) * 1000.0;
        gap.fixed_rows_mut::<9>(12 * at + 3).copy_from_slice(turned.as_slice());
    }
    gap
}

fn close(struts: [f64; 3]) -> (Chain, f64) {
    // As at home, where the struts lean inwards by the same angle.
    let lean = (300.0 / 1438.0f64).asin();
    let mut q = Angles::from([0.0, lean, -lean, 0.0, -lean, lean, lean, 0.0, 0.0, -lean]);
    for _ in 0..30 {
        let now = gap(struts, &q);
        let mut jacobian = SMatrix::<f64, 24, 10>::zeros();
        for k in 0..10 {
            let (mut up, mut down) = (q, q);
            up[k] += 1e-5;
            down[k] -= 1e-5;
            jacobian.set_column(k, &((gap(struts, &up) - gap(struts, &down)) / 2e-5));
        }
        let (square, right) = (jacobian.transpose() * jacobian, jacobian.transpose() * now);
        q -= square.lu().solve(&right).expect("a regular pose");
    }
    let [first, ..] = chains(struts, &q);
    (first, gap(struts, &q).amax())
}

#[test]
fn the_loops_of_the_struts_close_where_the_closed_form_says() {
    let home = Home { strut: 1438.0, a: -45f64.to_radians() };
    let machine = Machine::new(dimensions(), home, Limits::none()).unwrap();
    let (mut worst, mut closed) = ([0f64; 2], 0);
    for l1 in [1150.0, 1290.0, 1438.0, 1560.0] {
        for l2 in [1180.0, 1360.0, 1500.0] {
            for l3 in [1120.0, 1300.0, 1438.0, 1580.0] {
                let joints = Joints { struts: [l1, l2, l3], a: -0.7, c: 0.2 };
                let pose = machine.forward(&joints, &machine.home().start()).unwrap();
                let (chain, gap) = close(joints.struts);
                assert!(gap < 1e-9, "{joints:?}: the loops are open by {gap:e} mm");
                let place = (chain.end - Vector3::from(pose.platform)).amax();
                let axes = Matrix3::from_columns(&pose.axes.map(Vector3::from));
                let turned = (chain.platform - axes).amax();
                worst = [worst[0].max(place), worst[1].max(turned)];
                closed += 1;
            }
        }
    }
    println!("{closed} poses: place {:e} mm, orientation {:e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-9 && worst[1] < 1e-12);
}
