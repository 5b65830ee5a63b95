//! What is no machine, no target and no pose is said by name.

use trunnion_solver::exechon::*;

const NAN: f64 = f64::NAN;

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

fn inverse(machine: &Machine<f64>, point: [f64; 3]) -> Result<Pose<f64>, KinematicsError<f64>> {
    let target = Target::new(machine.frame().point_to_base(point), *machine.home().direction()).unwrap();
    machine.inverse(&target, &machine.home().start())
}

#[test]
fn dimensions_that_make_no_machine() {
    let make = |change: fn(&mut Dimensions<f64>, &mut Home<f64>, &mut Limits<f64>)| {
        let (mut dimensions, mut home, mut limits) = (dimensions(), home(), limits());
        change(&mut dimensions, &mut home, &mut limits);
        Machine::new(dimensions, home, limits).unwrap_err()
    };
    assert_eq!(make(|d, _, _| d.zc = NAN), MachineError::NotFinite(Dimension::Zc));
    assert_eq!(make(|d, _, _| d.xu = 0.0), MachineError::NotPositive(Dimension::Xu));
    assert_eq!(make(|_, h, _| h.strut = 200.0), MachineError::HomeUnreachable);
    assert_eq!(make(|_, h, _| h.a = 0.0), MachineError::HomeSingular);
    assert_eq!(make(|d, _, _| d.ys2 = 1e200), MachineError::TooLarge(Dimension::Ys2));
    assert_eq!(make(|_, h, _| h.strut = 1e200), MachineError::TooLarge(Dimension::HomeStrut));
    assert_eq!(make(|_, _, l| l.c = Range { low: 1.0, high: -1.0 }), MachineError::EmptyRange(Limit::C));
    assert_eq!(make(|_, _, l| l.struts.low = NAN), MachineError::EmptyRange(Limit::Strut1));
}

#[test]
fn what_is_no_target() {
    let point = [0.0, 272.0, 2000.0];
    assert_eq!(Target::new([0.0, NAN, 0.0], [0.0, 0.0, 1.0]), Err(TargetError::NotFinite(Input::Point)));
    let infinite = Target::new(point, [f64::INFINITY, 0.0, 1.0]);
    assert_eq!(infinite, Err(TargetError::NotFinite(Input::Direction)));
    assert_eq!(Target::new(point, [0.0; 3]), Err(TargetError::ZeroDirection));
    assert_eq!(Target::new(point, [0.0, 0.0, 2.0]), Err(TargetError::NotUnit { norm: 2.0 }));
    assert!(matches!(Target::new(point, [0.0, 0.6, 0.79999]), Err(TargetError::NotUnit { .. })));
}

#[test]
fn beyond_a_limit_says_which_and_by_how_much() {
    let error = inverse(&machine(), [0.0, 0.0, 400.0]).unwrap_err();
    let KinematicsError::OutOfRange { limit: Limit::Strut1, value, bound: 1650.0 } = error else {
        panic!("{error}");
    };
    assert!(value > 1650.0);
    println!("{error}");
    assert!(error.to_string().contains("above its limit of 1650.000 mm"), "{error}");
    let joints = Joints { struts: [1300.0, 1300.0, 1300.0], a: 2.0, c: 0.0 };
    let error = machine().forward(&joints, &machine().home().start()).unwrap_err();
    assert_eq!(error, KinematicsError::OutOfRange { limit: Limit::A, value: 2.0, bound: 90f64.to_radians() });
    assert_eq!(error.to_string(), "the A axis would be at 114.592°, 24.592° above its limit of 90.000°");
}

#[test]
fn each_limit_is_held() {
    let machine = machine();
    let within = Joints { struts: [1300.0, 1310.0, 1320.0], a: -0.7, c: 0.2 };
    assert!(machine.forward(&within, &machine.home().start()).is_ok());
    type Change = fn(&mut Joints<f64>) -> &mut f64;
    let all: [(Change, Limit, f64, f64); 5] = [
        (|j| &mut j.struts[0], Limit::Strut1, 900.0, 950.0),
        (|j| &mut j.struts[1], Limit::Strut2, 1700.0, 1650.0),
        (|j| &mut j.struts[2], Limit::Strut3, 900.0, 950.0),
        (|j| &mut j.a, Limit::A, -2.0, -90f64.to_radians()),
        (|j| &mut j.c, Limit::C, 5.0, 270f64.to_radians()),
    ];
    for (change, limit, value, bound) in all {
        let mut joints = within;
        *change(&mut joints) = value;
        let error = machine.forward(&joints, &machine.home().start()).unwrap_err();
        assert_eq!(error, KinematicsError::OutOfRange { limit, value, bound });
    }
}

#[test]
fn far_outside_there_is_no_solution_in_front_of_the_base() {
    for point in [[0.0, 0.0, -9e3], [0.0, 0.0, -3e3], [5e3, 0.0, 0.0], [0.0, -1e6, 0.0], [1e300, 0.0, 0.0]] {
        let error = inverse(&machine(), point).unwrap_err();
        println!("{point:?}: {error}");
        assert!(!matches!(error, KinematicsError::NotFinite(_)));
    }
    let behind = inverse(&Machine::new(dimensions(), home(), Limits::none()).unwrap(), [0.0, 0.0, -3e3]).unwrap_err();
    assert!(matches!(behind, KinematicsError::BehindBase { .. }), "{behind}");
}

#[test]
fn a_tool_along_the_c_axis_is_singular() {
    // Without an offset of the spindle the platform is fixed by the tool alone, and C is anything.
    let central = Machine::new(Dimensions { yt: 0.0, ..dimensions() }, home(), limits()).unwrap();
    let target = Target::new([0.0, 25.0, 2000.0], [0.0, 0.0, 1.0]).unwrap();
    let found = central.inverse(&target, &central.home().start());
    assert_eq!(found, Err(KinematicsError::Singular(Singularity::ToolAlongC)));
    // With it, the poses with A = 0 are a ring around the tool, and none of the branch is near.
    let machine = machine();
    for k in 0..200 {
        let k = f64::from(k);
        let struts = [1300.0 + k, 1250.0 + 0.7 * k, 1400.0 - 0.9 * k];
        let joints = Joints { struts, a: 0.0, c: 0.031 * k - 3.0 };
        let pose = machine.forward(&joints, &machine.home().start()).unwrap();
        let target = Target::new(pose.point, *pose.direction()).unwrap();
        let found = machine.inverse(&target, &machine.home().start());
        assert_eq!(found, Err(KinematicsError::Singular(Singularity::ToolAlongC)), "{joints:?}");
    }
}

#[test]
fn a_platform_on_the_gimbals_line_is_singular() {
    let machine = machine();
    let start = Start { platform: [100.0, 0.0, 0.0], branch: Branch::Negative };
    let target = Target::new(machine.home().point, *machine.home().direction()).unwrap();
    let error = machine.inverse(&target, &start).unwrap_err();
    assert_eq!(error, KinematicsError::Singular(Singularity::Jacobian));
    let error = machine.forward(&machine.home().joints, &start).unwrap_err();
    assert_eq!(error, KinematicsError::Singular(Singularity::Jacobian));
}

#[test]
fn joints_that_do_not_close() {
    let machine = machine();
    let start = machine.home().start();
    let joints = |struts| Joints { struts, a: -0.7, c: 0.0 };
    let error = machine.forward(&joints([960.0, 1640.0, 960.0]), &start).unwrap_err();
    assert!(matches!(error, KinematicsError::NoConvergence { .. } | KinematicsError::BehindBase { .. }), "{error}");
    let error = machine.forward(&joints([NAN, 1300.0, 1300.0]), &start).unwrap_err();
    assert_eq!(error, KinematicsError::NotFinite(Input::Struts));
    let error = machine.forward(&Joints { c: NAN, ..joints([1300.0; 3]) }, &start).unwrap_err();
    assert_eq!(error, KinematicsError::NotFinite(Input::C));
}

#[test]
fn the_other_branch_is_reached_only_when_asked_for() {
    let machine = machine();
    let start = machine.home().start();
    let target = Target::new(machine.home().point, *machine.home().direction()).unwrap();
    let flipped = machine.inverse(&target, &Start { branch: Branch::Positive, ..start }).unwrap();
    assert!(flipped.joints.a > 0.5 && flipped.joints.c.abs() > 3.0, "{:?}", flipped.joints);
    let back = machine.forward(&flipped.joints, &start).unwrap();
    assert!(back.point.iter().zip(target.point()).all(|(a, b)| (a - b).abs() < 1e-9));
    assert_eq!(machine.inverse(&target, &start).unwrap().joints.c, 0.0);
}

#[test]
fn a_dependent_rotation_without_a_reference() {
    let machine = machine();
    let home = machine.home();
    let [x, y, t] = home.spindle;
    let opposite = Pose { spindle: [x, y.map(|v| -v), t.map(|v| -v)], ..*home };
    assert_eq!(machine.dependent_rotation(&opposite, Tilted::Carried), Err(RotationError::Opposite));
    let sideways = Pose { spindle: [t.map(|v| -v), y, x], ..*home };
    assert_eq!(machine.dependent_rotation(&sideways, Tilted::Projected), Err(RotationError::AlongX));
}

#[test]
fn single_precision_finds_the_rings() {
    let d = Dimensions { xu: 450f32, ys2: 450.0, xr: 150.0, yr5: 150.0, ycp: 25.0, zc: 375.0, yt: -30.0, tz: 380.0 };
    let home = Home { strut: 1438f32, a: -45f32.to_radians() };
    let machine = Machine::new(d, home, Limits::none()).unwrap();
    let phi = |ring| {
        let target = Target::new(machine.frame().point_to_base(ring), *machine.home().direction()).unwrap();
        let pose = machine.inverse(&target, &machine.home().start()).unwrap();
        assert!(pose.iterations <= 6, "{}", pose.iterations);
        machine.dependent_rotation(&pose, Tilted::Projected).unwrap()
    };
    let between = phi([-0.625, 200.914, -168.0]) - phi([-319.135, 198.236, -168.0]);
    assert!((between.to_degrees() + 16.3234).abs() < 1e-3, "{}", between.to_degrees());
}
