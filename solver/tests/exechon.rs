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
        let phi = machine.dependent_rotation(&found).unwrap();
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
        machine.dependent_rotation(&machine.inverse(&target, &machine.home().start()).unwrap()).unwrap()
    };
    let between = phi([-0.625, 200.914, -168.0]) - phi([-319.135, 198.236, -168.0]);
    println!("{:.4}°", between.to_degrees());
    assert!((between.to_degrees() - -16.32).abs() < 0.005);
}

/// A pose of the workspace: a platform place and axis angles whose struts are within their strokes.
fn workspace() -> impl Strategy<Value = Joints<f64>> {
    let strut = || 950.0..1650.0;
    let angles = (-88f64.to_radians()..-2f64.to_radians(), -3.1..3.1);
    (strut(), strut(), strut(), angles).prop_map(|(l1, l2, l3, (a, c))| Joints { struts: [l1, l2, l3], a, c })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, failure_persistence: None, max_global_rejects: 200_000, ..ProptestConfig::default() })]

    #[test]
    fn forward_and_inverse_undo_each_other(joints in workspace()) {
        let machine = machine();
        let start = machine.home().start();
        let pose = machine.forward(&joints, &start);
        let pose = pose.map_err(|e| TestCaseError::fail(format!("{e}")))?;
        let target = Target::new(pose.point, *pose.direction()).unwrap();
        let near = machine.inverse(&target, &pose.start()).unwrap();
        prop_assert!(distance(&near.joints.struts, &joints.struts) < 1e-9);
        prop_assert!(turn(near.joints.a, joints.a) < 1e-11 && turn(near.joints.c, joints.c) < 1e-11);
        let cold = machine.inverse(&target, &start);
        prop_assert!(cold.is_ok(), "{}", cold.unwrap_err());
        let cold = cold.unwrap();
        prop_assert!(distance(&cold.joints.struts, &joints.struts) < 1e-9, "another solution: {:?} {joints:?}", cold.joints);
        let again = machine.forward(&cold.joints, &start).unwrap();
        prop_assert!(distance(&again.point, target.point()) < 1e-9);
    }
}
