//! C99.

use crate::graph::Constant;

use super::function::{Form, Function};
use super::infix::{Dialect, Infix, WHOLE_TURNS, decimal};
use super::layout::listed;
use super::names::{Names, Rules};

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
    let names = Names::new(function, &identifier(&function.name), RULES);
    let writer = Infix { program: &function.program, names: &names, dialect: real };
    let kind = real.name();
    let mut text = String::from("/*\n");
    for line in function.documentation(&names.inputs) {
        text += format!(" * {}", line.replace("*/", "* /").replace("/*", "/ *")).trim_end();
        text.push('\n');
    }
    text += " */\n";
    let inputs = names.inputs.iter().map(|name| format!("{kind} {name}"));
    let results = names.outputs.iter().zip(&function.results).filter(|(_, (_, form))| form.len() > 0);
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
    let places = names.outputs.iter().zip(&function.results).flat_map(|(name, (_, form))| places(name, *form));
    let outputs = function.program.outputs().iter().zip(&function.elements);
    for (place, (&value, element)) in places.zip(outputs) {
        let comment = element.replace("*/", "* /").replace("/*", "/ *");
        let end = if place == comment { ";".to_owned() } else { format!("; /* {comment} */") };
        text += &writer.assigned(&format!("    {place}"), &writer.value(value), ["", ""], &end);
    }
    text += "}\n";
    text
}

/// What the printed functions call and C has not, if `source` calls it; goes before them once.
#[must_use]
pub fn support(source: &str, real: Precision) -> String {
    let (kind, called) = (real.name(), real.function(WHOLE_TURNS));
    if !source.contains(&format!("{called}(")) {
        return String::new();
    }
    let (floor, fabs, most) = (real.function("floor"), real.function("fabs"), real.pick("67108864.0", "4096.0f"));
    format!(
        "\n/* The largest whole number not above `turns`; NAN where half the digits of what is left over are lost. */\n\
         static {kind} {called}({kind} turns)\n{{\n    return {fabs}(turns) < {most} ? {floor}(turns) : NAN;\n}}\n"
    )
}

/// The names of a printed function's inputs.
pub(super) fn inputs(function: &Function) -> Vec<String> {
    Names::new(function, &identifier(&function.name), RULES).inputs
}

/// A name as C allows it.
pub(super) fn identifier(wanted: &str) -> String {
    let name = RULES.sanitised(wanted);
    if RESERVED.contains(&name.as_str()) { name + "_" } else { name }
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
}

impl Dialect for Precision {
    fn constant(&self, constant: &Constant) -> String {
        let beyond = match self {
            Precision::Double => constant.value().is_infinite(),
            Precision::Float => (constant.value() as f32).is_infinite(),
        };
        if beyond {
            return self.pick("HUGE_VAL", "HUGE_VALF").to_owned();
        }
        let number = match constant {
            Constant::Rational(r) => decimal(r),
            Constant::Pi => "3.14159265358979323846".to_owned(),
            Constant::Sqrt2 => "1.41421356237309504880".to_owned(),
        };
        match self {
            Precision::Double => number,
            Precision::Float if number.contains(" / ") => format!("(float)({number})"),
            Precision::Float => format!("{number}f"),
        }
    }

    fn function(&self, name: &'static str) -> String {
        match self {
            Precision::Double => name.to_owned(),
            Precision::Float => format!("{name}f"),
        }
    }
}

const RULES: Rules = Rules { lower_case: false, places: true, reserved: RESERVED };

/// Keywords, the functions that are called, and the math library's short names that compilers warn about.
const RESERVED: &[&str] = &[
    "auto",
    "break",
    "case",
    "char",
    "const",
    "continue",
    "default",
    "do",
    "double",
    "else",
    "enum",
    "extern",
    "float",
    "for",
    "goto",
    "if",
    "inline",
    "int",
    "long",
    "register",
    "restrict",
    "return",
    "short",
    "signed",
    "sizeof",
    "static",
    "struct",
    "switch",
    "typedef",
    "union",
    "unsigned",
    "void",
    "volatile",
    "while",
    "asm",
    "sin",
    "cos",
    "sqrt",
    "atan2",
    "floor",
    "floorf",
    "fabs",
    "fabsf",
    "whole_turns",
    "whole_turnsf",
    "sinf",
    "cosf",
    "sqrtf",
    "atan2f",
    "main",
    "errno",
    "gamma",
    "j0",
    "j1",
    "jn",
    "y0",
    "y1",
    "yn",
    "HUGE_VAL",
    "HUGE_VALF",
    "INFINITY",
    "NAN",
];
