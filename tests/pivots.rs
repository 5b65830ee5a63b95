//! Where the rotary axes are: probing programs, location errors, and what controls take.

mod program;

use program::{succeeds, trunnion};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn refused(directory: &Path, arguments: &[&str]) -> String {
    let output = trunnion(directory, arguments);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

type Place = [f64; 3];

/// A place turned about x, y or z.
fn turned(p: Place, about: usize, angle: f64) -> Place {
    let (i, j) = ((about + 1) % 3, (about + 2) % 3);
    let (s, c) = angle.sin_cos();
    let mut q = p;
    (q[i], q[j]) = (c * p[i] - s * p[j], s * p[i] + c * p[j]);
    q
}

/// The numbers in brackets of a call.
fn numbers(line: &str) -> Vec<f64> {
    line.split('[').skip(1).map(|part| part.split(']').next().unwrap().parse().unwrap()).collect()
}

#[test]
fn programs_go_where_the_sphere_is() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let cases = [("ac-trunnion-probe", "A", 0, [0.0, 120.0, 70.0]), ("bc-trunnion-probe", "B", 1, [120.0, 0.0, 70.0])];
    for (model, axis, about, ball) in cases {
        let new = ["new", model, "--set", "L=120", "--set", "H=70", "--positions", "7", "--touch-mm", "12.5", "--out"];
        succeeds(at, &[&new[..], &[model]].concat());
        let plan = fs::read_to_string(at.join(model).join("measuring-plan.md")).unwrap();
        assert!(plan.contains("A sphere probed at 7 positions") && plan.contains("with 7 readings a run"), "{plan}");
        for run in [axis.to_lowercase().as_str(), "c", "c-tilted"] {
            let program = fs::read_to_string(at.join(model).join(format!("{run}.linuxcnc.ngc"))).unwrap();
            assert!(program.contains("#<_radius> = 12.5 ;") && program.contains(&format!("(LOGOPEN,{run}.csv)")));
            let calls: Vec<&str> = program.lines().filter(|line| line.starts_with("o300 call")).collect();
            assert_eq!(calls.len(), 7);
            let words = program.lines().filter(|line| line.starts_with(&format!("G0 {axis}")));
            for (words, call) in words.zip(&calls) {
                let angle = |name: &str| {
                    let word = words.split(' ').find_map(|word| word.strip_prefix(name)).unwrap();
                    word.parse::<f64>().unwrap().to_radians()
                };
                let sphere = turned(turned(ball, 2, angle("C")), about, angle(axis));
                let called = numbers(call);
                // Words have five decimals of a degree.
                assert!((0..3).all(|i| (called[i] - sphere[i]).abs() < 2e-5), "{model} {run}: {words}: {call}");
                let swept = if run.starts_with('c') { angle("C") } else { angle(axis) };
                assert!((called[3].to_radians() - swept).abs() < 1e-6);
            }
        }
    }
    // The templates for other controls go to the same places.
    let read = |file: &str| fs::read_to_string(at.join("ac-trunnion-probe").join(file)).unwrap();
    let called: Vec<Vec<f64>> =
        read("a.linuxcnc.ngc").lines().filter(|line| line.starts_with("o300 call")).map(numbers).collect();
    let after = |line: &str, words: [&str; 4]| -> Vec<f64> {
        let value = |word: &str| {
            let rest = line.split_once(word).unwrap().1;
            rest.split(' ').next().unwrap().parse().unwrap()
        };
        words.map(value).to_vec()
    };
    let fanuc = read("a.fanuc.nc");
    let fanuc: Vec<_> = fanuc.lines().filter(|line| line.starts_with("G65 P9001 ")).collect();
    let sinumerik = read("a.sinumerik.mpf");
    let sinumerik: Vec<_> = sinumerik.lines().filter(|line| line.starts_with("R1=") && line.contains(" R4=")).collect();
    assert_eq!(fanuc.iter().map(|line| after(line, [" X", " Y", " Z", " S"])).collect::<Vec<_>>(), called);
    assert_eq!(sinumerik.iter().map(|line| after(line, ["R1=", " R2=", " R3=", " R4="])).collect::<Vec<_>>(), called);
    let heidenhain = read("a.heidenhain.h");
    let set = |q: usize| {
        let value = move |line: &str| line.split_once(&format!(" Q{q} = ")).and_then(|(_, value)| value.parse().ok());
        heidenhain.lines().filter_map(value).take(7).collect::<Vec<f64>>()
    };
    (1..=4).for_each(|q| assert_eq!(set(q), called.iter().map(|place| place[q - 1]).collect::<Vec<_>>(), "Q{q}"));
    assert!([read("a.fanuc.nc"), read("a.sinumerik.mpf"), heidenhain.clone()].iter().all(|p| p.contains("UNVERIFIED")));
    // The spindle of a head stands still and has no word; nothing else is probed.
    succeeds(at, &["new", "b-head-c-table-probe", "--positions", "6", "--out", "head"]);
    let head = fs::read_to_string(at.join("head/b.linuxcnc.ngc")).unwrap();
    assert!(
        head.lines().any(|line| line == "G0 C0.00000 B-54.00000")
            && !head.lines().any(|line| line.starts_with("G0") && line.contains('S'))
    );
    assert!(refused(at, &["new", "tilting-table-a", "--positions", "6", "--out", "none"]).contains("xyz"));
    assert!(refused(at, &["new", "ac-trunnion-probe", "--positions", "2", "--out", "none"]).contains("3 to 1000"));
    assert!(!at.join("none").exists());
}

/// A drawn machine, measured: its fit, and its truth in mm and rad.
fn measured(at: &Path, model: &str) -> (Vec<String>, BTreeMap<String, f64>) {
    succeeds(at, &["simulate", model, "--seed", "11", "--samples", "24", "--noise-um", "0.5", "--out", "m"]);
    let truth: Value = serde_json::from_str(&fs::read_to_string(at.join("m/truth.json")).unwrap()).unwrap();
    let number = |(name, value): (&String, &Value)| Some((name.clone(), value.as_f64()?));
    let truth = truth.as_object().unwrap().iter().filter_map(number).collect();
    let mut runs: Vec<String> = Vec::new();
    for entry in fs::read_dir(at.join("m")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        if let Some(run) = file.strip_suffix(".csv") {
            runs.extend(["--run".to_owned(), format!("{run}=m/{file}")]);
        }
    }
    (runs, truth)
}

#[test]
fn location_errors_are_found_and_told_in_the_terms_of_a_control() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (runs, truth) = measured(at, "ac-trunnion-probe");
    let command = |first: &[&str], more: &[&str]| {
        let runs = runs.iter().map(String::as_str);
        first.iter().copied().chain(runs).chain(more.iter().copied()).map(str::to_owned).collect::<Vec<_>>()
    };
    let run = |first: &[&str], more: &[&str]| {
        let words = command(first, more);
        succeeds(at, &words.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let fit: Value = serde_json::from_str(&run(&["fit", "ac-trunnion-probe"], &["--json"])).unwrap();
    let mut found = BTreeMap::new();
    for function in fit["functions"].as_array().unwrap() {
        let name = function["name"].as_str().unwrap();
        assert_eq!((&function["location_error"], &function["determined"]), (&true.into(), &true.into()), "{name}");
        let [point] = function["points"].as_array().unwrap().as_slice() else { panic!("{name}: several points") };
        let unit = if function["unit"] == "um" { 1e-3 } else { 1e-6 };
        let [value, u95] = ["value", "u95"].map(|key| point[key].as_f64().unwrap() * unit);
        assert!((value - truth[name]).abs() < 1.6 * u95, "{name}: {value} ± {u95}, truly {}", truth[name]);
        found.insert(name.to_owned(), value);
    }
    assert_eq!(found.len(), 8);

    let pins = ["--pin", "x-rot-point=20", "--pin", "y-rot-point=-35.5", "--pin", "y-offset=1"];
    run(&["pivots", "ac-trunnion-probe", "--format", "linuxcnc", "--out", "pivots.hal"], &pins);
    let hal = fs::read_to_string(at.join("pivots.hal")).unwrap();
    let set = |pin: &str| {
        let line = hal.lines().find_map(|line| line.strip_prefix(&format!("setp xyzac-trt-kins.{pin} "))).unwrap();
        line.parse::<f64>().unwrap()
    };
    // Where C is with A at zero, and where A is beside it.
    for (pin, expected) in [
        ("x-rot-point", 20.0 + found["EX0C"]),
        ("y-rot-point", -35.5 + found["EY0A"] + found["EY0C"]),
        ("y-offset", 1.0 - found["EY0C"]),
    ] {
        assert!((set(pin) - expected).abs() < 1e-6, "{pin}: {} and not {expected}", set(pin));
    }
    // Of a pin that is not known, what is to be added is no command.
    assert!(!hal.contains("setp xyzac-trt-kins.z-rot-point"));
    let added =
        format!("# to be added to xyzac-trt-kins.z-rot-point, which was not given: {:.6}, + EZ0A", found["EZ0A"]);
    assert!(hal.contains(&added), "{added}: {hal}");
    // A sum is as uncertain as its errors are together, in the file as in the object.
    let told = ["--format", "linuxcnc", "--json", "--force", "--pin", "y-rot-point=-35.5"];
    let object: Value =
        serde_json::from_str(&run(&["pivots", "ac-trunnion-probe", "--out", "pivots.hal"], &told)).unwrap();
    let named = |of: &str, name: &str, key: &str| {
        let own = object[of].as_array().unwrap().iter().find(|own| own["name"] == name).unwrap();
        own[key].as_f64().unwrap()
    };
    let [of_x, of_y] = ["x-rot-point", "y-rot-point"].map(|pin| named("pins", pin, "u95"));
    let [x_c, y_a, y_c] = ["EX0C", "EY0A", "EY0C"].map(|error| named("location_errors", error, "u95"));
    assert!((of_x / x_c - 1.0).abs() < 1e-9 && of_y < 0.9 * y_a.hypot(y_c), "{of_x} {x_c}; {of_y} {y_a} {y_c}");
    assert!((named("pins", "y-rot-point", "value_mm") - set("y-rot-point")).abs() < 1e-6);
    let value = 1e3 * (found["EY0A"] + found["EY0C"]);
    let line = format!("# -35.500000 + EY0A + EY0C = {value:.2} +- {of_y:.2} um (95 %)");
    assert!(hal.lines().any(|own| own == line), "{line}: {hal}");
    assert!(["EB0A", "EC0A", "EA0C", "EB0C"].iter().all(|name| hal.contains(&format!("# no pin for {name}"))));

    run(&["pivots", "ac-trunnion-probe", "--format", "sinumerik", "--out", "chain.txt"], &[]);
    let chain = fs::read_to_string(at.join("chain.txt")).unwrap();
    let three = |start: &str| {
        let line = chain.lines().find(|line| line.contains(start)).unwrap();
        let inside = line.split_once('(').unwrap().1.split_once(')').unwrap().0;
        inside.split(", ").map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(three("offset before A")[1..], [found["EY0A"], found["EZ0A"]].map(|x| (x * 1e6).round() / 1e6));
    for (axis, n, about) in [("A", [1.0, 0.0, 0.0], ["EB0A", "EC0A"]), ("C", [0.0, 0.0, 1.0], ["EA0C", "EB0C"])] {
        let first = if axis == "A" { 1 } else { 0 };
        let leaning = about.iter().enumerate().fold(n, |n, (i, name)| turned(n, first + i, found[*name]));
        let by = three(&format!("direction of {axis}"));
        // To first order.
        assert!((0..3).all(|i| (n[i] + by[i] - leaning[i]).abs() < 2e-8), "{axis}: {by:?}");
    }

    run(&["pivots", "ac-trunnion-probe", "--format", "csv", "--out", "errors.csv"], &[]);
    let table = fs::read_to_string(at.join("errors.csv")).unwrap();
    let mut rows = table.lines().skip_while(|line| line.starts_with('#'));
    assert_eq!(rows.next(), Some("error,unit,value,std,u95"));
    let mut named_rows = BTreeMap::new();
    for row in rows {
        let [name, unit, value, std, u95] = row.split(',').collect::<Vec<_>>()[..] else { panic!("{row}") };
        let [value, std, u95] = [value, std, u95].map(|x| x.parse::<f64>().unwrap());
        assert!(std > 0.0 && (u95 - named("location_errors", name, "u95")).abs() < 1e-6, "{row}");
        named_rows.insert(name.to_owned(), value * if unit == "um" { 1e-3 } else { 1e-6 });
    }
    assert!(named_rows.len() == 8 && found.iter().all(|(name, value)| (named_rows[name] - value).abs() < 1e-8));
    // What the runs do not determine is not told as nothing.
    let alone: Vec<&str> = ["pivots", "ac-trunnion-probe", "--format", "sinumerik", "--json", "--out", "c.txt"].into();
    let with_c = |run: &&str| ["c-x=", "c-y=", "c-z="].iter().any(|own| run.starts_with(own));
    let of_c: Vec<&str> = runs.iter().map(String::as_str).filter(with_c).flat_map(|run| ["--run", run]).collect();
    let object: Value = serde_json::from_str(&succeeds(at, &[&alone[..], &of_c].concat())).unwrap();
    let chain = fs::read_to_string(at.join("c.txt")).unwrap();
    let of_a = &object["chain"][0];
    assert_eq!(of_a["offset"], serde_json::json!([]), "{of_a}");
    assert_eq!(of_a["not_determined"], serde_json::json!(["EB0A", "EC0A", "EY0A", "EZ0A"]));
    assert!(chain.contains("; offset before A: $NK_OFF_DIR += (0.000000, ?, ?)  +- (0.000000, ?, ?)\n"), "{chain}");
    assert!(chain.contains("; ?: EB0C, EX0C, EY0C not determined"), "{chain}");
    // Constants of a volumetric table; none of a single axis' table.
    run(&["export", "ac-trunnion-probe", "--format", "volcomp", "--out", "volcomp.csv"], &[]);
    assert!(fs::read_to_string(at.join("volcomp.csv")).unwrap().contains("X0C"));
    let words =
        command(&["export", "ac-trunnion-probe", "--function", "EX0C", "--format", "linuxcnc", "--out", "x"], &[]);
    assert!(refused(at, &words.iter().map(String::as_str).collect::<Vec<_>>()).contains("trunnion pivots"));
    let cases: [(&[&str], &str); 4] = [
        (&["--format", "linuxcnc", "--pin", "x-offset=1"], "no pin of xyzac-trt-kins"),
        (&["--format", "linuxcnc", "--pin", "x-rot-point"], "NAME=MM"),
        (&["--format", "linuxcnc", "--pin", "x-rot-point=1", "--pin", "x-rot-point=2"], "given twice"),
        (&["--format", "sinumerik", "--pin", "x-rot-point=1"], "no effect"),
    ];
    for (more, told) in cases {
        let words = command(&["pivots", "ac-trunnion-probe", "--out", "no"], more);
        assert!(refused(at, &words.iter().map(String::as_str).collect::<Vec<_>>()).contains(told), "{told}");
    }
}

#[test]
fn what_has_no_kinematics_is_refused_and_what_is_no_location_error_has_no_pivots() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (runs, _) = measured(at, "b-head-c-table-probe");
    let words =
        [&["pivots", "b-head-c-table-probe", "--format", "linuxcnc", "--out", "no"].map(str::to_owned)[..], &runs]
            .concat();
    assert!(refused(at, &words.iter().map(String::as_str).collect::<Vec<_>>()).contains("no kinematics of LinuxCNC"));
    fs::remove_dir_all(at.join("m")).unwrap();
    let (runs, _) = measured(at, "rotary-table-c-rtest");
    let words =
        [&["pivots", "rotary-table-c-rtest", "--format", "sinumerik", "--out", "no"].map(str::to_owned)[..], &runs]
            .concat();
    assert!(refused(at, &words.iter().map(String::as_str).collect::<Vec<_>>()).contains("location errors"));
    assert!(!at.join("no").exists());
}
