//! The parallel machine against independent poses, against its joints, and there and back.

use proptest::prelude::*;
use serde_json::Value;
use std::fs;
use trunnion_solver::exechon::*;

fn dimensions() -> Dimensions<f64> {
    Dimensions { xu: 450.0, ys2: 450.0, xr: 150.0, yr5: 150.0, ycp: 25.0, zc: 375.0, yt: -30.0, tz: 380.0 }
}

fn limits() -> Limits<f64> {
    let degrees = |low: f64, high: f64| Range { low: low.to_radians(), high: high.to_radians() };
    Limits { struts: Range { low: 950.0, high: 1650.0 }, a: degrees(-90.0, 90.0), c: degrees(-270.0, 270.0) }
}

fn home() -> Home<f64> {
    Home { strut: 1438.0, a: -45f64.to_radians() }
}

fn machine() -> Machine<f64> {
    Machine::new(dimensions(), home(), limits()).unwrap()
}

fn vector(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|k| value[k].as_f64().unwrap())
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The smallest difference between two angles: −0 and 2π are both none.
fn turn(a: f64, b: f64) -> f64 {
    (a - b).sin().atan2((a - b).cos()).abs()
}

fn reference() -> Value {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference/exechon-poses.json");
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

#[test]
fn the_twelve_reference_poses_agree() {
    let (machine, reference) = (machine(), reference());
    let mut worst = [0f64; 4];
    for pose in reference["poses"].as_array().unwrap() {
        let target = Target::new(vector(&pose["pt"]), vector(&pose["t"])).unwrap();
        let found = machine.inverse(&target, &machine.home().start()).unwrap();
        let phi = machine.dependent_rotation(&found, Tilted::Projected).unwrap();
        let columns = |k: usize| [0, 1, 2].map(|row| pose["R_MP"][row][k].as_f64().unwrap());
        let axes = (0..3).map(|k| distance(&found.axes[k], &columns(k))).fold(0.0, f64::max);
        let lengths = distance(&found.joints.struts, &vector(&pose["l"]));
        let angles = [("A", found.joints.a), ("C", found.joints.c), ("phi_DRM_eq7", phi)];
        let angles = angles.iter().map(|(name, value)| turn(*value, pose[name].as_f64().unwrap())).fold(0.0, f64::max);
        let now = [distance(&found.platform, &vector(&pose["pMP"])), lengths, angles, axes];
        worst.iter_mut().zip(now).for_each(|(worst, now)| *worst = worst.max(now));
        println!("{} {now:?} in {} steps", pose["tag"], found.iterations);
    }
    let [platform, lengths, angles, axes] = worst;
    println!("worst: platform {platform:e} mm, struts {lengths:e} mm, angles {angles:e} rad, axes {axes:e}");
    assert!(platform < 1e-9 && lengths < 1e-9 && angles < 1e-12 && axes < 1e-12);
}

#[test]
fn machine_coordinates_are_the_tool_s_at_home() {
    let (machine, reference) = (machine(), reference());
    let frame = machine.frame();
    let home = &reference["home"];
    assert!(distance(&frame.point_to_base([0.0; 3]), &vector(&home["pt"])) < 1e-9);
    for (axis, unit) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
        let column = [0, 1, 2].map(|row| home["RT"][row][axis].as_f64().unwrap());
        assert!(distance(&frame.direction_to_base(unit), &column) < 1e-15);
    }
    // The paper gives the rings in machine coordinates, the reference in base coordinates.
    for (tag, ring) in [("ring1", [-0.625, 200.914, -168.0]), ("ring2", [-319.135, 198.236, -168.0])] {
        let pose = reference["poses"].as_array().unwrap().iter().find(|pose| pose["tag"] == tag).unwrap();
        assert!(distance(&frame.point_to_base(ring), &vector(&pose["pt"])) < 1e-9);
        assert!(distance(&frame.point_from_base(vector(&pose["pt"])), &ring) < 1e-9);
    }
}

#[test]
fn the_paper_s_rings_are_turned_by_16_32_degrees() {
    let machine = machine();
    let phi = |ring| {
        let target = Target::new(machine.frame().point_to_base(ring), *machine.home().direction()).unwrap();
        let pose = machine.inverse(&target, &machine.home().start()).unwrap();
        let both =
            [Tilted::Projected, Tilted::Carried].map(|tilted| machine.dependent_rotation(&pose, tilted).unwrap());
        assert!((both[0] - both[1]).abs() < 1e-14);
        both[0]
    };
    let between = phi([-0.625, 200.914, -168.0]) - phi([-319.135, 198.236, -168.0]);
    println!("{:.4}°", between.to_degrees());
    assert!((between.to_degrees() - -16.32).abs() < 0.005);
}

#[test]
fn a_carried_rotation_restores_the_carried_orientation() {
    use nalgebra::{Rotation3, Vector3};
    let machine = machine();
    let home = machine.home();
    for (tag, pose) in [("tilt10_az30", 7), ("tilt20_az225", 10)] {
        let pose = &reference()["poses"][pose];
        assert_eq!(pose["tag"], tag);
        let target = Target::new(vector(&pose["pt"]), vector(&pose["t"])).unwrap();
        let found = machine.inverse(&target, &home.start()).unwrap();
        let phi = machine.dependent_rotation(&found, Tilted::Carried).unwrap();
        let [x_a, y_a, t] = found.spindle.map(Vector3::from);
        let turned = x_a * phi.cos() + y_a * phi.sin();
        let carry = Rotation3::rotation_between(&Vector3::from(*home.direction()), &t).unwrap();
        assert!((turned - carry * Vector3::from(home.spindle[0])).norm() < 1e-14);
        assert!((phi - machine.dependent_rotation(&found, Tilted::Projected).unwrap()).abs() > 1e-3);
    }
}

/// A pose of the workspace: the platform where the struts are within their strokes, the axes anywhere but at A = 0.
fn workspace() -> impl Strategy<Value = (Joints<f64>, [f64; 3])> {
    let place = (-700.0..700.0, -700.0..700.0, 700.0..1650.0);
    (place, -88.0..-2.0, -179.0..179.0).prop_filter_map("beyond the strokes", |((x, y, z), a, c): (_, f64, f64)| {
        let d = dimensions();
        let (struts, _) = equations::struts(d.xu, d.ys2, d.xr, d.yr5, x, y, z);
        let inside = struts.iter().all(|l| (950.001..1649.999).contains(l));
        inside.then_some((Joints { struts, a: a.to_radians(), c: c.to_radians() }, [x, y, z]))
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 10_000,
        failure_persistence: None,
        max_local_rejects: 1_000_000,
        ..ProptestConfig::default()
    })]

    #[test]
    fn forward_and_inverse_undo_each_other((joints, platform) in workspace()) {
        let machine = machine();
        let start = machine.home().start();
        let found = |result: Result<Pose<f64>, KinematicsError<f64>>| result.map_err(|e| TestCaseError::fail(e.to_string()));
        let pose = found(machine.forward(&joints, &start))?;
        prop_assert!(distance(&pose.platform, &platform) < 1e-9, "another place: {:?}", pose.platform);
        let target = Target::new(pose.point, *pose.direction()).unwrap();
        for from in [start, pose.start()] {
            let back = found(machine.inverse(&target, &from))?;
            prop_assert!(distance(&back.joints.struts, &joints.struts) < 1e-9, "another solution: {:?}", back.joints);
            prop_assert!(turn(back.joints.a, joints.a) < 1e-11 && turn(back.joints.c, joints.c) < 1e-11);
            prop_assert!(back.iterations <= 8, "{} steps", back.iterations);
            let again = found(machine.forward(&back.joints, &start))?;
            prop_assert!(distance(&again.point, target.point()) < 1e-9);
        }
    }
}

/// Poses of small A, to both sides and down to a hundredth of a degree: the pose that is found has the tool where it was.
#[test]
fn poses_beside_the_c_axis_are_found() {
    let machine = machine();
    let start = machine.home().start();
    let other = Start { branch: start.branch.other(), ..start };
    for tilt in [0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0] {
        for k in 0..120 {
            let k = f64::from(k);
            let struts = [1250.0 + 2.0 * k, 1300.0 - 0.7 * k, 1250.0 + (37.0 * k) % 170.0];
            let sign = if (k as u32).is_multiple_of(2) { 1.0 } else { -1.0 };
            let joints = Joints { struts, a: sign * f64::to_radians(tilt), c: 0.37 * k % 9.0 - 4.5 };
            let pose = machine.forward(&joints, &start).unwrap();
            let target = Target::new(pose.point, *pose.direction()).unwrap();
            let found = machine.inverse(&target, if sign > 0.0 { &other } else { &start });
            let found = found.unwrap_or_else(|error| panic!("A = {}°, {joints:?}: {error}", sign * tilt));
            let again = machine.forward(&found.joints, &found.start()).unwrap();
            assert!(distance(&again.point, &pose.point) < 1e-8, "A = {}°: {:?}", sign * tilt, again.point);
            assert!(distance(again.direction(), pose.direction()) < 1e-10, "A = {}°", sign * tilt);
        }
    }
}
