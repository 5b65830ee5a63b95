//! C99.

use crate::graph::Constant;

use super::code::{Dialect, Writer, decimal};
use super::function::{Function, Shape};
use super::names::{Names, Rules};

/// The floating-point type of a generated function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Real {
    /// `double`
    Double,
    /// `float`, with `sinf` and its kind
    Float,
}

/// `#include <math.h>`, which the functions of a file need once.
pub const INCLUDES: &str = "#include <math.h>\n";

/// `void name(double R, double a, double out[10])`: inputs by value, then an array, matrix or pointer for each output.
/// A function of one output calls it `out`. C has no empty arrays: an output without elements is left out.
#[must_use]
pub fn function(function: &Function, real: Real) -> String {
    let names = Names::new(function, RULES);
    let writer = Writer { program: &function.program, names: &names, dialect: real };
    let kind = real.name();
    let mut text = String::from("/*\n");
    for line in function.documentation() {
        text += format!(" * {}", line.replace("*/", "* /").replace("/*", "/ *")).trim_end();
        text.push('\n');
    }
    text += " */\n";
    let inputs = names.inputs.iter().map(|name| format!("{kind} {name}"));
    let results = names.outputs.iter().zip(&function.results).filter(|(_, (_, shape))| shape.len() > 0);
    let results = results.map(|(name, (_, shape))| match shape {
        Shape::Scalar => format!("{kind} *{name}"),
        Shape::Array(n) => format!("{kind} {name}[{n}]"),
        Shape::Matrix(rows, columns) => format!("{kind} {name}[{rows}][{columns}]"),
    });
    let mut parameters: Vec<_> = inputs.chain(results).collect();
    if parameters.is_empty() {
        parameters.push("void".to_owned());
    }
    text += &format!("void {}({})\n{{\n", names.function, parameters.join(", "));
    for (at, _) in function.program.temporaries() {
        if let Some(name) = &names.steps[at] {
            text += &format!("    const {kind} {name} = {};\n", writer.step(at));
        }
    }
    let unused = function.unused().map(|at| format!("    (void){};\n", names.inputs[at]));
    text.extend(unused);
    let places = names.outputs.iter().zip(&function.results).flat_map(|(name, (_, shape))| places(name, *shape));
    let outputs = function.program.outputs().iter().zip(&function.elements);
    for (place, (&value, element)) in places.zip(outputs) {
        let comment = element.replace("*/", "* /").replace("/*", "/ *");
        text += &format!("    {place} = {}; /* {comment} */\n", writer.value(value));
    }
    text += "}\n";
    text
}

/// The names of a printed function's inputs.
pub(super) fn inputs(function: &Function) -> Vec<String> {
    Names::new(function, RULES).inputs
}

/// A name as C allows it.
pub(super) fn identifier(wanted: &str) -> String {
    let name = RULES.sanitised(wanted);
    if RESERVED.contains(&name.as_str()) { name + "_" } else { name }
}

fn places(name: &str, shape: Shape) -> Vec<String> {
    match shape {
        Shape::Scalar => vec![format!("*{name}")],
        Shape::Array(n) => (0..n).map(|i| format!("{name}[{i}]")).collect(),
        Shape::Matrix(rows, columns) => {
            (0..rows).flat_map(|r| (0..columns).map(move |c| format!("{name}[{r}][{c}]"))).collect()
        }
    }
}

impl Real {
    pub(super) fn name(self) -> &'static str {
        self.pick("double", "float")
    }

    pub(super) fn pick(self, double: &'static str, float: &'static str) -> &'static str {
        match self {
            Real::Double => double,
            Real::Float => float,
        }
    }
}

impl Dialect for Real {
    fn constant(&self, constant: &Constant) -> String {
        let number = match constant {
            Constant::Rational(r) => decimal(r),
            Constant::Pi => "3.14159265358979323846".to_owned(),
            Constant::Sqrt2 => "1.41421356237309504880".to_owned(),
        };
        match self {
            Real::Double => number,
            Real::Float if number.contains(" / ") => format!("(float)({number})"),
            Real::Float => format!("{number}f"),
        }
    }

    fn function(&self, name: &'static str) -> String {
        match self {
            Real::Double => name.to_owned(),
            Real::Float => format!("{name}f"),
        }
    }
}

const RULES: Rules = Rules { lower_case: false, places: true, reserved: RESERVED };

/// Keywords, the functions that are called, and the math library's short names that compilers warn about.
const RESERVED: &[&str] = &[
    "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern", "float",
    "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed", "sizeof",
    "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "asm", "sin", "cos",
    "sqrt", "atan2", "sinf", "cosf", "sqrtf", "atan2f", "main", "errno", "gamma", "j0", "j1", "jn", "y0", "y1", "yn",
    "HUGE_VAL", "INFINITY", "NAN",
];
