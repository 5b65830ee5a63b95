//! C99.

use crate::graph::Constant;
use crate::source::visible;

use super::function::{Form, Function};
use super::infix::{Dialect, Infix, WHOLE_TURNS, decimal};
use super::layout::listed;
use super::names::{C, Names, Rules, Scope};

/// The floating-point type of a generated function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Precision {
    /// `double`
    Double,
    /// `float`, with `sinf` and its kind
    Float,
}

/// `void name(double R, double a, double out[10])`: inputs by value, then an array, matrix or pointer for each output.
/// A function of one output calls it `out`. C has no empty arrays: an output without elements is left out.
#[must_use]
pub fn function(function: &Function, real: Precision) -> String {
    let mut file = Scope::new::<&str>(RULES, &[]);
    let called = file.claim(&function.name);
    function_in(&file, function, &called, &C99::alone(real))
}

/// A function that is `called` so in a file with other names.
pub(super) fn function_in(file: &Scope, function: &Function, called: &str, dialect: &C99) -> String {
    let names = Names::new(function, called, file);
    let writer = Infix { program: &function.program, names: &names, dialect };
    let kind = dialect.real.name();
    let mut text = String::from("/*\n");
    for line in function.documentation(&names.inputs) {
        text += format!(" * {}", commented(&line)).trim_end();
        text.push('\n');
    }
    text += " */\n";
    let inputs = names.inputs.iter().map(|name| format!("{kind} {name}"));
    let results = names.outputs.iter().zip(function.filled()).filter(|(_, (_, form))| form.len() > 0);
    let results = results.map(|(name, (_, form))| match form {
        Form::Array(n) => format!("{kind} {name}[{n}]"),
        Form::Matrix(rows, columns) => format!("{kind} {name}[{rows}][{columns}]"),
    });
    let mut parameters: Vec<_> = inputs.chain(results).collect();
    if parameters.is_empty() {
        parameters.push("void".to_owned());
    }
    text += &listed(&format!("void {}(", names.function), &parameters, ")\n{\n", 4);
    for (at, _) in function.program.temporaries() {
        if let Some(name) = &names.steps[at] {
            text += &writer.assigned(&format!("    const {kind} {name}"), &writer.step(at), ["", ""], ";");
        }
    }
    let unused = names.inputs.iter().zip(function.used()).filter(|(_, used)| !used);
    text.extend(unused.map(|(name, _)| format!("    (void){name};\n")));
    let places = names.outputs.iter().zip(function.filled()).flat_map(|(name, (_, form))| places(name, *form));
    let outputs = function.program.outputs().iter().zip(&function.elements);
    for (place, (&value, element)) in places.zip(outputs) {
        let comment = commented(element);
        let end = if place == comment { ";".to_owned() } else { format!("; /* {comment} */") };
        text += &writer.assigned(&format!("    {place}"), &writer.value(value), ["", ""], &end);
    }
    text += "}\n";
    text
}

/// What the printed functions call and C has not, if `source` calls it; goes before them once.
#[must_use]
pub fn support(source: &str, real: Precision) -> String {
    support_in(source, &C99::alone(real))
}

pub(super) fn support_in(source: &str, dialect: &C99) -> String {
    let (real, called) = (dialect.real, &dialect.whole_turns);
    if !source.contains(&format!("{called}(")) {
        return String::new();
    }
    let (kind, floor, fabs) = (real.name(), real.function("floor"), real.function("fabs"));
    let most = real.pick("67108864.0", "4096.0f");
    format!(
        "\n/* The largest whole number not above `turns`; NAN where half the digits of what is left over are lost. */\n\
         static {kind} {called}({kind} turns)\n{{\n    return {fabs}(turns) < {most} ? {floor}(turns) : NAN;\n}}\n"
    )
}

/// Text as it may stand in a comment.
pub(super) fn commented(text: &str) -> String {
    visible(text).replace("*/", "* /").replace("/*", "/ *")
}

fn places(name: &str, form: Form) -> Vec<String> {
    match form {
        Form::Array(n) => (0..n).map(|i| format!("{name}[{i}]")).collect(),
        Form::Matrix(rows, columns) => {
            (0..rows).flat_map(|r| (0..columns).map(move |c| format!("{name}[{r}][{c}]"))).collect()
        }
    }
}

impl Precision {
    pub(super) fn name(self) -> &'static str {
        self.pick("double", "float")
    }

    pub(super) fn pick(self, double: &'static str, float: &'static str) -> &'static str {
        match self {
            Precision::Double => double,
            Precision::Float => float,
        }
    }

    fn function(self, name: &str) -> String {
        format!("{name}{}", self.pick("", "f"))
    }
}

/// The words of a file.
pub(super) struct C99 {
    pub real: Precision,
    /// What whole turns are called.
    pub whole_turns: String,
}

impl C99 {
    /// Of functions that stand in a file of somebody else's.
    fn alone(real: Precision) -> Self {
        Self { real, whole_turns: real.function(WHOLE_TURNS) }
    }
}

impl Dialect for &C99 {
    fn constant(&self, constant: &Constant) -> String {
        let real = self.real;
        let beyond = match real {
            Precision::Double => constant.value().is_infinite(),
            Precision::Float => (constant.value() as f32).is_infinite(),
        };
        if beyond {
            return real.pick("HUGE_VAL", "HUGE_VALF").to_owned();
        }
        let number = match constant {
            Constant::Rational(r) => decimal(r),
            Constant::Pi => "3.14159265358979323846".to_owned(),
            Constant::Sqrt2 => "1.41421356237309504880".to_owned(),
        };
        match real {
            Precision::Double => number,
            Precision::Float if number.contains(" / ") => format!("(float)({number})"),
            Precision::Float => format!("{number}f"),
        }
    }

    fn function(&self, name: &'static str) -> String {
        if name == WHOLE_TURNS { self.whole_turns.clone() } else { self.real.function(name) }
    }
}

pub(super) const RULES: Rules = Rules { lower_case: false, places: true, words: &C };
