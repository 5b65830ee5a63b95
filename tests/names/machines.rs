//! Machines that are called by the words, every word in every role.

use std::collections::BTreeSet;
use trunnion_codegen::algebra::{Fraction, Poly, nominal_value};
use trunnion_codegen::emit;
use trunnion_codegen::emit::equations::{Printer, Style};
use trunnion_codegen::graph::Tape;
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Words that somebody means something by: of languages, headers, templates, other words' neighbours.
pub fn words() -> Vec<&'static str> {
    let table = include_str!("words.txt").lines().filter(|line| !line.starts_with('#'));
    table.flat_map(str::split_whitespace).collect()
}

pub const ROLES: [&str; 7] = ["constant", "run", "sweep", "axis", "estimated error", "known error", "set-up error"];
/// Words of a role in a machine.
const EACH: usize = 3;

/// Words that mean nothing.
pub const PLAIN: [[&str; EACH]; ROLES.len()] = [
    ["L1", "L2", "L3"],
    ["r1", "r2", "r3"],
    ["u", "v", "w"],
    ["A1", "A2", "A3"],
    ["p1", "p2", "p3"],
    ["q1", "q2", "q3"],
    ["h1", "h2", "h3"],
];

pub struct Machine {
    pub model: Model,
    pub derivation: Derivation,
    /// The words of each role.
    pub called: [[&'static str; EACH]; ROLES.len()],
    /// The runs' rows, then the estimated functions' bases.
    pub functions: Vec<Printed>,
}

/// A function, inputs for it, and what it must give.
pub struct Printed {
    pub inputs: Vec<Vec<f64>>,
    pub outputs: Vec<Vec<f64>>,
    /// How many regressors or functions of a basis, how many known functions.
    pub sizes: [usize; 2],
}

/// Tables that turn about z one upon the other, each in a run of its own at a radius of its own, and slides that follow the ball.
pub fn machines() -> Vec<Machine> {
    let words = words();
    let count = words.len().div_ceil(EACH);
    // Files are named after runs: no two of one machine may differ in case alone, as neighbours of this order do.
    let mut cases = words.clone();
    cases.sort_by_key(|word| word.to_lowercase());
    // A sweep is called like an axis: that is allowed. The others are far apart.
    let called = |m: usize| {
        let word = |shift: usize, i: usize| words[(m + count * i + shift) % words.len()];
        let run = core::array::from_fn(|i| cases[(m + count * i) % words.len()]);
        let roles = [0, 103, 103, 211, 307, 401].map(|shift| core::array::from_fn(|i| word(shift, i)));
        let [constants, sweeps, axes, estimated, known, setup] = roles;
        [constants, run, sweeps, axes, estimated, known, setup]
    };
    (0..count).map(|m| machine(m, called(m))).collect()
}

fn machine(number: usize, called: [[&'static str; EACH]; ROLES.len()]) -> Machine {
    let source = description(&format!("m{number}"), &called);
    let read = read_and_derive(&source);
    let (model, derivation) = read.unwrap_or_else(|p| panic!("{source}\n{}", render("", &source, &p, Colour::Off)));
    let functions = functions(&model, &derivation);
    Machine { model, derivation, called, functions }
}

pub fn description(name: &str, called: &[[&str; EACH]; ROLES.len()]) -> String {
    let [constants, runs, sweeps, axes, estimated, known, setup] = called;
    // Two are called like the C file's own.
    let own = [format!("{name}_fit"), format!("{}_UNKNOWNS", name.to_uppercase())];
    let lengths: Vec<&str> = constants.iter().copied().chain(own.iter().map(String::as_str)).collect();
    let mut out =
        format!("name = \"{name}\"\nconstants = {lengths:?}\nworkpiece = {axes:?}\ntool = [\"QX\", \"QY\"]\n");
    out += &format!("estimate = {estimated:?}\n[axis.QX]\nlinear = \"x\"\n[axis.QY]\nlinear = \"y\"\n");
    let mut functions = String::from("[function]\n");
    for slide in ["QX", "QY"] {
        ["EX", "EY", "EZ", "EA", "EB", "EC"].iter().for_each(|e| functions += &format!("{e}{slide} = \"zero\"\n"));
    }
    for i in 0..EACH {
        let (constant, run, sweep, axis) = (constants[i], runs[i], sweeps[i], axes[i]);
        out += &format!("[axis.{axis}]\nrotary = \"z\"\n");
        out += &format!("[run.{run}]\nsweep = \"{sweep}\"\nreading = {{ displacement = \"x\" }}\n");
        let others = axes.iter().filter(|other| **other != axis).map(|other| format!("{other} = \"0\""));
        let others = others.collect::<Vec<_>>().join(", ");
        out += &format!("at = {{ {axis} = \"{sweep}\", QX = \"{constant}*cos({sweep})\", ");
        out += &format!("QY = \"{constant}*sin({sweep})\", {others} }}\n");
        out += &format!("workpiece_ball = {{ at = [\"{constant}\", \"0\", \"0\"], setup = {setup:?} }}\n");
        functions += &format!("EC{axis} = {{ fourier = 1 }}\nEX{axis} = \"known\"\n");
        ["EY", "EZ", "EA", "EB"].iter().for_each(|e| functions += &format!("{e}{axis} = \"zero\"\n"));
    }
    out += "[names]\n";
    for i in 0..EACH {
        out += &format!("EC{axis} = \"{}\"\nEX{axis} = \"{}\"\n", estimated[i], known[i], axis = axes[i]);
    }
    out + &functions
}

/// Lengths in the order of the constants, no two in a simple ratio.
const LENGTHS: [f64; EACH + 2] = [150.0, 83.0, 61.7, 40.3, 29.9];
const AT: [f64; 2] = [0.37, -2.11];

fn functions(model: &Model, derivation: &Derivation) -> Vec<Printed> {
    let length = |name: &str| LENGTHS[model.alphabet.constants().position(|c| c == name).unwrap()];
    let inputs: Vec<Vec<f64>> = AT.iter().map(|&x| [LENGTHS.as_slice(), &[x]].concat()).collect();
    let rows = derivation.runs.iter().map(|run| {
        let outputs = AT.map(|x| {
            let value = |p: &Poly| p.evaluate(|id| nominal_value(id, &model.alphabet, x, &length), |_| 0.0);
            let quotient = |f: &Fraction| value(f.numerator()) / f.denominator().map_or(1.0, value);
            let regressors = run.regressors.iter().map(|(_, f)| quotient(f));
            regressors.chain(run.known.iter().map(|(_, p)| value(p))).collect()
        });
        let sizes = [run.regressors.len(), run.known.len()];
        Printed { inputs: inputs.clone(), outputs: outputs.into(), sizes }
    });
    let bases = emit::model::estimated(model, derivation).unwrap().into_iter().map(|estimated| {
        let tape = Tape::new(estimated.basis.program());
        let evaluated = |inputs: &Vec<f64>| {
            let mut outputs = vec![0.0; tape.outputs()];
            tape.evaluator().evaluate(inputs, &mut outputs).unwrap();
            outputs
        };
        let outputs = inputs.iter().map(evaluated).collect();
        Printed { inputs: inputs.clone(), outputs, sizes: [tape.outputs(), 0] }
    });
    rows.chain(bases).collect()
}

/// Asserts that no two things in a machine's equations have one name, in text or in LaTeX.
pub fn assert_unambiguous(machine: &Machine) {
    let Machine { model, derivation, .. } = machine;
    let alphabet = &model.alphabet;
    let mut names: Vec<String> = alphabet.nominals().map(|(id, _)| alphabet.nominal_name(id)).collect();
    names.extend(alphabet.errors().map(|(_, name, _)| name.to_owned()));
    let coefficients =
        derivation.parameters.iter().map(|p| p.name.clone()).filter(|name| alphabet.find_error(name).is_none());
    names.extend(coefficients);
    let own = |name: &String| derivation.parameters.iter().any(|p| p.name == *name);
    names.extend(derivation.base.iter().map(|b| b.name.clone()).filter(|name| !own(name)));
    let sweep = |name: &String| alphabet.find_sweep(name).is_some();
    names.extend(model.axes().map(|axis| axis.coordinate.clone()).filter(|name| !sweep(name)));
    let printer = Printer { alphabet, style: Style::Latex };
    let latex: BTreeSet<String> = names.iter().map(|name| printer.name(name)).collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{names:?}");
    assert_eq!(latex.len(), names.len(), "{names:?}\n{latex:?}");
}
