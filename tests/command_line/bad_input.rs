//! What the program says of bad input.

use super::{FIT, MODEL, RUNS, TABLE, simulated, text, trunnion};
use std::fmt::Write;
use std::fs;

/// A bad input: its title, what is done to the directory, the arguments.
struct Bad<'a> {
    title: &'a str,
    files: Vec<(&'a str, String)>,
    arguments: Vec<&'a str>,
}

fn fit_of<'a>(title: &'a str, files: Vec<(&'a str, String)>) -> Bad<'a> {
    Bad { title, files, arguments: [&FIT[..], &RUNS, &TABLE].concat() }
}

fn with<'a>(title: &'a str, arguments: &[&'a str]) -> Bad<'a> {
    Bad { title, files: Vec::new(), arguments: arguments.to_vec() }
}

/// A run of 24 samples, each line as `line` makes it from its angle and its text.
fn run_file(header: &str, line: impl Fn(i32, String) -> String) -> String {
    let lines = (0..24).map(|i| line(i, format!("{},{}.5", i * 15, i % 7)));
    format!("{header}\n{}\n", lines.collect::<Vec<_>>().join("\n"))
}

fn bad_inputs<'a>() -> Vec<Bad<'a>> {
    let tilting = |file: String| vec![("tilting.csv", file)];
    let both = |file: String| vec![("tilting.csv", file.clone()), ("separation.csv", file)];
    let at_line = |n: i32, bad: &'static str| {
        run_file("a_deg,dr_um", move |i, line| if i + 2 == n { bad.to_owned() } else { line })
    };
    let angles = |of: &dyn Fn(i32) -> f64| run_file("a_deg,dr_um", |i, _| format!("{:?},{}.5", of(i), i % 7));
    let radius = |title, value| with(title, &[&["fit", MODEL, "--radius", value][..], &RUNS, &TABLE].concat());
    let given = |title, runs: &[&'a str]| with(title, &[&FIT[..], runs, &TABLE].concat());
    let more = |title, more: &[&'a str]| with(title, &[&FIT[..], &RUNS, &TABLE, more].concat());
    let simulate = |title, more: &[&'a str]| with(title, &[&["simulate", MODEL, "--radius", "150"][..], more].concat());
    let [separation, tilting_run] = ["separation=separation.csv", "tilting=tilting.csv"];
    vec![
        given("missing file", &["--run", "tilting=none.csv", "--run", separation]),
        given("directory for a file", &["--run", "tilting=.", "--run", separation]),
        fit_of("missing column", tilting(run_file("a_deg", |i, _| i.to_string()))),
        fit_of("unknown column", tilting(run_file("a_deg,load", |_, line| line))),
        fit_of("missing unit", tilting(run_file("a,dr_um", |_, line| line))),
        fit_of("wrong unit", tilting(run_file("a_deg,dr_urad", |_, line| line))),
        fit_of("NaN", tilting(at_line(9, "105,NaN"))),
        fit_of("infinite", tilting(at_line(3, "15,-inf"))),
        fit_of("text in a number", tilting(at_line(25, "345,0.5um"))),
        fit_of("too few samples", tilting("a_deg,dr_um\n0,1\n90,2\n180,3\n".to_owned())),
        fit_of("empty file", tilting(String::new())),
        fit_of("cut short", tilting("a_deg,dr_um\n0,1.0\n90".to_owned())),
        fit_of("absolute lengths", tilting(run_file("a_deg,dr_mm", |i, _| format!("{},150.00{i}", i * 15)))),
        fit_of("micrometres called mm", tilting(run_file("a_deg,dr_mm", |i, _| format!("{},2{i}.5", i * 15)))),
        fit_of("degrees called radians", tilting(run_file("a_rad,dr_um", |_, line| line))),
        fit_of("an arc of 1e-6 degrees", both(angles(&|i| f64::from(i) * 1e-6 / 24.0))),
        fit_of("four places in six turns", both(angles(&|i| f64::from(i) * 90.0))),
        given("unknown run", &["--run", tilting_run, "--run", separation, "--run", "third=tilting.csv"]),
        given("run without a file", &["--run", "tilting", "--run", separation]),
        with("unknown model", &[&["fit", "tilting-table-z", "--radius", "150"][..], &RUNS].concat()),
        with("directory for a model", &[&["fit", ".", "--radius", "150"][..], &RUNS].concat()),
        with("data for a model", &[&["fit", "table.csv", "--radius", "150"][..], &RUNS].concat()),
        with("unknown model to derive", &["derive", "tilting-table-z"]),
        radius("radius 0", "0"),
        radius("radius negative", "-150"),
        radius("radius NaN", "NaN"),
        radius("radius 1e9", "1e9"),
        radius("radius in metres", "0.15"),
        radius("radius in words", "long"),
        more("bad weight", &["--weight", "tilting=0"]),
        more("weight without a number", &["--weight", "tilting"]),
        more("weight beyond use", &["--weight", "tilting=1e300"]),
        more("weight of an unknown run", &["--weight", "third=2"]),
        more("weight twice", &["--weight", "tilting=2", "--weight", "tilting=3"]),
        more("the bar's length twice", &["--set", "R=200"]),
        more("length of nothing", &["--set", "H=200"]),
        more("length without a number", &["--set", "H"]),
        fit_of("table not covering the run", vec![("table.csv", "a_deg,dya_um,dza_um\n0,0,0\n100,1,1\n".to_owned())]),
        fit_of("table with a missing column", vec![("table.csv", "a_deg,dya_um\n0,0\n360,1\n".to_owned())]),
        fit_of("table with two values", vec![("table.csv", "a_deg,dya_um,dza_um\n0,0,0\n0,1,0\n360,1,1\n".to_owned())]),
        more("missing table", &["--table", "none.csv"]).last_of("--table"),
        simulate("--out is a file", &["--out", "table.csv"]),
        simulate("--out under a file", &["--out", "table.csv/there"]),
        with("--out of demo is a file", &["demo", "--out", "table.csv"]),
        simulate("no samples", &["--out", "new", "--samples", "0"]),
        simulate("noise NaN", &["--out", "new", "--noise-um", "NaN"]),
        simulate("range backwards", &["--out", "new", "--from-deg", "90", "--to-deg", "10"]),
        with("Monte Carlo of too few samples", &["monte-carlo", MODEL, "--radius", "150", "--samples", "4"]),
        with("Monte Carlo of too short an arc", &["monte-carlo", MODEL, "--radius", "150", "--to-deg", "1e-6"]),
    ]
}

impl Bad<'_> {
    /// Keeps only the last of an option given twice.
    fn last_of(mut self, option: &str) -> Self {
        if let Some(at) = self.arguments.iter().position(|a| *a == option) {
            self.arguments.drain(at..at + 2);
        }
        self
    }
}

#[test]
fn bad_input_is_refused_with_file_line_and_remedy() {
    let good = simulated(&["--samples", "24"]);
    let mut said = String::new();
    for Bad { title, files, arguments } in bad_inputs() {
        let directory = tempfile::tempdir().unwrap();
        for file in ["tilting.csv", "separation.csv", "table.csv"] {
            fs::copy(good.path().join(file), directory.path().join(file)).unwrap();
        }
        for (file, contents) in files {
            fs::write(directory.path().join(file), contents).unwrap();
        }
        let output = trunnion(directory.path(), &arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{title}: {message}");
        assert!(output.stdout.is_empty(), "{title}: {}", text(&output.stdout));
        assert!(message.starts_with("error: ") && message.lines().count() > 1, "{title}: no remedy in {message}");
        assert!(!message.contains("panicked"), "{title}: {message}");
        assert_eq!(directory.path().read_dir().unwrap().count(), 3, "{title}: something is left behind");
        let _ = writeln!(said, "## {title}\n{}\n", message.trim_end());
    }
    insta::with_settings!({ snapshot_path => "../../snapshots", prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!("bad_input", said);
    });
}
