//! Paths and their programs keep within the axes' ranges, feed-in and all, and have the axes at speed in what is measured.

use std::f64::consts::TAU;
use trunnion::Setup;
use trunnion::program::{Control, Program};
use trunnion::study::{FEED_IN, Path};
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::AxisKind;

const OVERSHOOT: f64 = 5.0;

fn setup(model: &str, ranges: &[(&str, [f64; 2])]) -> Setup {
    let mut setup = Setup::from_catalogue(model, &[]).unwrap();
    for (name, range) in ranges {
        let own =
            setup.model.workpiece.iter_mut().chain(&mut setup.model.tool).find(|axis| axis.name == *name).unwrap();
        own.range = Some(range.map(|end| if own.kind == AxisKind::Rotary { end.to_radians() } else { end }));
    }
    setup
}

fn path(setup: &Setup, run: RunId) -> Path {
    setup.path(run, OVERSHOOT.to_radians()).unwrap_or_else(|why| panic!("{}: {why}", setup.model.name))
}

fn degrees(ends: [f64; 2]) -> [f64; 2] {
    ends.map(|end| (end.to_degrees() * 1e6).round() / 1e6)
}

/// A path on which the axes have somewhere to come to speed, and no coordinate of a block is beyond a range.
fn held(setup: &Setup, run: RunId) -> Path {
    let name = &setup.model.runs[run].name;
    let path = path(setup, run);
    let [first, last] = [path.sweeps[0], path.sweeps[path.sweeps.len() - 1]];
    assert_eq!(path.overshoot, OVERSHOOT.to_radians(), "{name}");
    assert!((path.measured[0] - first - path.overshoot).abs() < 1e-9, "{name}");
    assert!((last - path.measured[1] - path.overshoot).abs() < 1e-9, "{name}");
    let program = |control| Program { name, title: "", path: &path, rate: 360.0 }.text(control);
    for control in Control::ALL {
        let Some(text) = program(control) else { continue };
        let blocks = text.lines().map(|line| line.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' '));
        let mut words = 0;
        for block in blocks.filter(|line| ["G0 ", "G1 ", "L "].iter().any(|word| line.starts_with(word))) {
            for axis in setup.model.axes() {
                let word = block.split(' ').skip(1).find_map(|word| word.strip_prefix(axis.name.as_str()));
                let Some(at) = word.and_then(|word| word.trim_start_matches('=').parse::<f64>().ok()) else { continue };
                words += 1;
                let Some([low, high]) = axis.range else { continue };
                let end = |x: f64| if axis.kind == AxisKind::Rotary { x.to_degrees() } else { x };
                let within = end(low) - 1e-4..=end(high) + 1e-4;
                assert!(
                    within.contains(&at),
                    "{name}, {}: {} at {at}, not within {within:?}",
                    control.name(),
                    axis.name
                );
            }
        }
        assert!(words > path.sweeps.len(), "{name}, {}: {words} words", control.name());
    }
    // Every block of the path takes the same time: the axes are at speed where the first one of the measured part begins.
    let text = program(Control::Sinumerik).unwrap();
    let feeds = text.lines().filter(|line| line.starts_with("G1 ")).filter_map(|line| line.rsplit_once('F'));
    let feeds: Vec<&str> = feeds.map(|(_, feed)| feed).collect();
    let (fed, way) = (usize::from(path.outward.is_some()), path.sweeps.len() - 1);
    let own = &feeds[fed..fed + way];
    assert!(own.iter().all(|feed| *feed == own[0]), "{name}");
    path
}

#[test]
fn every_path_of_the_catalogue_has_the_axes_at_speed_within_their_ranges() {
    for (model, _) in MODELS {
        let setup = setup(model, &[]);
        for run in setup.model.runs.keys() {
            let path = held(&setup, run);
            let (from, to) = setup.sweep_range(run, (0.0, TAU));
            let [low, high] = degrees(path.measured);
            let whole = degrees([from, to]);
            let limited = to - from < TAU - 1e-9 || setup.reaches(run, (from - path.overshoot, to)).is_err();
            let expected = if limited { [whole[0] + OVERSHOOT, whole[1] - OVERSHOOT] } else { whole };
            assert_eq!([low, high], expected, "{model}");
        }
    }
}

/// Linear axes that go just as far as the path takes them have no room for the feed-in at either end of their travel.
#[test]
fn the_feed_in_is_within_the_ranges_of_linear_axes() {
    let mut moved = 0;
    for (model, _) in MODELS {
        let free = setup(model, &[]);
        for run in free.model.runs.keys() {
            let own = path(&free, run);
            let ranges: Vec<(&str, [f64; 2])> = own
                .axes
                .iter()
                .enumerate()
                .filter(|(_, (_, kind))| *kind == AxisKind::Linear)
                .map(|(at, (name, _))| {
                    let along = own.points.iter().map(|point| point[at]);
                    let [low, high] = along.fold([0.0f64; 2], |[l, h], x| [l.min(x), h.max(x)]);
                    // Between points an axis goes somewhat farther.
                    (name.as_str(), [low - 1e-3, high + 1e-3])
                })
                .collect();
            let tight = setup(model, &ranges);
            moved += usize::from(held(&tight, run).measured != own.measured);
        }
    }
    assert!(moved > 0, "{FEED_IN} mm fit everywhere");
}

#[test]
fn what_is_measured_makes_way_for_the_overshoot_where_an_axis_cannot_go_on() {
    let measured = |range: [f64; 2]| {
        let setup = setup("tilting-table-a", &[("A", range)]);
        let path = path(&setup, setup.run("tilting").unwrap());
        (degrees(path.measured), (path.overshoot.to_degrees() * 1e6).round() / 1e6)
    };
    assert_eq!(measured([-30.0, 120.0]), ([-25.0, 115.0], 5.0));
    assert_eq!(measured([-400.0, 400.0]), ([0.0, 360.0], 5.0));
    assert_eq!(measured([-2.0, 400.0]), ([3.0, 360.0], 5.0));
    assert_eq!(measured([-2.0, 361.0]), ([3.0, 356.0], 5.0));
    // Half of what there is is measured.
    assert_eq!(measured([0.0, 8.0]), ([2.0, 6.0], 2.0));
}

#[test]
fn without_room_for_the_feed_in_there_is_no_path() {
    let setup = setup("tilting-table-a", &[("Y", [-1.0, 1.0])]);
    let refused = setup.path(setup.run("tilting").unwrap(), 0.1).unwrap_err().to_string();
    assert!(refused.contains("axis Y would go to -2."), "{refused}");
}

#[test]
fn a_program_says_how_far_its_decimals_take_the_bar_off_its_length() {
    let setup = setup("tilting-table-b", &[]);
    let [bar, far] = [150.0, 200.0];
    let run = setup.run("b-tangential-far").unwrap();
    let path = path(&setup, run);
    for (control, decimals) in [(Control::Fanuc, 4), (Control::Heidenhain, 4), (Control::LinuxCnc, 5)] {
        let text = Program { name: "t", title: "", path: &path, rate: 360.0 }.text(control).unwrap();
        let (_, told) = text.split_once("UP TO ").or(text.split_once("up to ")).unwrap();
        let told: f64 = told.split(' ').next().unwrap().parse().unwrap();
        assert!(text.to_lowercase().contains(&format!("coordinates have {decimals} decimals")));
        // The ball on the table is at 2L along Z of the table, which turns about Y.
        let off = text.lines().filter(|line| line.contains("G1 ") || line.contains("L ")).filter_map(|line| {
            let word = |axis| line.split(' ').find_map(|word| word.strip_prefix(axis)?.parse::<f64>().ok());
            let (b, x, z) = (word('B')?.to_radians(), word('X')?, word('Z')?);
            Some(1e3 * ((x - far * b.sin()).hypot(z - far * b.cos()) - bar).abs())
        });
        // The feed-in and the feed-out are no part of it.
        let most = off.filter(|um| *um < 100.0).fold(0.0, f64::max);
        assert!(most <= told + 0.005 && most > 0.4 * told, "{}: {most} of {told} µm", control.name());
    }
}
