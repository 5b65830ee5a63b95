//! Names that a language allows, no two alike.

use rustc_hash::FxHashSet;

use crate::graph::{Constant, Step, Value};

use super::function::Function;

/// What a language asks of a local name.
#[derive(Clone, Copy)]
pub(super) struct Rules {
    pub lower_case: bool,
    /// Results are written to parameters; else each element is a variable.
    pub places: bool,
    pub reserved: &'static [&'static str],
}

/// Names for everything in a function; steps that are no temporaries have none.
pub(super) struct Names {
    pub function: String,
    pub inputs: Vec<String>,
    pub constants: Vec<String>,
    pub steps: Vec<Option<String>>,
    /// A name for each result where they are places, else for each element.
    pub outputs: Vec<String>,
}

impl Names {
    pub(super) fn new(function: &Function, rules: Rules) -> Self {
        let program = &function.program;
        let mut pool = Pool { rules, taken: FxHashSet::default() };
        let function_name = pool.claim(&function.name);
        let inputs: Vec<_> = program.inputs().iter().map(|input| pool.claim(input)).collect();
        // What is returned keeps its name; temporaries make way.
        let outputs = match function.results.as_slice() {
            _ if !rules.places => function.elements.iter().map(|element| pool.claim(element)).collect(),
            [_] => vec![pool.claim("out")],
            several => several.iter().map(|(name, _)| pool.claim(name)).collect(),
        };
        let constants = program.constants().iter().map(|constant| pool.claim(&constant_name(constant))).collect();
        let mut steps = vec![None; program.steps().len()];
        let mut numbers = 1..;
        for (at, step) in program.temporaries() {
            steps[at] = angle_name(step, &inputs).or_else(|| Some(format!("t{}", numbers.next()?)));
            steps[at] = steps[at].as_deref().map(|name| pool.claim(name));
        }
        Names { function: function_name, inputs, constants, steps, outputs }
    }
}

fn constant_name(constant: &Constant) -> String {
    match constant {
        Constant::Pi => "pi".to_owned(),
        Constant::Sqrt2 => "sqrt_2".to_owned(),
        Constant::Rational(r) if r.is_integer() => format!("n{}", r.numer()),
        Constant::Rational(r) => format!("n{}_{}", r.numer(), r.denom()),
    }
}

/// The sine and cosine of an input are called after it.
fn angle_name(step: Step, inputs: &[String]) -> Option<String> {
    let (function, angle) = match step {
        Step::Sin(angle) => ("sin", angle),
        Step::Cos(angle) => ("cos", angle),
        _ => return None,
    };
    match angle {
        Value::Input(at) => Some(format!("{function}_{}", inputs.get(at as usize)?)),
        _ => Some(function.to_owned()),
    }
}

struct Pool {
    rules: Rules,
    taken: FxHashSet<String>,
}

impl Pool {
    /// `wanted` or the next free name like it.
    fn claim(&mut self, wanted: &str) -> String {
        let plain = self.rules.sanitised(wanted);
        let mut name = plain.clone();
        let mut number = 2;
        while self.rules.reserved.contains(&name.as_str()) || self.taken.contains(&name) {
            name = format!("{plain}_{number}");
            number += 1;
        }
        self.taken.insert(name.clone());
        name
    }
}

impl Rules {
    pub(super) fn sanitised(self, wanted: &str) -> String {
        let allowed = wanted.chars().map(|c| match c {
            c if !c.is_ascii_alphanumeric() => '_',
            c if self.lower_case => c.to_ascii_lowercase(),
            c => c,
        });
        let name: String = allowed.collect();
        // Leading underscores mean "unused" or "reserved" in the languages written here.
        match name.trim_start_matches('_') {
            "" => "x".to_owned(),
            rest if rest.starts_with(|c: char| c.is_ascii_digit()) => format!("x{rest}"),
            rest => rest.to_owned(),
        }
    }
}
