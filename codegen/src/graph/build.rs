//! Building sums and products in normal form.

use indexmap::IndexSet;
use num_traits::{One, Zero};
use rustc_hash::FxBuildHasher;

use super::node::{Addend, Id, Node, Power, Symbol};
use super::rational::{self, Rational};

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
        let named = [Node::Rational(Rational::zero()), Node::Rational(Rational::one()), Node::Pi, Node::Sqrt2];
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

    /// An exact constant. One with a zero denominator becomes the undefined `1/0`, which evaluates to infinity.
    pub fn rational(&mut self, value: Rational) -> Id {
        if let Some(value) = rational::reduced(value) {
            return self.intern(Node::Rational(value));
        }
        if value.denom().is_zero() {
            return self.intern(Node::Product(Rational::one(), [Power { base: Id::ZERO, exponent: -1 }].into()));
        }
        // −2¹²⁷ has no negative, so it stays a product: n/d with n = 2·(n/2).
        let half = |n: i128| Rational::from_integer(n / 2);
        let [numer, numer_rest, denom, denom_rest] = [
            half(*value.numer()),
            Rational::from_integer(*value.numer() % 2),
            half(*value.denom()),
            Rational::from_integer(*value.denom() % 2),
        ]
        .map(|part| self.intern(Node::Rational(part)));
        let numer = self.sum(&[numer, numer, numer_rest]);
        let denom = self.sum(&[denom, denom, denom_rest]);
        self.quotient(numer, denom)
    }

    /// A whole constant.
    pub fn integer(&mut self, value: i128) -> Id {
        self.rational(Rational::from_integer(value))
    }

    /// Σ terms.
    pub fn sum(&mut self, terms: &[Id]) -> Id {
        self.collect_sum(terms.iter().map(|&term| (Rational::one(), term)))
    }

    /// Σ coefficient · term.
    pub fn linear(&mut self, terms: &[(Rational, Id)]) -> Id {
        self.collect_sum(terms.iter().copied())
    }

    /// Π factors.
    pub fn product(&mut self, factors: &[Id]) -> Id {
        self.collect_product(Rational::one(), factors.iter().map(|&base| (base, 1)))
    }

    /// coefficient · Π base^exponent.
    pub fn monomial(&mut self, coefficient: Rational, factors: &[(Id, i32)]) -> Id {
        self.collect_product(coefficient, factors.iter().copied())
    }

    /// base^exponent; a negative exponent divides, and 0⁰ is 1.
    pub fn power(&mut self, base: Id, exponent: i32) -> Id {
        self.monomial(Rational::one(), &[(base, exponent)])
    }

    /// −a.
    pub fn negate(&mut self, a: Id) -> Id {
        self.linear(&[(-Rational::one(), a)])
    }

    /// a − b.
    pub fn difference(&mut self, a: Id, b: Id) -> Id {
        self.linear(&[(Rational::one(), a), (-Rational::one(), b)])
    }

    /// a / b.
    pub fn quotient(&mut self, a: Id, b: Id) -> Id {
        self.monomial(Rational::one(), &[(a, 1), (b, -1)])
    }

    fn collect_sum(&mut self, terms: impl ExactSizeIterator<Item = (Rational, Id)>) -> Id {
        let mut flat = Vec::with_capacity(terms.len());
        for (coefficient, node) in terms {
            self.flatten_term(coefficient, node, &mut flat);
        }
        flat.sort_by_key(|term: &Addend| term.node);
        flat.dedup_by(|next, kept| {
            let sum = (next.node == kept.node).then(|| rational::plus(&kept.coefficient, &next.coefficient)).flatten();
            sum.inspect(|&sum| kept.coefficient = sum).is_some()
        });
        flat.retain(|term| !term.coefficient.is_zero());
        match flat.as_slice() {
            [] => Id::ZERO,
            [only] => self.scaled(only.coefficient, only.node),
            _ => self.intern(Node::Sum(flat.into())),
        }
    }

    /// Adds coefficient·node to `flat`, opening sums and constants unless a coefficient would overflow.
    fn flatten_term(&mut self, coefficient: Rational, node: Id, flat: &mut Vec<Addend>) {
        // Unreduced or unrepresentable coefficients become constants of their own.
        let Some(coefficient) = rational::reduced(coefficient) else {
            let constant = self.rational(coefficient);
            let node = self.product(&[constant, node]);
            return flat.push(Addend { coefficient: Rational::one(), node });
        };
        let start = flat.len();
        let whole = match &self.nodes[node.index()] {
            Node::Rational(r) => {
                rational::times(&coefficient, r).map(|coefficient| flat.push(Addend { coefficient, node: Id::ONE }))
            }
            Node::Sum(terms) => terms.iter().try_for_each(|term| {
                let coefficient = rational::times(&coefficient, &term.coefficient)?;
                flat.push(Addend { coefficient, node: term.node });
                Some(())
            }),
            Node::Product(own, factors) if !own.is_one() => match rational::times(&coefficient, own) {
                Some(coefficient) => {
                    let unit = match **factors {
                        [Power { base, exponent: 1 }] => base,
                        _ => {
                            let unit = Node::Product(Rational::one(), factors.clone());
                            self.intern(unit)
                        }
                    };
                    flat.push(Addend { coefficient, node: unit });
                    Some(())
                }
                None => None,
            },
            _ => None,
        };
        if whole.is_none() {
            flat.truncate(start);
            flat.push(Addend { coefficient, node });
        }
    }

    /// coefficient·node for a node that is no sum, or a sum whose coefficients would overflow.
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
        let mut constant = rational::reduced(coefficient).unwrap_or_else(|| {
            let base = self.rational(coefficient);
            flat.push(Power { base, exponent: 1 });
            Rational::one()
        });
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

    /// Multiplies base^exponent in, opening products and constants unless something would overflow.
    pub(super) fn flatten_factor(&mut self, base: Id, exponent: i32, constant: &mut Rational, flat: &mut Vec<Power>) {
        if exponent == 0 {
            return;
        }
        let start = flat.len();
        let own = match &self.nodes[base.index()] {
            Node::Rational(r) => *r,
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
                *own
            }
            _ => return flat.push(Power { base, exponent }),
        };
        match rational::power(&own, exponent).and_then(|power| rational::times(constant, &power)) {
            Some(product) => *constant = product,
            None => {
                let base = self.intern(Node::Rational(own));
                flat.push(Power { base, exponent });
            }
        }
    }
}
