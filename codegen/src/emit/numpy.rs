//! Python with NumPy: inputs are numbers or arrays that broadcast together.

use crate::graph::{Constant, Unbound};
use crate::identify::Derivation;
use crate::model::Model;

use super::function::{Form, Function};
use super::header::header;
use super::infix::{Dialect, Infix, WHOLE_TURNS, decimal};
use super::layout::listed;
use super::model::functions;
use super::names::{Names, PYTHON, Rules, Scope};

/// `import numpy as np`, which the functions of a file need once.
pub const IMPORTS: &str = "import numpy as np\n";

/// What the printed functions call and NumPy has not, if `source` calls it; goes before them once.
#[must_use]
pub fn support(source: &str) -> &'static str {
    if source.contains(&format!("{WHOLE_TURNS}(")) { SUPPORT } else { "" }
}

const SUPPORT: &str = r#"

def whole_turns(turns):
    """The largest whole number not above `turns`; nan where half the digits of what is left over are lost."""
    whole = np.floor(turns)
    most = 2.0 ** ((np.finfo(whole.dtype).nmant + 1) // 2)
    return np.where(np.abs(turns) < most, whole, np.nan).astype(whole.dtype)
"#;

const RULES: Rules = Rules { lower_case: false, places: false, words: &PYTHON };

/// A long expression's.
const BRACKETS: [&str; 2] = [" (", "\n    )"];

/// A model as a Python module: names, what each run sees, the functions.
///
/// # Errors
/// As [`functions`].
pub fn model_source(model: &Model, derivation: &Derivation) -> Result<String, Unbound> {
    let functions = functions(model, derivation)?;
    let mut scope = Scope::new(RULES, &["NAMES"]);
    let called: Vec<String> = functions.iter().map(|f| scope.claim(&f.name)).collect();
    let quoted: Vec<String> = derivation.base.iter().map(|base| format!("\"{}\"", base.name)).collect();
    let mut text = header("#", &model.name) + IMPORTS;
    text += "\n# Names of the base parameters, the estimated functions' coefficients first.\n";
    text += &listed("NAMES = [", &quoted, "]\n", 4);
    for run in &derivation.runs {
        let seen: Vec<String> = run.regressors.iter().map(|(b, _)| b.to_string()).collect();
        let list = scope.claim_as(&RULES.sanitised(&run.name).to_uppercase());
        text += &format!("\n# Positions in NAMES of the base parameters that run `{}` sees.\n", run.name);
        text += &listed(&format!("{list} = ["), &seen, "]\n", 4);
    }
    let printed =
        functions.iter().zip(&called).map(|(function, called)| format!("\n\n{}", function_as(function, called)));
    let printed = printed.collect::<String>();
    Ok(text + support(&printed) + &printed)
}

/// `def name(R, a)`. An array or matrix has its own axes before those of the inputs. Several outputs are returned as a tuple.
#[must_use]
pub fn function(function: &Function) -> String {
    function_as(function, &Scope::new::<&str>(RULES, &[]).claim(&function.name))
}

fn function_as(function: &Function, called: &str) -> String {
    let names = Names::new(function, called, &Scope::new::<&str>(RULES, &[]));
    let writer = Infix { program: &function.program, names: &names, dialect: NumPy };
    let mut text = format!("def {}({}):\n", names.function, names.inputs.join(", "));
    text += "    \"\"\"";
    for (at, line) in function.documentation(&names.inputs).into_iter().enumerate() {
        let line = line.replace('\\', "\\\\").replace('"', "'");
        text += if at > 0 && !line.is_empty() { "    " } else { "" };
        text += &line;
        text.push('\n');
    }
    text += "    \"\"\"\n";
    for (at, _) in function.program.temporaries() {
        if let Some(name) = &names.steps[at] {
            text += &writer.assigned(&format!("    {name}"), &writer.step(at), BRACKETS, "");
        }
    }
    for (name, &value) in names.outputs.iter().zip(function.program.outputs()) {
        text += &writer.assigned(&format!("    {name}"), &writer.value(value), BRACKETS, "");
    }
    let shapes: Vec<_> = names.inputs.iter().map(|input| format!("np.shape({input})")).collect();
    text += &listed("    shape = np.broadcast_shapes(", &shapes, ")\n", 8);
    // Python's own numbers take the kind of the arrays beside them: of float32 becomes float32.
    let kinds: Vec<_> = names.inputs.iter().cloned().chain(["0.0".to_owned()]).collect();
    text += &listed("    dtype = np.result_type(", &kinds, ")\n", 8);
    let mut elements = names.outputs.iter();
    let mut results = Vec::new();
    for (name, (_, form)) in names.results.iter().zip(&function.results) {
        let own: Vec<String> = elements.by_ref().take(form.len()).cloned().collect();
        let sizes = match form {
            Form::Array(n) => n.to_string(),
            Form::Matrix(rows, columns) => format!("{rows}, {columns}"),
        };
        text += &listed(&format!("    {name} = ["), &own, "]\n", 8);
        // An element that is constant takes the inputs' shape and kind too.
        let start = format!("    {name} = np.array([np.broadcast_to(k, shape) for k in {name}], dtype)");
        text += &format!("{start}.reshape({sizes}, *shape)\n");
        results.push(name.clone());
    }
    text += &format!("    return {}\n", results.join(", "));
    text
}

struct NumPy;

impl Dialect for NumPy {
    fn constant(&self, constant: &Constant) -> String {
        match constant {
            Constant::Rational(_) if constant.value().is_infinite() => "np.inf".to_owned(),
            Constant::Rational(r) => decimal(r),
            Constant::Pi => "np.pi".to_owned(),
            Constant::Sqrt2 => "1.4142135623730951".to_owned(),
        }
    }

    fn function(&self, name: &'static str) -> String {
        if name == WHOLE_TURNS { name.to_owned() } else { format!("np.{name}") }
    }
}
