//! Names that a language allows, no two alike in one scope.

mod words;

pub(super) use words::{C, HAL, HEADERS, MODULES, PYTHON, RUST, Words};

use num_traits::One;
use rustc_hash::FxHashSet;

use crate::graph::{Constant, Step, Value};

use super::function::Function;

/// What a language asks of a name.
#[derive(Clone, Copy)]
pub(super) struct Rules {
    /// Names of functions, inputs and variables are written in lower case.
    pub lower_case: bool,
    /// Results are written to parameters; else each element is a variable.
    pub places: bool,
    /// What the language, its headers and the printed file itself use.
    pub words: &'static Words,
}

impl Rules {
    /// `wanted` as a name that the language could allow.
    pub fn sanitised(self, wanted: &str) -> String {
        let allowed = wanted.chars().map(|c| match c {
            c if !c.is_ascii_alphanumeric() => '_',
            c if self.lower_case => c.to_ascii_lowercase(),
            c => c,
        });
        // Two underscores in a row are the implementation's in C++, and no snake case in Rust.
        let name = allowed.fold(String::new(), |name, c| {
            if c == '_' && name.ends_with('_') { name } else { name + c.encode_utf8(&mut [0; 4]) }
        });
        // Leading underscores mean "unused" or "reserved" in the languages written here.
        match name.trim_start_matches('_') {
            "" => "x".to_owned(),
            rest if rest.starts_with(|c: char| c.is_ascii_digit()) => format!("x{rest}"),
            rest => rest.to_owned(),
        }
    }

    pub fn is_word(self, name: &str) -> bool {
        self.words.contains(name)
    }
}

/// Names that are taken in one scope.
#[derive(Clone)]
pub(super) struct Scope {
    rules: Rules,
    taken: FxHashSet<String>,
}

impl Scope {
    /// A scope in which `taken` are names already.
    pub fn new<S: AsRef<str>>(rules: Rules, taken: &[S]) -> Self {
        Self { rules, taken: taken.iter().map(|name| name.as_ref().to_owned()).collect() }
    }

    /// `wanted` as the language allows it, or the next free name like it.
    pub fn claim(&mut self, wanted: &str) -> String {
        self.claim_as(&self.rules.sanitised(wanted))
    }

    /// `wanted` as the language allows it in at most `most` characters, or the next free name like it.
    pub fn claim_within(&mut self, wanted: &str, most: usize) -> String {
        // Room for a number, where one is needed.
        const NUMBER: usize = 4;
        let plain = self.rules.sanitised(wanted);
        let fitting = abbreviated(&plain, most);
        match self.is_free(&fitting) {
            true => self.claim_as(&fitting),
            false => self.claim_as(&abbreviated(&plain, most.saturating_sub(NUMBER))),
        }
    }

    fn is_free(&self, name: &str) -> bool {
        !self.rules.is_word(name) && !self.taken.contains(name)
    }

    /// `plain`, which is a name, or the next free name like it.
    pub fn claim_as(&mut self, plain: &str) -> String {
        let mut name = plain.to_owned();
        let mut number = 2;
        while !self.is_free(&name) {
            name = format!("{}_{number}", plain.trim_end_matches('_'));
            number += 1;
        }
        self.taken.insert(name.clone());
        name
    }
}

/// A name in at most `most` characters, as its longest words leave off: `c_displacement_far` in 10 is `c_disp_far`.
pub(super) fn abbreviated(name: &str, most: usize) -> String {
    let mut words: Vec<&str> = name.split('_').collect();
    while words.iter().map(|word| word.len()).sum::<usize>() + words.len().saturating_sub(1) > most {
        match words.iter_mut().filter(|word| word.len() > 1).max_by_key(|word| word.len()) {
            Some(longest) => *longest = &longest[..longest.len() - 1],
            None => drop(words.pop()),
        }
    }
    words.join("_")
}

/// Names for everything in a function; steps that are no temporaries have none.
pub(super) struct Names {
    pub function: String,
    pub inputs: Vec<String>,
    pub constants: Vec<String>,
    pub steps: Vec<Option<String>>,
    /// A name for each result where they are places, else for each element.
    pub outputs: Vec<String>,
    /// A name for each result as a whole.
    pub results: Vec<String>,
}

impl Names {
    /// Of a function that is `called` so in the scope `around` it.
    pub fn new(function: &Function, called: &str, around: &Scope) -> Self {
        let program = &function.program;
        let rules = around.rules;
        let mut scope = around.clone();
        scope.taken.insert(called.to_owned());
        let inputs: Vec<_> = function.inputs.iter().map(|input| scope.claim(&input.name)).collect();
        // What is returned keeps its name; temporaries make way.
        let filled: Vec<&str> = function.filled().map(|(name, _)| name.as_str()).collect();
        let outputs = match filled.as_slice() {
            _ if !rules.places => function.elements.iter().map(|element| scope.claim(element)).collect(),
            [_] => vec![scope.claim("out")],
            several => several.iter().map(|name| scope.claim(name)).collect(),
        };
        let constants = program.constants().iter().map(|constant| scope.claim(&constant_name(constant))).collect();
        let mut steps = vec![None; program.steps().len()];
        let mut numbers = 1..;
        for (at, step) in program.temporaries() {
            steps[at] = angle_name(step, &inputs).or_else(|| Some(format!("t{}", numbers.next()?)));
            steps[at] = steps[at].as_deref().map(|name| scope.claim(name));
        }
        let results = function.results.iter().map(|(result, _)| scope.claim(result)).collect();
        Names { function: called.to_owned(), inputs, constants, steps, outputs, results }
    }
}

/// A rational is called by its digits, where they are few.
fn constant_name(constant: &Constant) -> String {
    const MOST: usize = 32;
    match constant {
        Constant::Pi => "pi".to_owned(),
        Constant::Sqrt2 => "sqrt_2".to_owned(),
        Constant::Rational(r) => {
            let (numer, denom) = (r.numer(), r.denom());
            let name = if denom.is_one() { format!("n{numer}") } else { format!("n{numer}_{denom}") };
            if name.len() > MOST { "n".to_owned() } else { name }
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit() {
        assert_eq!(abbreviated("separation", 10), "separation");
        assert_eq!(abbreviated("c_displacement_opposite_x", 13), "c_disp_oppo_x");
        assert_eq!(abbreviated("a_b_c_d_e_f", 3), "a_b");
        let mut scope = Scope::new::<&str>(Rules { lower_case: true, places: true, words: &HAL }, &[]);
        let claimed = ["along the way", "along-the-way", "along_the_ways", "for"].map(|w| scope.claim_within(w, 12));
        assert_eq!(claimed, ["alon_the_way", "al_th_wa", "al_th_wa_2", "for_2"]);
    }
}
