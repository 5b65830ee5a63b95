//! A measurement described by a project file, with the program as its user meets it.

mod program;

use program::{succeeds, trunnion};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn refused(directory: &Path, arguments: &[&str]) -> String {
    let output = trunnion(directory, arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

const PROJECT: &str = "\
model = \"tilting-table-a\"

[lengths]
R_mm = 100

[limits]
angle_urad = 50

[instrument]
preset = \"QC20-W\"

[axis.A]
range = [-30, 120]

[fit]
estimator = \"two-step\"
table = \"readings/table.csv\"

[run.tilting]
files = [\"readings/tilting.csv\"]
weight = 2

[run.separation]
files = [\"readings/separation.csv\"]
";

const OPTIONS: [&str; 20] = [
    "fit",
    "tilting-table-a",
    "--radius",
    "100",
    "--angle-urad",
    "50",
    "--instrument",
    "QC20-W",
    "--estimator",
    "two-step",
    "--table",
    "readings/table.csv",
    "--run",
    "tilting=readings/tilting.csv",
    "--weight",
    "tilting=2",
    "--run",
    "separation=readings/separation.csv",
    "--weight",
    "separation=1",
];

fn project() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("trunnion.toml"), PROJECT).unwrap();
    succeeds(directory.path(), &["simulate", "--out", "readings"]);
    directory
}

#[test]
fn without_options_a_project_is_fitted_as_with_them() {
    let directory = project();
    let readings = fs::read_to_string(directory.path().join("readings/tilting.csv")).unwrap();
    let angles: Vec<f64> = readings.lines().filter_map(|line| line.split(',').next()?.parse().ok()).collect();
    assert!(angles.iter().all(|a| (-30.0..=120.0).contains(a)), "the axis' range is the project's");
    let fitted = succeeds(directory.path(), &["fit"]);
    assert_eq!(fitted, succeeds(directory.path(), &OPTIONS));
    // From elsewhere its files are where it is; by its folder as by its name.
    let elsewhere = tempfile::tempdir().unwrap();
    let (folder, file) = (directory.path().to_str().unwrap(), directory.path().join("trunnion.toml"));
    assert_eq!(fitted, succeeds(elsewhere.path(), &["fit", folder]));
    assert_eq!(fitted, succeeds(elsewhere.path(), &["fit", file.to_str().unwrap()]));
    // An option is put over it.
    assert_ne!(fitted, succeeds(directory.path(), &["fit", "--estimator", "joint"]));
    assert!(succeeds(directory.path(), &["derive"]).contains("tilting-table-a"));
}

#[test]
fn runs_that_are_given_stand_alone() {
    let directory = project();
    let out = trunnion(directory.path(), &["fit", "--estimator", "joint", "--run", "tilting=readings/tilting.csv"]);
    let told = String::from_utf8(out.stderr).unwrap();
    assert!(told.contains("fitted without separation"), "{told}");
}

#[test]
fn what_is_wrong_is_told_where_it_is() {
    let directory = project();
    let cases = [
        ("R_mm = 100", "R_mm = \"long\"", "trunnion.toml:4:8"),
        ("[axis.A]", "[axis.Q]", "trunnion.toml:12:7"),
        ("angle_urad = 50", "nothing_urad = 50", "trunnion.toml:7:1"),
        ("weight = 2", "weight = 0", "trunnion.toml: line 21: weight = 0.0"),
        ("estimator = \"two-step\"", "estimator = \"both\"", "trunnion.toml: line 16: unknown variant"),
        ("[run.separation]", "[run.other]", "the model has no run `other`"),
        ("tilting.csv", "absent.csv", "readings/absent.csv: "),
        ("model = \"tilting-table-a\"", "model = \"no-table\"", "no model `no-table`"),
    ];
    for (right, wrong, told) in cases {
        fs::write(directory.path().join("trunnion.toml"), PROJECT.replace(right, wrong)).unwrap();
        let message = refused(directory.path(), &["fit"]);
        assert!(message.contains(told), "{wrong}: {message}");
    }
    let empty = tempfile::tempdir().unwrap();
    assert!(refused(empty.path(), &["fit"]).contains("no MODEL, and no trunnion.toml in this folder"));
    assert!(refused(empty.path(), &["fit", "tilting-table-a"]).contains("no run"));
}

/// The blocks of a way: coordinates of A, Y and Z, and what each block's feed says.
fn blocks(program: &str, begins: &str) -> Vec<([f64; 3], String)> {
    let word = |line: &str, axis: &str| -> Option<f64> {
        let word = line.split_whitespace().find_map(|word| word.strip_prefix(axis))?;
        word.trim_start_matches('=').parse().ok()
    };
    let straight = |line: &str| {
        let line = line.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ');
        let at = [word(line, "A")?, word(line, "Y")?, word(line, "Z")?];
        let feed = line.split_whitespace().last().filter(|word| word.starts_with('F')).unwrap_or_default();
        line.starts_with(begins).then(|| (at, feed.to_owned()))
    };
    program.lines().filter_map(straight).collect()
}

/// The fourth axis of the cone is given by its sine and cosine, and goes round: it does not turn back by a whole turn in a block.
#[test]
fn an_axis_goes_on_beyond_half_a_turn() {
    let directory = tempfile::tempdir().unwrap();
    succeeds(directory.path(), &["new", "ac-trunnion-cone", "--out", "cone"]);
    let program = fs::read_to_string(directory.path().join("cone/cone.linuxcnc.ngc")).unwrap();
    let c = |line: &str| line.split(' ').find_map(|word| word.strip_prefix('C')?.parse::<f64>().ok());
    let (way, _) = program.split_once("and back").unwrap();
    let turned: Vec<f64> = way.lines().filter(|line| line.starts_with("G1")).filter_map(c).collect();
    let steps = turned.windows(2).map(|two| (two[1] - two[0]).abs());
    assert!(turned.len() > 1000 && steps.fold(0.0, f64::max) < 2.0);
    let [first, last] = [0, turned.len() - 1].map(|at| turned[at]);
    assert!((first - last - 360.0).abs() < 20.0, "once round, and 5° beyond either end: {first} to {last}");
}

#[test]
fn a_new_folder_has_all_that_a_measurement_needs() {
    let directory = tempfile::tempdir().unwrap();
    let new = ["new", "tilting-table-a", "--range", "A=-30:120", "--out", "m", "--overshoot", "0"];
    succeeds(directory.path(), &new);
    let folder = directory.path().join("m");
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert!(refused(directory.path(), &new).contains("--force"), "what a person may have edited stays");

    // Every program takes the same path: there and back on the circle of the bar, 1.5 mm beyond it at its ends.
    let programs = [
        ("linuxcnc.ngc", "G1", 1e-5),
        ("sinumerik.mpf", "G1", 1e-5),
        ("heidenhain.h", "L", 1e-4),
        ("fanuc.nc", "G1", 1e-4),
    ];
    for (name, begins, digits) in programs {
        let mut blocks = blocks(&read(&format!("tilting.{name}")), begins);
        // The approach of Heidenhain is of the same form.
        blocks.retain(|(_, feed)| feed != "FMAX");
        assert_eq!(blocks.len() % 2, 0, "{name}");
        let ways = blocks.split_at(blocks.len() / 2);
        for (way, [first, last]) in [(ways.0, [-30.0, 120.0]), (ways.1, [120.0, -30.0])] {
            let radius = |[_, y, z]: [f64; 3]| y.hypot(z);
            // The ball on the table turns with it, from (R, R).
            let bar = |[a, y, z]: [f64; 3]| {
                let (sin, cos) = a.to_radians().sin_cos();
                (y - 150.0 * (cos - sin)).hypot(z - 150.0 * (sin + cos))
            };
            let (out, path) = way.split_last().unwrap();
            assert!((bar(out.0) - 151.5).abs() < 2.0 * digits, "{name}: the bar is lengthened at the end");
            assert_eq!([path[0].0[0], path[path.len() - 1].0[0]], [first, last], "{name}");
            for (at, _) in path {
                let (sin, cos) = at[0].to_radians().sin_cos();
                // The angle is rounded as well.
                let off = (at[1] - 150.0 * cos).abs().max((at[2] - 150.0 * sin).abs());
                assert!(off < 0.51 * digits * (1.0 + 150f64.to_radians()), "{name}: {at:?}");
            }
            for two in path.windows(2) {
                let middle = std::array::from_fn(|i| (two[0].0[i] + two[1].0[i]) / 2.0);
                assert!(150.0 - radius(middle) < 1e-4 + 2.0 * digits, "{name}: the chord is within 0.1 µm");
            }
            // After the feed-in, all blocks take the same time: a minute has 360° of them.
            let step = 150.0 / (path.len() - 1) as f64;
            if begins == "G1" {
                let feed = format!("F{:.4}", 360.0 / step);
                assert!(path[1..].iter().all(|(_, own)| *own == feed), "{name}");
            }
        }
    }

    let plan = read("measuring-plan.md");
    for said in
        ["| eps_xa |", "°/µm", "### 1. tilting", "sweep -30.0° to 120.0°", "`separation-back.csv`", "A about +x"]
    {
        assert!(plan.contains(said), "{said}: {plan}");
    }

    // With readings under the names that it says, the folder is fitted as it is.
    succeeds(&folder, &["simulate", "--out", "../readings"]);
    for run in ["tilting", "separation"] {
        let readings = fs::read_to_string(directory.path().join(format!("readings/{run}.csv"))).unwrap();
        let lines: Vec<&str> = readings.lines().collect();
        let back: Vec<&str> = lines[..1].iter().chain(lines[1..].iter().rev()).copied().collect();
        fs::write(folder.join(format!("{run}-there.csv")), &readings).unwrap();
        fs::write(folder.join(format!("{run}-back.csv")), back.join("\n") + "\n").unwrap();
    }
    let fitted = succeeds(&folder, &["fit"]);
    assert!(fitted.contains("e_xa") || fitted.contains("eps_xa"), "{fitted}");

    // What follows from the project is written anew, in its folder or elsewhere: the project and its readings stay.
    assert!(refused(&folder, &["new"]).contains("--force"));
    let before = read("trunnion.toml").replace("120", "110").replace("tilting-there", "mine");
    fs::write(folder.join("trunnion.toml"), &before).unwrap();
    succeeds(&folder, &["new", "--force"]);
    let again = read("measuring-plan.md");
    assert!(again.contains("sweep -25.0° to 105.0°") && again.contains("`mine.csv` and `tilting-back.csv`"), "{again}");
    assert!(read("tilting.linuxcnc.ngc").contains("sweep -25.000 to 105.000"));
    assert_eq!(read("trunnion.toml"), before);
    assert!(folder.join("separation-there.csv").exists());
    succeeds(&folder, &["new", "--out", "elsewhere"]);
    assert_eq!(again, read("elsewhere/measuring-plan.md"));
    assert!(!folder.join("elsewhere/trunnion.toml").exists());
    assert!(refused(&folder, &["new", "tilting-table-a"]).contains("no --out"));
}

#[test]
fn the_valuation_number_is_the_function_s_standard_deviation_for_a_micrometre() {
    let directory = tempfile::tempdir().unwrap();
    succeeds(directory.path(), &["new", "tilting-table-a", "--out", "m"]);
    let plan = fs::read_to_string(directory.path().join("m/measuring-plan.md")).unwrap();
    let told: f64 = plan.split("| eps_xa | ").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok()).unwrap();
    // Scatter of the fits of readings that are noise of 1 µm alone.
    let setup = trunnion::Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let function = setup.estimated().next().unwrap();
    let points: Vec<f64> = (0..72).map(|i| f64::from(5 * i).to_radians()).collect();
    let mut squares = vec![0.0; points.len()];
    let trials = 2000;
    for seed in 0..trials {
        let limits = trunnion::study::ErrorLimits { length: 0.0, angle: 0.0 };
        let noise_um = 3f64.sqrt();
        let simulation = trunnion::study::Simulation { seed, samples: 360, noise_um, limits, range_deg: (0.0, 360.0) };
        let observations = simulation.measure(&setup).observations.raw;
        let fit = trunnion::study::fit(&setup, &observations, trunnion::Estimator::Joint).unwrap();
        squares.iter_mut().zip(&points).for_each(|(s, x)| *s += fit.function(&setup, function, *x).0.powi(2));
    }
    let scatter = squares.into_iter().fold(0.0, f64::max) / f64::from(trials as u32);
    assert!((told / scatter.sqrt().to_degrees() - 1.0).abs() < 0.06, "{told} against {}", scatter.sqrt().to_degrees());
}

#[test]
fn shells_and_readers_are_served() {
    let directory = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(succeeds(directory.path(), &["completions", shell]).contains("monte-carlo"), "{shell}");
    }
    succeeds(directory.path(), &["man", "--out", "man"]);
    let page = fs::read_to_string(directory.path().join("man/trunnion-exechon-ring.1")).unwrap();
    assert!(page.contains("stylus"), "{page}");
    for page in fs::read_dir(directory.path().join("man")).unwrap() {
        let page = fs::read_to_string(page.unwrap().path()).unwrap();
        assert!(page.contains("130  interrupted") && !page.contains("help(1)"), "{page}");
    }
    for command in [&["--help"][..], &["fit", "--help"], &["exechon", "ring", "--help"]] {
        assert!(succeeds(directory.path(), command).contains("130  interrupted"), "{command:?}");
    }
    let range = ["simulate", "tilting-table-a", "--samples", "4"];
    let of = |more: &[&str], out: &str| {
        succeeds(directory.path(), &[&range[..], more, &["--out", out]].concat());
        fs::read_to_string(directory.path().join(out).join("tilting.csv")).unwrap()
    };
    assert_eq!(of(&["--range-deg", "-20:200"], "a"), of(&["--from-deg", "-20", "--to-deg", "200"], "b"));
}
