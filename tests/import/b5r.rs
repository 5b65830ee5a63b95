//! Tests of Ballbar 20, written by hand from what is known of their form.

use super::{alike, fitted, number, object, object_of_fit, reference, refused, samples, succeeds};
use std::fmt::Write;
use std::fs;

/// A run of a test.
pub struct Run<'a> {
    pub direction: &'a str,
    /// As they stand in the file.
    pub readings: Vec<f64>,
    /// What is said of it: name, unit, value.
    pub features: Vec<(&'a str, &'a str, f64)>,
}

/// The file of a test, with what no reader knows in between.
pub fn document(name: &str, plane: &str, length: f64, runs: &[Run]) -> String {
    let (a, b) = plane.split_at(1);
    let mut text = format!(
        "\u{feff}<?xml version=\"1.0\" encoding=\"utf-8\" standalone=\"yes\"?>\r\n<TEST_DOCUMENT>\n\
         <TEST_SPEC NAME=\"{name}\" version=\"2.0\">\n<FUTURE a=\"1\"><DEEP/>x</FUTURE>\n\
         <INSTRUMENT MANUFACTURER=\"Renishaw\" MODEL=\"QC20\"><SERIAL_NUMBER>A&amp;B-1</SERIAL_NUMBER>\n\
         <DYNAMIC_BALLBAR CALIBRATION_REQUIRED=\"true\"><NOMINAL_LENGTH>{length}</NOMINAL_LENGTH>\n\
         <PROGRAMMED_FEEDRATE>1500</PROGRAMMED_FEEDRATE>\n\
         <PLANE VIEW=\"+A+B\" TEST_PLANE=\"{plane}\"><A_AXIS_NAME>{a}</A_AXIS_NAME><B_AXIS_NAME>{b}</B_AXIS_NAME></PLANE>\n\
         </DYNAMIC_BALLBAR></INSTRUMENT></TEST_SPEC>\n<OPERATOR>Jörg</OPERATOR>\n<DATE_STARTED>20260401-080000</DATE_STARTED>\n\
         <MACHINE_TESTED NAME=\"Mill\n7\" />\n<RUN_RESULTS>\n"
    );
    for run in runs {
        let readings: Vec<String> = run.readings.iter().map(|reading| format!("{reading:.10}")).collect();
        let _ = write!(text, "<BALLBAR_RUN>\n<RUN_DIRECTION> {} </RUN_DIRECTION>\n", run.direction);
        let _ = writeln!(text, "<READINGS>{}</READINGS>", readings.join(" "));
        for (name, unit, value) in &run.features {
            let _ = writeln!(text, "<FEATURE NAME=\"{name}\" DT=\"{unit}\">{value}</FEATURE>");
        }
        text += "</BALLBAR_RUN>\n";
    }
    text + "</RUN_RESULTS>\n<ANALYSIS NAME=\"RENISHAW_DIAGNOSTICS\"><FEATURE NAME=\"AF_STRAIGHTNESS_A\" DT=\"UT_LENGTH_UM\">1.5\
            </FEATURE></ANALYSIS>\n</TEST_DOCUMENT>\n"
}

/// The readings of a native file, µm.
fn readings(file: &std::path::Path) -> Vec<f64> {
    samples(file).iter().map(|(_, reading)| number(reading)).collect()
}

/// Readings over a turn, µm, and how round they are.
fn mostly_round() -> (Vec<f64>, f64) {
    let angle = |i: i32| f64::from(i).to_radians();
    // 12 µm off its centre, and oval by 6 µm.
    let reading = |i| 9.0 * angle(i).cos() - 8.0 * angle(i).sin() + 3.0 * (2.0 * angle(i)).cos();
    ((0..=360).map(reading).collect(), 6.0)
}

fn circularity<'a>(um: f64) -> Vec<(&'a str, &'a str, f64)> {
    vec![("AF_CIRCULARITY", "UT_LENGTH_MM", um / 1e3), ("AF_CALCULATED_FEEDRATE", "UT_FEEDRATE", 1498.2)]
}

#[test]
fn both_units_and_both_directions_are_read() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (um, width) = mostly_round();
    let back: Vec<f64> = um.iter().rev().copied().collect();
    for (unit, factor) in [("mm", 1e-3), ("um", 1.0)] {
        let in_unit = |readings: &[f64]| readings.iter().map(|r| r * factor).collect();
        let runs = [
            Run { direction: "CCW", readings: in_unit(&um), features: circularity(width) },
            Run { direction: "cw", readings: in_unit(&back), features: circularity(width * 1.1) },
            Run { direction: "CCW", readings: in_unit(&um), features: Vec::new() },
        ];
        fs::write(at.join("test.b5r"), document("XY 360deg 150mm", "XY", 150.0, &runs)).unwrap();
        let told = object(&succeeds(at, &["import", "test.b5r", "--out", unit, "--angle", "c", "--json"]));
        let file = &told["files"][0];
        let said =
            ["test", "instrument", "serial_number", "machine", "operator", "started", "plane"].map(|key| &file[key]);
        let expected = ["XY 360deg 150mm", "Renishaw QC20", "A&B-1", "Mill 7", "Jörg", "20260401-080000", "XY"];
        assert_eq!(said, expected.map(serde_json::Value::from).each_ref());
        assert_eq!((&file["bar_mm"], &file["feed_mm_per_min"]), (&150.0.into(), &1500.0.into()));
        assert_eq!(file["features"][0]["name"], "AF_STRAIGHTNESS_A");
        let runs = &file["runs"];
        assert_eq!([0, 1, 2].map(|run| &runs[run]["unit"]), [unit; 3].map(serde_json::Value::from).each_ref());
        assert!(runs[2]["unit_from"].as_str().unwrap().contains("another run"));
        let own = runs[0]["circularity_mm"].as_f64().unwrap();
        // The first place counts twice.
        assert!((own - width / 1e3).abs() < 2e-5, "{own}");
        for (name, ends) in
            [("test-ccw-1", ["0.0", "360.0"]), ("test-cw", ["360.0", "0.0"]), ("test-ccw-2", ["0.0", "360.0"])]
        {
            let written = samples(&at.join(unit).join(format!("{name}.csv")));
            assert_eq!([&written[0].0, &written[360].0], ends, "{name}");
            // As many digits as the file has, in its own unit.
            let text = |at: usize| number(&format!("{:.10}", um[number(&written[at].0) as usize] * factor));
            assert!((0..361).all(|at| number(&written[at].1) == text(at)), "{name}");
        }
    }
    let text = fs::read_to_string(at.join("mm/test-cw.csv")).unwrap();
    assert!(text.contains("\nc_deg,dr_mm\n"));
    for said in [
        "# from: test.b5r",
        "# machine: Mill 7",
        "# run: CW, 360° to 0°, 361 samples",
        "# unit of the readings: mm, which",
    ] {
        assert!(text.contains(said), "{said} in {text}");
    }
    assert!(text.contains("# sha-256: ") && text.contains("# found: AF_CALCULATED_FEEDRATE 1498.2 UT_FEEDRATE"));
}

#[test]
fn a_circular_test_is_that_of_its_imported_runs() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (um, width) = mostly_round();
    let back: Vec<f64> = um.iter().rev().map(|reading| reading + 0.5).collect();
    let run =
        |direction, readings: &[f64]| Run { direction, readings: readings.to_vec(), features: circularity(width) };
    let pair = [run("CW", &back), run("CCW", &um)];
    fs::write(at.join("test.b5r"), document("ZX 360deg 100mm", "ZX", 100.0, &pair)).unwrap();
    let told = object(&succeeds(at, &["circular", "test.b5r", "--json"]));
    succeeds(at, &["import", "test.b5r", "--out", "."]);
    let parts = ["--cw", "test-cw.csv", "--ccw", "test-ccw.csv", "--radius", "100", "--plane", "ZX", "--feed", "1500"];
    alike(&told, &object(&succeeds(at, &[&["circular", "--json"][..], &parts].concat())), 1e-9);
    // A radius is the calibrated length of the same bar; a plane has to be the same, its axes in the same order.
    assert_eq!(object(&succeeds(at, &["circular", "test.b5r", "--radius", "100.02", "--json"]))["radius_mm"], 100.02);
    refused(at, &["circular", "test.b5r", "--radius", "150"], &["test.b5r: NOMINAL_LENGTH 100 mm", "150 mm"]);
    let exchanged = ["test plane ZX", "count from X and not from Z: state ZX"];
    refused(at, &["circular", "test.b5r", "--plane", "XZ"], &exchanged);
    refused(at, &["import", "test.b5r", "--plane", "xz", "--out", "new"], &exchanged);
    refused(at, &["circular", "test.b5r", "--plane", "XY"], &["test.b5r:", "XY"]);
    refused(at, &["circular", "test.b5r", "--cw", "test-cw.csv"], &["--cw"]);
    refused(at, &["circular", "test-cw.csv"], &["no length of the ball-bar", "--radius"]);
    let three = [run("CW", &back), run("CCW", &um), run("CCW", &um)];
    fs::write(at.join("three.b5r"), document("ZX 360deg 100mm", "ZX", 100.0, &three)).unwrap();
    refused(at, &["circular", "three.b5r"], &["three.b5r: 2 counterclockwise runs", "trunnion import"]);
    fs::write(
        at.join("no-unit.b5r"),
        document("ZX 360deg 100mm", "ZX", 100.0, &[Run { features: vec![], ..run("CW", &um) }]),
    )
    .unwrap();
    refused(at, &["circular", "no-unit.b5r"], &["no-unit.b5r", "trunnion import with --unit mm or --unit um"]);
}

#[test]
fn what_is_trimmed_and_the_unit_do_not_depend_on_how_far_out_of_centre_the_circle_is() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for (eccentric, way) in [(0.0, 300.0), (30.0, 300.0), (80.0, 1000.0), (150.0, 1500.0), (300.0, 1500.0)] {
        let angle = |i: u32| (0.5 * f64::from(i)).to_radians();
        let circle = (0..=720).map(|i| eccentric * angle(i).cos() + 1.5 * (2.0 * angle(i)).cos());
        let ramp = |end: f64| (0..60).map(move |i| end - way + way * f64::from(i) / 60.0);
        let end = eccentric + 1.5;
        let um: Vec<f64> = ramp(end).chain(circle).chain(ramp(end).collect::<Vec<_>>().into_iter().rev()).collect();
        for (unit, factor) in [("mm", 1e-3), ("um", 1.0)] {
            let readings = um.iter().map(|um| um * factor).collect();
            let run = Run { direction: "CCW", readings, features: circularity(3.0) };
            fs::write(at.join("t.b5r"), document("XY 360deg", "XY", 150.0, &[run])).unwrap();
            let told = object(&succeeds(at, &["import", "t.b5r", "--out", "new", "--json"]));
            let run = &told["files"][0]["runs"][0];
            assert_eq!(run["unit"], unit, "{eccentric} {way}");
            let trimmed = ["feed_in", "feed_out"].map(|end| run["trimmed"][end].as_u64().unwrap());
            assert_eq!(trimmed, [60, 60], "{eccentric} {way} {unit}");
            let told = object(&succeeds(at, &["circular", "t.b5r", "--json"]));
            let deviation = told["paths"][0]["circular_deviation"]["minimum_zone_um"].as_f64().unwrap();
            assert!((deviation - 3.0).abs() < 0.4, "{eccentric} {way} {unit}: {deviation}");
        }
    }
}

#[test]
fn a_test_of_other_axes_than_the_runs_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (um, width) = mostly_round();
    let run = || Run { direction: "CCW", readings: um.clone(), features: circularity(width) };
    let fit = ["fit", "tilting-table-b", "--radius", "150", "--run", "b-radial-far=t.b5r"];
    for plane in ["XY", "YZ"] {
        fs::write(at.join("t.b5r"), document("360deg", plane, 150.0, &[run()])).unwrap();
        refused(
            at,
            &fit,
            &[&format!("t.b5r: test plane {plane}"), "expected the file of this run, which moves X and Z"],
        );
    }
    fs::write(at.join("t.b5r"), document("360deg", "ZX", 150.0, &[run()])).unwrap();
    let output = super::trunnion(at, &fit);
    assert!(!String::from_utf8_lossy(&output.stderr).contains("test plane"));
}

#[test]
fn an_arc_with_feed_in_and_overshoot_is_fitted_as_the_native_file() {
    let directory = reference("arc220");
    let at = directory.path();
    let native = fitted(at, ["tilting.csv", "separation.csv"], &[]);
    // 440 readings from -20 to 199.5 degrees; ten degrees more at either end, and the way there and back.
    for run in ["tilting", "separation"] {
        let um = readings(&at.join(format!("{run}.csv")));
        let (first, last) = (um[0], um[439]);
        let ramp = |from: f64, to: f64, n: usize| (0..n).map(move |i| from + (to - from) * i as f64 / n as f64);
        let mut all: Vec<f64> = ramp(first - 1200.0, first, 40).collect();
        all.extend([first; 20].iter().chain(&um).chain(&[last; 20]));
        all.extend(ramp(last + 900.0, last, 30).collect::<Vec<_>>().iter().rev());
        let runs =
            [Run { direction: "CCW", readings: all.iter().map(|um| um / 1e3).collect(), features: circularity(5.0) }];
        fs::write(at.join(format!("{run}.b5r")), document("YZ 220grad 150mm", "YZ", 150.0, &runs)).unwrap();
    }
    let arguments =
        ["import", "tilting.b5r", "separation.b5r", "--out", "runs", "--from-deg", "-20", "--to-deg", "199.5"];
    let more = ["--overshoot-deg", "10", "--unit", "mm", "--plane", "yz", "--json"];
    let told = object(&succeeds(at, &[&arguments[..], &more].concat()));
    for file in [0, 1] {
        let run = &told["files"][file]["runs"][0];
        let trimmed = ["feed_in", "before", "after", "feed_out"].map(|key| run["trimmed"][key].as_u64().unwrap());
        assert_eq!((trimmed, &run["samples"]), ([40, 20, 20, 30], &440.into()));
    }
    let imported = fitted(at, ["runs/tilting-ccw.csv", "runs/separation-ccw.csv"], &[]);
    alike(&imported, &native, 1e-6);
}

#[test]
fn fit_takes_a_test_directly_where_nothing_has_to_be_stated() {
    let directory = reference("full");
    let at = directory.path();
    // Whole turns that begin again at their first reading.
    let closed = |file: &str| {
        let mut um = readings(&at.join(file));
        um.push(um[0]);
        um
    };
    for run in ["tilting", "separation"] {
        let um = closed(&format!("{run}.csv"));
        // With a hysteresis that is largest in one place.
        let other_way = |(i, um): (usize, &f64)| um + 0.4 + 0.9 * (i as f64 + 20.0).to_radians().cos();
        let back: Vec<f64> = um.iter().enumerate().map(other_way).rev().collect();
        let native = |um: &[f64], angle: &dyn Fn(usize) -> usize| {
            let lines = um.iter().enumerate().map(|(i, r)| format!("{},{:.7}\n", angle(i), r));
            format!("a_deg,dr_um\n{}", lines.collect::<String>())
        };
        fs::write(at.join(format!("{run}-up.csv")), native(&um, &|i| i)).unwrap();
        fs::write(at.join(format!("{run}-down.csv")), native(&back, &|i| 360 - i)).unwrap();
        let runs = [&um, &back].map(|r| r.iter().map(|um| um / 1e3).collect::<Vec<f64>>());
        let width = width(&um);
        let [up, down] = runs;
        let runs = [
            Run { direction: "CCW", readings: up, features: circularity(width) },
            Run { direction: "CW", readings: down, features: circularity(width) },
        ];
        fs::write(at.join(format!("{run}.b5r")), document("YZ 360deg", "YZ", 150.0, &runs)).unwrap();
    }
    let twice = |endings: [&str; 2]| {
        let runs = ["tilting", "separation"].map(|run| endings.map(|ending| format!("{run}={run}{ending}")));
        let runs: Vec<String> = runs.concat();
        let mut arguments = super::FIT.to_vec();
        runs.iter().for_each(|run| arguments.extend(["--run", run.as_str()]));
        arguments.extend(super::TABLE);
        object_of_fit(at, &arguments)
    };
    let native = twice(["-up.csv", "-down.csv"]);
    let direct = fitted(at, ["tilting.b5r", "separation.b5r"], &[]);
    alike(&direct, &native, 1e-6);
    assert_eq!(direct["hysteresis"].as_array().unwrap().len(), 2, "the directions are known");
    let runs = ["--run", "tilting=tilting.b5r", "--run", "separation=separation.b5r"];
    let output = super::trunnion(at, &[&super::FIT[..], &runs, &super::TABLE, &["--report", "r.html"]].concat());
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let says = told["made"]["files"].as_array().unwrap().iter().find(|file| file["name"] == "tilting.b5r").unwrap();
    let says = says["says"].as_array().unwrap().iter().map(|line| (line["name"].as_str(), line["words"].as_str()));
    for line in
        [("machine", "Mill 7"), ("operator", "Jörg"), ("instrument", "Renishaw QC20"), ("serial number", "A&B-1")]
    {
        assert!(
            says.clone().any(|own| own == (Some(line.0), Some(line.1))),
            "{line:?}: {:?}",
            says.collect::<Vec<_>>()
        );
    }
    let page = fs::read_to_string(at.join("r.html")).unwrap();
    assert!(["Mill 7", "Jörg", "A&amp;B-1"].iter().all(|words| page.contains(words)), "{page}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("note: tilting.b5r: run: CW, 360° to 0°, 361 samples; unit of the readings: mm"), "{said}");
    super::refused(
        at,
        &["fit", super::MODEL, "--radius", "100", runs[0], runs[1], runs[2], runs[3]],
        &["150 mm", "100 mm"],
    );
}

/// The width of readings over a whole turn about their circle, whose coefficients are sums as the angles are even.
fn width(um: &[f64]) -> f64 {
    let turn = &um[..um.len() - 1];
    let angle = |i: usize| (i as f64 * 360.0 / turn.len() as f64).to_radians();
    let mean =
        |f: &dyn Fn(f64) -> f64| turn.iter().enumerate().map(|(i, r)| r * f(angle(i))).sum::<f64>() / turn.len() as f64;
    let (c0, c1, c2) = (mean(&|_| 1.0), 2.0 * mean(&f64::cos), 2.0 * mean(&f64::sin));
    let off: Vec<f64> =
        turn.iter().enumerate().map(|(i, r)| r - c0 - c1 * angle(i).cos() - c2 * angle(i).sin()).collect();
    off.iter().copied().fold(f64::MIN, f64::max) - off.iter().copied().fold(f64::MAX, f64::min)
}
