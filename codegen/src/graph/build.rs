//! Building sums and products in normal form.

use indexmap::IndexSet;
use rustc_hash::FxBuildHasher;

use super::Rational;
use super::node::{Addend, Id, Node, Power, Symbol};

/// Owns expressions; an equal expression is stored once.
///
/// An [`Id`] belongs to the graph that gave it: with another graph it means another expression, or, past its end,
/// is a mistake in the program that panics as an index does.
#[derive(Clone, Debug)]
pub struct Graph {
    nodes: IndexSet<Node, FxBuildHasher>,
}

impl Default for Graph {
    fn default() -> Self {
        let named = [Node::Rational(Rational::ZERO), Node::Rational(Rational::ONE), Node::Pi, Node::Sqrt2];
        Graph { nodes: named.into_iter().collect() }
    }
}

impl Graph {
    /// A graph that holds 0, 1, π and √2.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What `id` stands for.
    #[must_use]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    /// For each node up to the last of `outputs`, whether an output is made of it.
    pub(super) fn reachable(&self, outputs: &[Id]) -> Vec<bool> {
        let end = outputs.iter().map(|id| id.index() + 1).max().unwrap_or(0);
        let mut used = vec![false; end];
        for output in outputs {
            used[output.index()] = true;
        }
        for index in (0..end).rev() {
            if used[index] {
                for child in self.node(Id(index as u32)).children() {
                    used[child.index()] = true;
                }
            }
        }
        used
    }

    pub(super) fn intern(&mut self, node: Node) -> Id {
        Id(self.nodes.insert_full(node).0 as u32)
    }

    /// A variable. What is made first is printed first.
    pub fn symbol(&mut self, symbol: Symbol) -> Id {
        self.intern(Node::Symbol(symbol))
    }

    /// The inputs of a function that comes from no model: [`Symbol::Input`] of 0, 1, ….
    pub fn inputs<const N: usize>(&mut self) -> [Id; N] {
        core::array::from_fn(|at| self.symbol(Symbol::Input(at as u32)))
    }

    /// An exact constant.
    pub fn rational(&mut self, value: Rational) -> Id {
        self.intern(Node::Rational(value))
    }

    /// A whole constant.
    pub fn integer(&mut self, value: i128) -> Id {
        self.rational(Rational::from(value))
    }

    /// Σ terms.
    pub fn sum(&mut self, terms: &[Id]) -> Id {
        self.collect_sum(terms.iter().map(|&term| (Rational::ONE, term)))
    }

    /// Σ coefficient · term.
    pub fn linear(&mut self, terms: &[(Rational, Id)]) -> Id {
        self.collect_sum(terms.iter().cloned())
    }

    /// Π factors.
    pub fn product(&mut self, factors: &[Id]) -> Id {
        self.collect_product(Rational::ONE, factors.iter().map(|&base| (base, 1)))
    }

    /// coefficient · Π base^exponent.
    pub fn monomial(&mut self, coefficient: Rational, factors: &[(Id, i32)]) -> Id {
        self.collect_product(coefficient, factors.iter().copied())
    }

    /// base^exponent; a negative exponent divides, and 0⁰ is 1.
    pub fn power(&mut self, base: Id, exponent: i32) -> Id {
        self.monomial(Rational::ONE, &[(base, exponent)])
    }

    /// −a.
    pub fn negate(&mut self, a: Id) -> Id {
        self.linear(&[(-Rational::ONE, a)])
    }

    /// a − b.
    pub fn difference(&mut self, a: Id, b: Id) -> Id {
        self.linear(&[(Rational::ONE, a), (-Rational::ONE, b)])
    }

    /// a / b.
    pub fn quotient(&mut self, a: Id, b: Id) -> Id {
        self.monomial(Rational::ONE, &[(a, 1), (b, -1)])
    }

    fn collect_sum(&mut self, terms: impl ExactSizeIterator<Item = (Rational, Id)>) -> Id {
        let mut flat = Vec::with_capacity(terms.len());
        for (coefficient, node) in terms {
            self.flatten_term(coefficient, node, &mut flat);
        }
        flat.sort_by_key(|term: &Addend| term.node);
        flat.dedup_by(|next, kept| {
            let alike = next.node == kept.node;
            if alike {
                kept.coefficient = &kept.coefficient + &next.coefficient;
            }
            alike
        });
        flat.retain(|term| !term.coefficient.is_zero());
        match flat.as_slice() {
            [] => Id::ZERO,
            [only] => self.scaled(only.coefficient.clone(), only.node),
            _ => self.intern(Node::Sum(flat.into())),
        }
    }

    /// Adds coefficient·node to `flat`, opening sums and constants.
    fn flatten_term(&mut self, coefficient: Rational, node: Id, flat: &mut Vec<Addend>) {
        match &self.nodes[node.index()] {
            Node::Rational(r) => flat.push(Addend { coefficient: &coefficient * r, node: Id::ONE }),
            Node::Sum(terms) => {
                let opened = |term: &Addend| Addend { coefficient: &coefficient * &term.coefficient, node: term.node };
                flat.extend(terms.iter().map(opened));
            }
            Node::Product(own, factors) if !own.is_one() => {
                let coefficient = &coefficient * own;
                let node = match **factors {
                    [Power { base, exponent: 1 }] => base,
                    _ => {
                        let unit = Node::Product(Rational::ONE, factors.clone());
                        self.intern(unit)
                    }
                };
                flat.push(Addend { coefficient, node });
            }
            _ => flat.push(Addend { coefficient, node }),
        }
    }

    /// coefficient·node for a node that is no sum.
    fn scaled(&mut self, coefficient: Rational, node: Id) -> Id {
        if coefficient.is_one() {
            return node;
        }
        if node == Id::ONE {
            return self.intern(Node::Rational(coefficient));
        }
        let factors = match &self.nodes[node.index()] {
            Node::Product(own, factors) if own.is_one() => factors.clone(),
            _ => [Power { base: node, exponent: 1 }].into(),
        };
        self.intern(Node::Product(coefficient, factors))
    }

    fn collect_product(&mut self, coefficient: Rational, factors: impl ExactSizeIterator<Item = (Id, i32)>) -> Id {
        let mut flat = Vec::with_capacity(factors.len());
        let mut constant = coefficient;
        for (base, exponent) in factors {
            self.flatten_factor(base, exponent, &mut constant, &mut flat);
        }
        loop {
            flat.sort_by_key(|factor| factor.base);
            flat.dedup_by(|next, kept| {
                let sum = (next.base == kept.base).then(|| kept.exponent.checked_add(next.exponent)).flatten();
                sum.inspect(|&sum| kept.exponent = sum).is_some()
            });
            flat.retain(|factor| factor.exponent != 0);
            if !self.reduce_roots(&mut constant, &mut flat) {
                break;
            }
        }
        if constant.is_zero() {
            return Id::ZERO;
        }
        match *flat.as_slice() {
            [] => self.intern(Node::Rational(constant)),
            [Power { base, exponent: 1 }] if constant.is_one() => base,
            // A constant times a sum is opened, so that 2(x + y) and 2x + 2y are one expression.
            [Power { base, exponent: 1 }] if matches!(self.node(base), Node::Sum(_)) => {
                self.linear(&[(constant, base)])
            }
            _ => self.intern(Node::Product(constant, flat.into())),
        }
    }

    /// Multiplies base^exponent in, opening products and constants unless an exponent or a power would overflow.
    pub(super) fn flatten_factor(&mut self, base: Id, exponent: i32, constant: &mut Rational, flat: &mut Vec<Power>) {
        if exponent == 0 {
            return;
        }
        let start = flat.len();
        let own = match &self.nodes[base.index()] {
            Node::Rational(r) => r.clone(),
            Node::Product(own, factors) => {
                let opened = factors.iter().try_for_each(|factor| {
                    let exponent = factor.exponent.checked_mul(exponent)?;
                    flat.push(Power { base: factor.base, exponent });
                    Some(())
                });
                if opened.is_none() {
                    flat.truncate(start);
                    return flat.push(Power { base, exponent });
                }
                own.clone()
            }
            _ => return flat.push(Power { base, exponent }),
        };
        match own.power(exponent) {
            Some(power) => *constant = &*constant * &power,
            None => {
                let base = self.intern(Node::Rational(own));
                flat.push(Power { base, exponent });
            }
        }
    }
}
