//! High harmonics in numbers: a table whose reading is known in closed form, as tape, in f64.

use super::numbers::uniform;
use std::f64::consts::TAU;
use trunnion_codegen::emit::model;
use trunnion_codegen::graph::Tape;
use trunnion_codegen::identify::{Derivation, derive};
use trunnion_codegen::model::{Model, read};

/// Distance of the ball from the table's axis, mm.
const L: f64 = 137.0;

/// A table that turns `gear` times as fast as the sweep, seen from a direction that turns `seen` times as fast.
fn table(harmonics: u8, gear: i32, seen: i32) -> (Model, Derivation) {
    let error = |axis: &str, letter: &str| format!("{letter}{axis} = \"zero\"\n");
    let rest = |axis| ["EX", "EY", "EZ", "EA", "EB", "EC"].map(|letter| error(axis, letter)).concat();
    let zero = ["C", "X", "Y"].map(rest).concat().replace("ECC = \"zero\"\n", "");
    let source = format!(
        r#"name = "table"
constants = ["L"]
workpiece = ["C"]
tool = ["X", "Y"]
estimate = ["ECC"]
[axis.C]
rotary = "z"
[axis.X]
linear = "x"
[axis.Y]
linear = "y"
[run.turn]
sweep = "t"
at = {{ C = "{gear}*t", X = "L*cos({gear}*t)", Y = "L*sin({gear}*t)" }}
workpiece_ball = {{ at = ["L", "0", "0"] }}
tool_ball = {{}}
reading = {{ displacement = ["cos({seen}*t)", "sin({seen}*t)", "0"] }}
[function]
ECC = {{ fourier = {harmonics} }}
{zero}"#
    );
    let model = read(&source).unwrap_or_else(|problems| panic!("{problems:?}"));
    let derivation = derive(&model).unwrap();
    (model, derivation)
}

/// The factors of ECC's coefficients up to a common sign: the tangent (−sin gt, cos gt) seen along (cos pt, sin pt) is
/// sin (p − g)t, and the function's argument is the axis' angle gt.
fn expected(name: &str, gear: i32, seen: i32, t: f64) -> f64 {
    let arm = L * (f64::from(seen - gear) * t).sin();
    let (kind, harmonic) = name.strip_prefix("ECC_").unwrap().split_at(3);
    let angle = harmonic.parse::<f64>().unwrap() * f64::from(gear) * t;
    arm * if kind == "cos" { angle.cos() } else { angle.sin() }
}

const TABLES: [(u8, i32, i32); 9] =
    [(8, 1, 5), (8, 2, 1), (8, 5, 4), (6, 6, 3), (8, 8, 7), (8, -8, 9), (5, 12, 11), (3, 20, 13), (1, 60, 59)];

fn sweeps() -> Vec<f64> {
    uniform(7, 0.0, TAU, 200)
}

#[test]
fn regressors_have_the_digits_of_sines_of_multiples() {
    for (harmonics, gear, seen) in TABLES {
        let (model, derivation) = table(harmonics, gear, seen);
        let function = model::run(&model, &derivation, 0.into()).unwrap();
        let tape = Tape::new(function.program());
        let (mut evaluator, mut row) = (tape.evaluator(), vec![0.0; usize::from(harmonics) * 2]);
        for t in sweeps() {
            evaluator.evaluate(&[L, t], &mut row).unwrap();
            for (value, (base, _)) in row.iter().zip(&derivation.runs.raw[0].regressors) {
                let name = &derivation.base[*base].name;
                let exact = expected(name, gear, seen, t);
                let off = (value - exact).abs().min((value + exact).abs()) / L;
                assert!(off < 1e-12, "{name} of gear {gear} at {t}: {value} instead of {exact}, {off:e}");
            }
        }
    }
}
