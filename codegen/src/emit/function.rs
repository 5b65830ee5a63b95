//! A function to be printed: its name, what it takes and what it gives.

use crate::graph::{Graph, Id, Operations, Program, Unbound, Value};

/// The form in which outputs are returned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Shape {
    Scalar,
    Array(usize),
    Matrix(usize, usize),
}

impl Shape {
    pub(super) fn len(self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Array(n) => n,
            Shape::Matrix(rows, columns) => rows * columns,
        }
    }
}

/// A result of a function: one value, an array of named values, or a matrix.
#[derive(Clone, Debug)]
pub struct Output {
    pub(super) name: String,
    pub(super) shape: Shape,
    elements: Vec<(String, Id)>,
}

impl Output {
    /// One value.
    #[must_use]
    pub fn scalar(name: &str, id: Id) -> Self {
        Output { name: name.into(), shape: Shape::Scalar, elements: vec![(name.into(), id)] }
    }

    /// An array whose elements have names of their own, one line each.
    #[must_use]
    pub fn array<S: AsRef<str>>(name: &str, elements: &[(S, Id)]) -> Self {
        let elements: Vec<_> = elements.iter().map(|(name, id)| (name.as_ref().to_owned(), *id)).collect();
        Output { name: name.into(), shape: Shape::Array(elements.len()), elements }
    }

    /// A matrix by rows; element names are `name_row_column`, from 0.
    #[must_use]
    pub fn matrix<const R: usize, const C: usize>(name: &str, rows: &[[Id; C]; R]) -> Self {
        let rows = rows
            .iter()
            .enumerate()
            .flat_map(|(r, row)| row.iter().enumerate().map(move |(c, &id)| (format!("{name}_{r}_{c}"), id)));
        Output { name: name.into(), shape: Shape::Matrix(R, C), elements: rows.collect() }
    }
}

/// A function ready for a printer.
#[derive(Clone, Debug)]
pub struct Function {
    pub(super) name: String,
    pub(super) docs: Vec<String>,
    pub(super) results: Vec<(String, Shape)>,
    /// Over all results, as the program's outputs.
    pub(super) elements: Vec<String>,
    pub(super) program: Program,
}

impl Function {
    /// Lowers `outputs` together. `docs` are the lines of its documentation; each printer adds the operation count.
    ///
    /// # Errors
    /// An output depends on a symbol that is not among `inputs`.
    pub fn new(graph: &Graph, name: &str, docs: &[&str], inputs: &[&str], outputs: &[Output]) -> Result<Self, Unbound> {
        let elements = || outputs.iter().flat_map(|output| &output.elements);
        let ids: Vec<Id> = elements().map(|(_, id)| *id).collect();
        Ok(Function {
            name: name.into(),
            docs: docs.iter().flat_map(|doc| doc.lines()).map(str::to_owned).collect(),
            results: outputs.iter().map(|output| (output.name.clone(), output.shape)).collect(),
            elements: elements().map(|(name, _)| name.clone()).collect(),
            program: graph.lower(inputs, &ids)?,
        })
    }

    /// What the function computes, step by step.
    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The inputs that no step and no output uses.
    pub(super) fn unused(&self) -> impl Iterator<Item = usize> + '_ {
        let program = &self.program;
        let mut used = vec![false; program.inputs().len()];
        let operands = program.steps().iter().flat_map(|step| step.operands());
        for value in operands.chain(program.outputs().iter().copied()) {
            if let Value::Input(at) = value {
                used[at as usize] = true;
            }
        }
        used.into_iter().enumerate().filter(|(_, used)| !used).map(|(at, _)| at)
    }

    /// The documentation, the operation count last.
    pub(super) fn documentation(&self) -> impl Iterator<Item = String> + '_ {
        let cost = cost(&self.program.operations());
        self.docs.iter().cloned().chain(self.docs.first().map(|_| String::new())).chain([cost])
    }
}

/// `7 multiplications, 1 sine and cosine.`
fn cost(count: &Operations) -> String {
    let kinds = [
        (count.multiplications, "multiplication", "multiplications"),
        (count.additions, "addition", "additions"),
        (count.divisions, "division", "divisions"),
        (count.roots, "square root", "square roots"),
        (count.angles, "sine and cosine", "sines and cosines"),
    ];
    let counts = kinds.into_iter().filter(|(n, ..)| *n > 0);
    let counts: Vec<_> = counts.map(|(n, one, many)| format!("{n} {}", if n == 1 { one } else { many })).collect();
    match counts.is_empty() {
        true => "No operations.".to_owned(),
        false => format!("{}.", counts.join(", ")),
    }
}
