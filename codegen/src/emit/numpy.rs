//! Python with NumPy: inputs are numbers or arrays that broadcast together.

use crate::graph::Constant;

use super::code::{Dialect, Writer, decimal};
use super::function::{Function, Shape};
use super::names::{Names, Rules};

/// `import numpy as np`, which the functions of a file need once.
pub const IMPORTS: &str = "import numpy as np\n";

/// `def name(R, a)`. A scalar output has the inputs' shape; an array or matrix has its own axes before those. Several
/// outputs are returned as a tuple.
#[must_use]
pub fn function(function: &Function) -> String {
    let names = Names::new(function, Rules { lower_case: false, places: false, reserved: RESERVED });
    let writer = Writer { program: &function.program, names: &names, dialect: NumPy };
    let mut text = format!("def {}({}):\n", names.function, names.inputs.join(", "));
    text += "    \"\"\"";
    for (at, line) in function.documentation().enumerate() {
        let line = line.replace('\\', "\\\\").replace('"', "'");
        text += if at > 0 && !line.is_empty() { "    " } else { "" };
        text += &line;
        text.push('\n');
    }
    text += "    \"\"\"\n";
    for (at, _) in function.program.temporaries() {
        if let Some(name) = &names.steps[at] {
            text += &format!("    {name} = {}\n", writer.step(at));
        }
    }
    for (name, &value) in names.outputs.iter().zip(function.program.outputs()) {
        text += &format!("    {name} = {}\n", writer.value(value));
    }
    if function.results.iter().any(|(_, shape)| *shape != Shape::Scalar) {
        let shapes: Vec<_> = names.inputs.iter().map(|input| format!("np.shape({input})")).collect();
        text += &format!("    shape = np.broadcast_shapes({})\n", shapes.join(", "));
    }
    let mut elements = names.outputs.iter();
    let results: Vec<String> = function
        .results
        .iter()
        .map(|(_, shape)| {
            let own: String = elements.by_ref().take(shape.len()).map(|name| format!("{name}, ")).collect();
            // An element that is constant takes the inputs' shape too.
            let stack = format!("np.array([np.broadcast_to(k, shape) for k in ({})])", own.trim_end());
            match shape {
                Shape::Scalar => own.trim_end_matches(", ").to_owned(),
                Shape::Array(n) => format!("{stack}.reshape({n}, *shape)"),
                Shape::Matrix(rows, columns) => {
                    format!("{stack}.reshape({rows}, {columns}, *shape)")
                }
            }
        })
        .collect();
    text += &format!("    return {}\n", results.join(", "));
    text
}

struct NumPy;

impl Dialect for NumPy {
    fn constant(&self, constant: &Constant) -> String {
        match constant {
            Constant::Rational(r) => decimal(r),
            Constant::Pi => "np.pi".to_owned(),
            Constant::Sqrt2 => "1.4142135623730951".to_owned(),
        }
    }

    fn function(&self, name: &'static str) -> String {
        format!("np.{name}")
    }
}

const RESERVED: &[&str] = &[
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del",
    "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal",
    "not", "or", "pass", "raise", "return", "try", "while", "with", "yield", "np", "shape", "k",
];
