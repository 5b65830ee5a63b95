//! Symbolic differentiation.

use super::Rational;
use super::build::Graph;
use super::node::{Id, Node};

impl Graph {
    /// ∂f/∂x of each expression `f` with respect to the symbol `x` (or any other expression taken as a variable).
    pub fn derivatives(&mut self, outputs: &[Id], x: Id) -> Vec<Id> {
        let reachable = self.reachable(outputs);
        let mut known = vec![Id::ZERO; reachable.len()];
        for (index, _) in reachable.iter().enumerate().filter(|&(_, &used)| used) {
            let id = Id(index as u32);
            known[index] = if id == x { Id::ONE } else { self.local_derivative(id, &known) };
        }
        outputs.iter().map(|output| known[output.index()]).collect()
    }

    /// ∂f/∂x.
    pub fn derivative(&mut self, f: Id, x: Id) -> Id {
        self.derivatives(&[f], x).first().copied().unwrap_or(Id::ZERO)
    }

    /// The chain rule at one node, the derivatives of its children being known.
    fn local_derivative(&mut self, id: Id, known: &[Id]) -> Id {
        if self.node(id).children().all(|child| known[child.index()] == Id::ZERO) {
            return Id::ZERO;
        }
        match self.node(id).clone() {
            Node::Symbol(_) | Node::Rational(_) | Node::Pi | Node::Sqrt2 => Id::ZERO,
            Node::Sum(terms) => {
                // The unit of the sum's constant is no child: its derivative stays zero.
                let terms: Vec<_> =
                    terms.iter().map(|term| (term.coefficient.clone(), known[term.node.index()])).collect();
                self.linear(&terms)
            }
            Node::Product(coefficient, factors) => {
                let mut terms = Vec::with_capacity(factors.len());
                for factor in &factors {
                    let inner = known[factor.base.index()];
                    if inner == Id::ZERO {
                        continue;
                    }
                    let exponent = Rational::from(i128::from(factor.exponent));
                    let mut rest = vec![(inner, 1), (factor.base, -1)];
                    rest.extend(factors.iter().map(|factor| (factor.base, factor.exponent)));
                    terms.push(self.monomial(&coefficient * &exponent, &rest));
                }
                self.sum(&terms)
            }
            // (√u)′ = u′ / (2√u)
            Node::Sqrt(u) => self.monomial(Rational::new(1, 2), &[(known[u.index()], 1), (id, -1)]),
            // Constant but where it jumps.
            Node::WholeTurns(_) => Id::ZERO,
            Node::Sin(u) => {
                let cos = self.cos(u);
                self.product(&[cos, known[u.index()]])
            }
            Node::Cos(u) => {
                let sin = self.sin(u);
                self.monomial(-Rational::ONE, &[(sin, 1), (known[u.index()], 1)])
            }
        }
    }
}
