//! Whole models as C99 and NumPy: compiled, run, and compared with the exact regressors' own values.

use super::numbers::{derived, millimetres, moving_with_the_feed, uniform, value_at};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use trunnion_codegen::algebra::{Fraction, Poly};
use trunnion_codegen::emit::model::motion;
use trunnion_codegen::emit::{c, c99, numpy};
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::Model;

/// One with known functions, one with √2, one with quotients of sums, one with displacements.
const MODELS: [&str; 5] =
    ["tilting-table-a", "nutating-table", "ac-head", "rotary-table-c-rtest", "tilting-table-a-dyz"];
const SAMPLES: usize = 40;

/// These, and one whose runs move with the feed.
fn models() -> impl Iterator<Item = (String, Model, Derivation)> {
    let with = |(name, (model, derivation)): (String, _)| (name, model, derivation);
    let own = MODELS.into_iter().map(|name| (name.to_owned(), derived(name)));
    own.chain([("with-the-feed".to_owned(), moving_with_the_feed("tilting-table-a"))]).map(with)
}

/// Values of the sweep, and which way it goes there.
fn places(run: RunId) -> Vec<(f64, f64)> {
    let sweeps = uniform(usize::from(run) as u64 + 1, -3.2, 3.2, SAMPLES);
    sweeps.into_iter().zip([1.0, -1.0].into_iter().cycle()).collect()
}

/// What a run's function takes besides the lengths: the sweep, then how axes move, at every sample.
fn inputs(model: &Model, run: RunId) -> Vec<Vec<f64>> {
    let at = |id| places(run).into_iter().map(|(sweep, way)| value_at(model, id, sweep, way)).collect();
    let [sweep, ..] = model.alphabet.sweep_symbols(model.runs[run].sweep);
    [sweep].into_iter().chain(motion(model, run)).map(at).collect()
}

/// What a run's function must return at one value of the sweep, each with the size of the terms that are added up.
fn expected(model: &Model, derivation: &Derivation, run: RunId, (sweep, way): (f64, f64)) -> Vec<[f64; 2]> {
    let nominal = |id| value_at(model, id, sweep, way);
    let value = |p: &Poly| p.evaluate(nominal, |_| 0.0);
    let size = |p: &Poly| {
        let term = |t: &(_, _)| value(&Poly::from_terms(vec![t.clone()]).unwrap()).abs();
        p.terms().iter().map(term).sum::<f64>()
    };
    let quotient = |f: &Fraction| {
        let below = f.denominator().map_or(1.0, value);
        [value(f.numerator()) / below, size(f.numerator()) / below.abs()]
    };
    let derived = &derivation.runs[run];
    let regressors = derived.regressors.iter().map(|(_, f)| quotient(f));
    regressors.chain(derived.known.iter().map(|(_, p)| [value(p), size(p)])).collect()
}

/// Compares rows of output, run after run, sample after sample.
fn compare(name: &str, model: &Model, derivation: &Derivation, printed: &str, what: &str) {
    let mut lines = printed.lines();
    for run in model.runs.keys() {
        for place in places(run) {
            let row: Vec<f64> = lines.next().unwrap().split_whitespace().map(|v| v.parse().unwrap()).collect();
            let expected = expected(model, derivation, run, place);
            assert_eq!(row.len(), expected.len(), "{name} {what} run {run}");
            for (i, (actual, [value, size])) in row.iter().zip(expected).enumerate() {
                // The sweep's sine and cosine may be off by one unit each, and regressors are products of some ten factors.
                let ulps = (actual - value).abs() / (size.max(f64::MIN_POSITIVE) * f64::EPSILON);
                assert!(ulps <= 8.0, "{name} {what} run {run} output {i}: {actual:e} is not {value:e}, {ulps} ulp");
            }
        }
    }
    assert_eq!(lines.next(), None);
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).to_owned()
}

/// The function's name in C and Python.
fn item(run: &str) -> String {
    run.replace('-', "_")
}

fn literals(values: &[f64]) -> String {
    values.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ")
}

#[test]
fn c99_of_whole_models() {
    for (name, model, derivation) in models() {
        let sources = c99::sources(&model, &derivation, c::Precision::Double).unwrap();
        let mut source = sources.single() + "\n#include <stdio.h>\n";
        source += "static void show(const double *o, int n)\n{\n    int i;\n";
        source += "    for (i = 0; i < n; i++) printf(\"%.17g \", o[i]);\n}\n";
        source += "int main(void)\n{\n    int i;\n    double o[200];\n    double k[200];\n    (void)k;\n";
        for (i, run) in derivation.runs.iter_enumerated() {
            source += "    {\n";
            let inputs = inputs(&model, i);
            for (at, values) in inputs.iter().enumerate() {
                writeln!(source, "        const double x{at}[{SAMPLES}] = {{{}}};", literals(values)).unwrap();
            }
            let places: String = (0..inputs.len()).map(|at| format!("x{at}[i], ")).collect();
            let constants: String = model.alphabet.constants().map(|c| format!("{:?}, ", millimetres(c))).collect();
            let known = if run.known.is_empty() { "" } else { ", k" };
            writeln!(source, "        for (i = 0; i < {SAMPLES}; i++) {{").unwrap();
            writeln!(source, "            {}_row_of_{}({constants}{places}o{known});", sources.prefix, item(&run.name))
                .unwrap();
            writeln!(source, "            show(o, {}); show(k, {});", run.regressors.len(), run.known.len()).unwrap();
            source += "            printf(\"\\n\");\n        }\n    }\n";
        }
        source += "    return 0;\n}\n";
        let (file, program) = (folder().join(format!("{name}.c")), folder().join(format!("{name}-c")));
        std::fs::write(&file, source).unwrap();
        let flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2"];
        let compiled = match Command::new("gcc").args(flags).arg(&file).arg("-o").arg(&program).arg("-lm").output() {
            Ok(compiled) => compiled,
            Err(error) => {
                assert!(std::env::var_os("CI").is_none(), "CI must have gcc: {error}");
                println!("skipped: no gcc");
                return;
            }
        };
        assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
        let printed = String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
        compare(&name, &model, &derivation, &printed, "C99");
    }
}

/// `PYTHON` names another interpreter than `python3`.
#[test]
fn numpy_of_whole_models() {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    if !Command::new(&python).args(["-c", "import numpy"]).output().is_ok_and(|run| run.status.success()) {
        assert!(std::env::var_os("CI").is_none(), "CI must have NumPy");
        println!("skipped: no NumPy");
        return;
    }
    for (name, model, derivation) in models() {
        let mut source = numpy::model_source(&model, &derivation).unwrap();
        source += "\n\ndef show(*results):\n    for row in np.vstack(results).T:\n";
        source += "        print(*[repr(float(value)) for value in row])\n\n\n";
        for (i, run) in derivation.runs.iter_enumerated() {
            let constants: String = model.alphabet.constants().map(|c| format!("{:?}, ", millimetres(c))).collect();
            let places: Vec<String> =
                inputs(&model, i).iter().map(|values| format!("np.array([{}])", literals(values))).collect();
            let call = format!("{}({constants}{})", item(&run.name), places.join(", "));
            writeln!(source, "assert all(0 <= at < len(NAMES) for at in {})", item(&run.name).to_uppercase()).unwrap();
            writeln!(source, "assert isinstance({call}, tuple)\nshow(*{call})").unwrap();
        }
        let file = folder().join(format!("{name}.py"));
        std::fs::write(&file, source).unwrap();
        let run = Command::new(&python).arg(&file).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        compare(&name, &model, &derivation, &String::from_utf8(run.stdout).unwrap(), "NumPy");
    }
}
