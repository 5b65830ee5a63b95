//! A function to be printed: its name, what it takes and what it gives.

use super::layout::{WIDTH, wrapped};
use crate::graph::{Graph, Id, Operations, Program, Symbol, Unbound, Value};
use crate::source::visible;

/// Something a function takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    pub(super) symbol: Symbol,
    /// As the model calls it; each language makes its own name of it.
    pub(super) name: String,
    /// What it is, with its unit; empty where the name says it.
    pub(super) meaning: String,
}

impl Input {
    /// An input of a model's function: `R`, "nominal length of the bar, mm".
    #[must_use]
    pub fn new(symbol: Symbol, name: &str, meaning: &str) -> Self {
        Self { symbol, name: name.to_owned(), meaning: meaning.to_owned() }
    }

    /// The variable.
    #[must_use]
    pub fn symbol(&self) -> Symbol {
        self.symbol
    }

    /// As the model calls it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The inputs of a function that comes from no model, [`Symbol::Input`] of 0, 1, …, by their names.
    #[must_use]
    pub fn all(names: &[&str]) -> Vec<Self> {
        (0..).zip(names).map(|(at, name)| Self::new(Symbol::Input(at), name, "")).collect()
    }
}

/// The form in which a result is returned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    Array(usize),
    Matrix(usize, usize),
}

impl Form {
    pub(super) fn len(self) -> usize {
        match self {
            Form::Array(n) => n,
            Form::Matrix(rows, columns) => rows * columns,
        }
    }
}

/// A result of a function: an array of named values, or a matrix.
#[derive(Clone, Debug)]
pub struct Output {
    pub(super) name: String,
    pub(super) form: Form,
    elements: Vec<(String, Id)>,
}

impl Output {
    /// An array whose elements have names of their own, one line each.
    #[must_use]
    pub fn array<S: AsRef<str>>(name: &str, elements: &[(S, Id)]) -> Self {
        let elements: Vec<_> = elements.iter().map(|(name, id)| (name.as_ref().to_owned(), *id)).collect();
        Output { name: name.into(), form: Form::Array(elements.len()), elements }
    }

    /// A matrix by rows; element names are `name_row_column`, from 0.
    #[must_use]
    pub fn matrix<const R: usize, const C: usize>(name: &str, rows: &[[Id; C]; R]) -> Self {
        let rows = rows
            .iter()
            .enumerate()
            .flat_map(|(r, row)| row.iter().enumerate().map(move |(c, &id)| (format!("{name}_{r}_{c}"), id)));
        Output { name: name.into(), form: Form::Matrix(R, C), elements: rows.collect() }
    }
}

/// A function ready for a printer.
#[derive(Clone, Debug)]
pub struct Function {
    pub(super) name: String,
    pub(super) docs: Vec<String>,
    pub(super) inputs: Vec<Input>,
    pub(super) results: Vec<(String, Form)>,
    /// Over all results, as the program's outputs.
    pub(super) elements: Vec<String>,
    pub(super) program: Program,
}

impl Function {
    /// Lowers `outputs` together. `docs` are the lines of its documentation; each printer adds the inputs' meaning and the
    /// operation count.
    ///
    /// # Errors
    /// An output depends on a symbol that is not among `inputs`.
    pub fn new(
        graph: &Graph,
        name: &str,
        docs: &[&str],
        inputs: Vec<Input>,
        outputs: &[Output],
    ) -> Result<Self, Unbound> {
        let elements = || outputs.iter().flat_map(|output| &output.elements);
        let ids: Vec<Id> = elements().map(|(_, id)| *id).collect();
        let symbols: Vec<Symbol> = inputs.iter().map(|input| input.symbol).collect();
        Ok(Function {
            name: name.into(),
            docs: docs.iter().flat_map(|doc| doc.lines()).map(|line| visible(line).into_owned()).collect(),
            results: outputs.iter().map(|output| (output.name.clone(), output.form)).collect(),
            elements: elements().map(|(name, _)| name.clone()).collect(),
            program: graph.lower(&symbols, &ids)?,
            inputs,
        })
    }

    /// What the function takes.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// What the function computes, step by step.
    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The first result and those that hold something, for languages in which each function has a type of its own.
    pub(super) fn filled(&self) -> impl Iterator<Item = &(String, Form)> {
        self.results.iter().enumerate().filter(|(at, (_, form))| *at == 0 || form.len() > 0).map(|(_, result)| result)
    }

    /// Whether a step or an output uses the input at each place.
    pub(super) fn used(&self) -> Vec<bool> {
        let program = &self.program;
        let mut used = vec![false; self.inputs.len()];
        let operands = program.steps().iter().flat_map(|step| step.operands());
        for value in operands.chain(program.outputs().iter().copied()) {
            if let Value::Input(at) = value {
                used[at as usize] = true;
            }
        }
        used
    }

    /// The documentation, then what the inputs are under the names they are printed with, the operation count last.
    pub(super) fn documentation(&self, inputs: &[String]) -> Vec<String> {
        let mut lines = self.docs.clone();
        let mut part = |text: String| {
            if !lines.is_empty() {
                lines.push(String::new());
            }
            lines.extend(wrapped(&text, WIDTH - 8));
        };
        let told = self.inputs.iter().zip(inputs).filter(|(input, _)| !input.meaning.is_empty());
        let told: Vec<_> = told.map(|(input, name)| format!("`{name}`: {}", input.meaning)).collect();
        if !told.is_empty() {
            part(format!("{}.", told.join("; ")));
        }
        part(cost(&self.program.operations()));
        lines
    }
}

/// `7 multiplications, 1 sine and cosine.`
fn cost(count: &Operations) -> String {
    let kinds = [
        (count.multiplications, "multiplication", "multiplications"),
        (count.additions, "addition", "additions"),
        (count.divisions, "division", "divisions"),
        (count.roots, "square root", "square roots"),
        (count.floors, "rounding", "roundings"),
        (count.angles, "sine and cosine", "sines and cosines"),
    ];
    let counts = kinds.into_iter().filter(|(n, ..)| *n > 0);
    let counts: Vec<_> = counts.map(|(n, one, many)| format!("{n} {}", if n == 1 { one } else { many })).collect();
    match counts.is_empty() {
        true => "No operations.".to_owned(),
        false => format!("{}.", counts.join(", ")),
    }
}
