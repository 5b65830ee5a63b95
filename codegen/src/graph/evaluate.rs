//! Evaluation node by node: the reference for everything that is compiled or printed.

use std::fmt;

use super::build::Graph;
use super::node::{Id, Node, Symbol};
use super::{to_f64, whole_turns};

/// An expression uses a symbol that was given no value, or is no input of the function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Unbound {
    /// The symbol.
    pub symbol: Symbol,
}

impl fmt::Display for Unbound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.symbol {
            Symbol::Nominal(_) => f.write_str("a length or a sweep is used but not given"),
            Symbol::Coordinate => f.write_str("a coordinate is used but not given"),
            Symbol::Input(at) => write!(f, "input {at} is used but not given"),
        }
    }
}

impl std::error::Error for Unbound {}

impl Graph {
    /// The value of `id` with its symbols at `values`, in `f64`; angles in rad. For many points use a [`Tape`](super::Tape).
    ///
    /// # Errors
    /// A symbol of the expression is not among `values`.
    pub fn evaluate(&self, id: Id, values: &[(Symbol, f64)]) -> Result<f64, Unbound> {
        let used = self.reachable(&[id]);
        let mut known = vec![0.0; used.len()];
        for (index, _) in used.iter().enumerate().filter(|&(_, &used)| used) {
            let at = |id: Id| known[id.index()];
            known[index] = match self.node(Id(index as u32)) {
                Node::Symbol(symbol) => {
                    let given = values.iter().find(|(given, _)| given == symbol);
                    given.ok_or(Unbound { symbol: *symbol })?.1
                }
                Node::Rational(r) => to_f64(r),
                Node::Pi => std::f64::consts::PI,
                Node::Sqrt2 => std::f64::consts::SQRT_2,
                Node::Sum(terms) => terms
                    .iter()
                    .map(|term| to_f64(&term.coefficient) * if term.node == Id::ONE { 1.0 } else { at(term.node) })
                    .sum(),
                Node::Product(coefficient, factors) => factors
                    .iter()
                    .fold(to_f64(coefficient), |product, factor| product * at(factor.base).powi(factor.exponent)),
                Node::Sqrt(u) => at(*u).sqrt(),
                Node::Sin(u) => at(*u).sin(),
                Node::Cos(u) => at(*u).cos(),
                Node::WholeTurns(u) => whole_turns(at(*u)),
            };
        }
        Ok(known.last().copied().unwrap_or(0.0))
    }
}
