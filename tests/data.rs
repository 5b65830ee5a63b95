//! Reading and writing of measurement files: the reference sets, round trips, and what is said about bad files.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use trunnion::data::{
    FileError, FileProblem, Known, Quantity, Radius, RadiusError, Sweep, Table, Truth, TruthFunction, Unit,
    WriteProblem, write_atomically,
};

fn reference(set: &str, file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/tilting-table").join(set).join(file)
}

fn radius() -> Radius {
    Radius::new(150.0).unwrap()
}

fn lengths() -> [Known; 2] {
    ["dya", "dza"].map(|name| Known { name: name.into(), quantity: Quantity::Length })
}

fn angles(name: &str) -> [Known; 1] {
    [Known { name: name.into(), quantity: Quantity::Angle }]
}

/// A file of its own directory, which goes with it.
fn file(contents: &[u8]) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("run.csv");
    fs::write(&path, contents).unwrap();
    (directory, path)
}

fn read(contents: &str) -> Result<Sweep, FileError> {
    let (_kept, path) = file(contents.as_bytes());
    Sweep::read(&path, "a", radius(), 2)
}

fn table(contents: &str) -> Table {
    let (_kept, path) = file(contents.as_bytes());
    Table::read(&path, "a", &angles("ex")).unwrap()
}

#[test]
fn a_table_may_say_how_uncertain_it_is() {
    let known = table("a_deg,ex_urad,u_ex_urad\n0,1,0.5\n10,3,1.5\n");
    let at = known.at(5f64.to_radians()).unwrap();
    assert!((at.values[0] - 2e-6).abs() < 1e-18 && (at.stds[0] - 1e-6).abs() < 1e-18);
    assert_eq!(table("a_deg,ex_urad\n0,1\n10,3\n").at(0.0).unwrap().stds, [0.0]);
    // A function that is called like another's uncertainty.
    let (_kept, path) = file(b"a_deg,x_urad,u_x_urad,u_u_x_urad\n0,1,2,0.5\n10,3,4,0.5\n");
    let function = |name: &str| Known { name: name.into(), quantity: Quantity::Angle };
    let both = Table::read(&path, "a", &[function("x"), function("u_x")]).unwrap().at(0.0).unwrap();
    assert_eq!((both.values, both.stds), (vec![1e-6, 2e-6], vec![0.0, 5e-7]));
    let (_kept, path) = file(b"a_deg,ex_urad,u_ex_urad\n0,1,-0.5\n10,3,1.5\n");
    let refused = Table::read(&path, "a", &angles("ex")).unwrap_err().to_string();
    assert!(refused.contains("a negative uncertainty in column u_ex"), "{refused}");
}

#[test]
fn reference_runs_are_read_in_rad_and_mm() {
    for (set, samples) in [("full", 360), ("exact", 360), ("r100", 720), ("arc220", 440), ("arc90", 360)] {
        for run in ["tilting.csv", "separation.csv"] {
            assert_eq!(Sweep::read(&reference(set, run), "a", radius(), 11).unwrap().samples().len(), samples);
        }
    }
    let sweep = Sweep::read(&reference("full", "separation.csv"), "a", radius(), 11).unwrap();
    let third = sweep.samples()[2];
    assert_eq!((third.angle_rad, third.reading_mm, third.line), (2f64.to_radians(), -20.876197 / 1e3, 4));
    assert_eq!(sweep.range_rad(), Some((0.0, 359f64.to_radians())));
}

#[test]
fn reference_tables_are_exact_at_their_nodes() {
    for set in ["full", "exact", "r100", "arc220", "arc90"] {
        let known = Table::read(&reference(set, "table.csv"), "a", &lengths()).unwrap();
        let sweep = Sweep::read(&reference(set, "tilting.csv"), "a", radius(), 11).unwrap();
        let at = known.at_samples(&sweep).unwrap();
        let text = fs::read_to_string(reference(set, "table.csv")).unwrap();
        for (values, line) in at.samples.iter().map(|s| &s.values).zip(text.lines().skip(1)) {
            let um: Vec<f64> = line.split(',').skip(1).map(|field| field.parse::<f64>().unwrap() / 1e3).collect();
            assert_eq!(*values, um);
        }
        assert_eq!(known.repeats(), !set.starts_with("arc"), "{set}");
    }
}

#[test]
fn what_spreadsheets_add_is_tolerated() {
    let plain = read("a_deg,dr_um\n0,1\n10,2\n").unwrap();
    let dressed = read("\u{feff}# ball-bar\r\n\r\n\"a_deg\" ,\tdr_um \r\n 0 , 1\r\n# pause, 3\r\n\r\n10,2").unwrap();
    let values = |sweep: &Sweep| sweep.samples().iter().map(|s| (s.angle_rad, s.reading_mm)).collect::<Vec<_>>();
    assert_eq!(values(&plain), values(&dressed));
    assert_eq!(dressed.samples().iter().map(|sample| sample.line).collect::<Vec<_>>(), [4, 7]);
    let german = read("Messung 7\n\nZeit;a_deg;dr_um;\n12:00;0;1,0;\n12:01;1e1;2,;\n").unwrap();
    assert_eq!(values(&plain), values(&german));
    let swapped = read("dr_mm,a_rad\n0.001,0.5\n0.002,0.25\n").unwrap();
    assert_eq!(values(&swapped), [(0.5, 0.001), (0.25, 0.002)]);
}

#[test]
fn a_run_written_is_the_run_read() {
    for set in ["full", "arc220"] {
        let original = Sweep::read(&reference(set, "tilting.csv"), "a", radius(), 11).unwrap();
        let directory = tempfile::tempdir().unwrap();
        let pairs: Vec<_> = original.samples().iter().map(|s| (s.angle_rad, s.reading_mm)).collect();
        let copy = Sweep::new(directory.path().join("copy.csv"), pairs);
        for (angle, length) in [(Unit::Deg, Unit::Um), (Unit::Deg, Unit::Mm), (Unit::Rad, Unit::Mm)] {
            copy.write("a", angle, length).unwrap();
            assert_eq!(Sweep::read(copy.file(), "a", radius(), 11).unwrap(), copy);
        }
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }
    // Numbers no unit was made for are exact in rad and mm.
    let odd = (1..500).map(|i| (f64::from(i).sqrt() * 0.1, (f64::from(i) * 0.7).sin() / 3.0));
    let (_kept, path) = file(b"");
    let odd = Sweep::new(path, odd);
    odd.write("a", Unit::Rad, Unit::Mm).unwrap();
    assert_eq!(Sweep::read(odd.file(), "a", radius(), 11).unwrap(), odd);
}

#[test]
fn a_table_written_is_the_table_read() {
    let known = Table::read(&reference("full", "table.csv"), "a", &lengths()).unwrap();
    let (_kept, path) = file(b"");
    let angles: Vec<f64> = (0..=360).map(|a| f64::from(a).to_radians()).collect();
    let lines = angles.iter().map(|angle| (*angle, known.at(*angle).unwrap().values));
    Table::write(&path, "a", &lengths(), lines).unwrap();
    let again = Table::read(&path, "a", &lengths()).unwrap();
    assert!(angles.iter().all(|angle| again.at(*angle) == known.at(*angle)));
}

#[test]
fn tables_are_linear_between_nodes_and_end_at_the_last() {
    let known = table("a_rad,ex_rad\n2,30\n0,10\n1,20\n1,20\n");
    let values = [-0.1, 0.0, 0.5, 1.0, 1.25, 2.0, 2.1].map(|angle| known.at(angle).map(|v| v.values[0]));
    assert_eq!(values, [None, Some(10.0), Some(15.0), Some(20.0), Some(22.5), Some(30.0), None]);
    assert!(!known.repeats());
}

#[test]
fn tables_of_a_whole_turn_repeat() {
    let turn = |step: usize, last: usize| {
        let lines = (0..=last).step_by(step).map(|a| format!("{a},{}\n", (a as f64).to_radians().cos()));
        table(&format!("a_deg,ex_rad\n{}", lines.collect::<String>()))
    };
    for known in [turn(10, 350), turn(10, 360)] {
        assert!(known.repeats());
        for degrees in [355.0, -5.0, 715.0] {
            let value = known.at(f64::to_radians(degrees)).unwrap().values[0];
            assert!((value - (1.0 + 10f64.to_radians().cos()) / 2.0).abs() < 1e-12, "{degrees} {value}");
        }
    }
    for known in [turn(10, 340), turn(10, 370), turn(90, 270)] {
        assert!(!known.repeats());
        assert_eq!(known.at(-0.1), None);
    }
}

#[test]
fn truth_has_the_shape_of_the_reference() {
    for set in ["full", "arc220"] {
        let text = fs::read_to_string(reference(set, "truth.json")).unwrap();
        let expected: serde_json::Value = serde_json::from_str(&text).unwrap();
        let number = |value: &serde_json::Value| value.as_f64().unwrap();
        let point = |p: &serde_json::Value| (number(&p["a_deg"]), number(&p["urad"]));
        let points = expected["eps_xa"].as_array().unwrap().iter().map(point).collect();
        let mut truth = Truth {
            seed: expected["seed"].as_u64().unwrap(),
            radius_mm: Some(number(&expected["radius_mm"])),
            samples: expected["samples"].as_u64().unwrap() as usize,
            noise_um: number(&expected["noise_um"]),
            range_deg: (number(&expected["range_deg"][0]), number(&expected["range_deg"][1])),
            functions: vec![TruthFunction {
                name: "eps_xa".into(),
                unit: Unit::Urad,
                coordinate: "a_deg".into(),
                points,
            }],
            constants: ["exa1", "exa2"].map(|name| (name.into(), number(&expected[name]))).to_vec(),
        };
        let (_kept, path) = file(b"");
        truth.write(&path).unwrap();
        let written = fs::read_to_string(&path).unwrap();
        assert_eq!(serde_json::from_str::<serde_json::Value>(&written).unwrap(), expected);
        assert_eq!(written.lines().take(30).collect::<Vec<_>>(), text.lines().take(30).collect::<Vec<_>>());
        truth.noise_um = f64::NAN;
        assert!(truth.to_json().is_err());
    }
}

#[test]
fn nothing_half_written_is_left() {
    let (kept, path) = file(b"before");
    let bad = Sweep::new(&path, [(0.0, 0.0), (0.1, f64::NAN)]);
    let problem = bad.write("a", Unit::Deg, Unit::Um).unwrap_err().problem;
    assert_eq!(problem, WriteProblem::NotFinite { line: 3, column: 2 });
    assert_eq!(bad.write("a", Unit::Um, Unit::Um).unwrap_err().problem, WriteProblem::Unit(Unit::Um));
    let taken = kept.path().join("taken");
    fs::create_dir(&taken).unwrap();
    assert!(write_atomically(&taken, b"a directory").is_err());
    assert!(write_atomically(&kept.path().join("none/run.csv"), b"no directory").is_err());
    assert_eq!(fs::read(&path).unwrap(), b"before");
    assert_eq!(fs::read_dir(kept.path()).unwrap().count(), 2);
}

#[test]
fn impossible_radii_are_refused() {
    assert!(Radius::new(150.0).is_ok());
    for (mm, error) in [(0.0, RadiusError::NotPositive(0.0)), (-1.0, RadiusError::NotPositive(-1.0))] {
        assert_eq!(Radius::new(mm), Err(error));
    }
    assert_eq!(Radius::new(150_000.0), Err(RadiusError::TooLong(150_000.0)));
    assert!(matches!(Radius::new(f64::NAN), Err(RadiusError::NotFinite(_))));
    assert!(matches!(Radius::new(f64::INFINITY), Err(RadiusError::NotFinite(_))));
}

/// The message without the directory, which is another one each time.
fn message(error: &FileError) -> String {
    let directory = error.file.parent().unwrap().display().to_string();
    error.to_string().replace(&format!("{directory}/"), "")
}

/// What a file holds, as far as a reader of the snapshot has to see it.
fn excerpt(contents: &[u8]) -> String {
    let text = String::from_utf8_lossy(contents).replace(['\u{feff}', '\0'], "");
    text.lines().take(6).map(|line| format!("    | {line}\n")).collect()
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect()
}

#[test]
fn bad_runs() {
    let good = |count| format!("a_deg,dr_um\n{}", lines(count, |i| format!("{i},{i}.125\n")));
    let with = |header: &str| format!("{header}\n0,1\n10,2\n").into_bytes();
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("empty", b"".into()),
        ("comments only", b"# nothing\n\n# here\n".into()),
        ("Latin-1", b"a_deg,dr_um\n0,1\n10,2\xb5\n".into()),
        ("UTF-16", b"\xff\xfea\0_\0d\0e\0g\0".into()),
        ("zeros", b"a_deg,dr_um\n0,1\n\0\n".into()),
        ("XML", b"<?xml version='1.0'?>\n<a/>\n".into()),
        ("no header", b"0,1\n10,2\n".into()),
        ("semicolons", b"# exported\na_deg;dr\n0;1,5\n10;2,5\n".into()),
        ("tabs", b"a_deg\tdr_um\n0\t1\n10\n".into()),
        ("one sign or the other", b"a_deg,dr_um|x\n0,1|y\n".into()),
        ("texts above the numbers", b"test;7\n\nangle;dr_um\n0;1,5\n10;2,5\n".into()),
        ("missing column", b"a_deg\n0\n10\n".into()),
        ("unknown column", with("a_deg,temperature_degc")),
        ("wrong case", with("A_deg,dr_um")),
        ("angle without unit", with("a,dr_um")),
        ("reading without unit", with("a_deg,dr")),
        ("unit that does not fit", with("a_deg,dr_nm")),
        ("both units", with("a_deg,a_rad,dr_um")),
        ("column twice", with("a_deg,dr_um,dr_um")),
        ("several things in the header", with("A_deg,dr,x")),
        ("not finite", b"a_deg,dr_um\n0,NaN\n10,inf\n20,1e999\n".into()),
        ("text in a number", b"a_deg,dr_um\n0,1\n10,1.2.3\n20,12 um\n30,\n".into()),
        ("two decimal signs", b"a_deg,dr_um\n0,\"1,5\"\n10,2.5\n20,\"1.000,5\"\n".into()),
        ("decimal commas", b"a_deg,dr_um\n0,0,1,5\n10,0,2,5\n".into()),
        ("wrong number of fields", b"a_deg,dr_um\n0\n10,2,3\n".into()),
        ("many bad lines", format!("a_deg,dr_um\n{}", lines(12, |i| format!("{i},x\n"))).into()),
        ("cut between fields", (good(12) + "12").into()),
        ("cut after the comma", (good(12) + "12,").into()),
        ("cut within a number", (good(12) + "12,12.1").into()),
        ("open quote", b"a_deg,dr_um\n0,\"1\n10,2\n20,3\n".into()),
        ("one angle several times", b"a_deg,dr_um\n0,1\n-0,3\n0.0,2\n".into()),
        ("degrees as radians", b"a_rad,dr_um\n0,1\n90,2\n180,3\n".into()),
        ("too few samples", b"a_deg,dr_um\n0,1\n".into()),
        ("header only", b"a_deg,dr_um\n".into()),
        ("absolute lengths", b"a_deg,dr_mm\n0,150.021\n10,150.019\n20,149.9\n".into()),
        ("absolute lengths in um", b"a_deg,dr_um\n0,150021\n10,150019\n".into()),
        ("one stray reading", b"a_deg,dr_um\n0,20.5\n10,-21.5e6\n20,22\n".into()),
        ("um as mm", b"a_deg,dr_mm\n0,20.5\n10,-21.5\n20,22\n".into()),
    ];
    let mut said = String::new();
    for (kind, contents) in files {
        let (_kept, path) = file(&contents);
        let error = Sweep::read(&path, "a", radius(), 2).expect_err(kind);
        writeln!(said, "{kind}\n{}{}\n", excerpt(&contents), message(&error)).unwrap();
    }
    let (kept, _) = file(b"");
    for (kind, path) in [("missing file", kept.path().join("none.csv")), ("directory", kept.path().to_owned())] {
        let error = Sweep::read(&path, "a", radius(), 2).expect_err(kind);
        let said_here = message(&error).replace(kept.path().file_name().unwrap().to_str().unwrap(), "directory");
        writeln!(said, "{kind}\n{said_here}\n").unwrap();
    }
    insta::assert_snapshot!(said);
}

#[test]
fn bad_tables() {
    let files = [
        ("two values", "a_deg,dya_um,dza_um\n10,1,2\n0,1,2\n10,1,3\n"),
        ("one node", "a_deg,dya_um,dza_um\n10,1,2\n10,1,2\n"),
        ("missing function", "a_deg,dya_um\n0,1\n10,2\n"),
        ("angle where a length belongs", "a_deg,dya_urad,dza_um\n0,1,2\n10,1,2\n"),
        ("a function nobody knows", "a_deg,dya_um,dza_um,dxa_um\n0,1,2,3\n10,1,2,3\n"),
    ];
    let mut said = String::new();
    for (kind, contents) in files {
        let (_kept, path) = file(contents.as_bytes());
        let error = Table::read(&path, "a", &lengths()).expect_err(kind);
        writeln!(said, "{kind}\n{}{}\n", excerpt(contents.as_bytes()), message(&error)).unwrap();
    }
    let (_kept, path) = file(b"a_deg,ex_urad\n0,1\n30,1\n90,2\n");
    let known = Table::read(&path, "a", &angles("ex")).unwrap();
    let run = Sweep::new(path.with_file_name("tilting.csv"), (0..10).map(|i| (f64::from(i * 20).to_radians(), 0.0)));
    let error = known.at_samples(&run).unwrap_err();
    assert!(matches!(&error.problem, FileProblem::OutsideTable { samples, .. } if samples.len() == 5));
    writeln!(said, "samples outside the range\n{}", message(&error)).unwrap();
    insta::assert_snapshot!(said);
}
