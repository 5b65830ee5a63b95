//! How people write a term: a sign, a fraction of whole numbers, factors over and under the line.

use num_traits::{One, Signed};

use crate::graph::{Factor, Graph, Id, Node, Rational};

/// coefficient · Π over / Π under without its sign.
pub(super) struct Parts {
    pub negative: bool,
    pub numer: u128,
    pub denom: u128,
    /// Bases and how often each is multiplied in.
    pub over: Vec<(Id, u32)>,
    /// Bases and how often each is divided by.
    pub under: Vec<(Id, u32)>,
}

/// Splits coefficient·node, where node may be [`Id::ONE`].
pub(super) fn parts(graph: &Graph, coefficient: &Rational, node: Id) -> Parts {
    let single;
    let factors: &[Factor] = match graph.node(node) {
        Node::Product(own, factors) if own.is_one() => factors,
        _ if node == Id::ONE => &[],
        _ => {
            single = [Factor { base: node, exponent: 1 }];
            &single
        }
    };
    of_factors(coefficient, factors)
}

pub(super) fn of_factors(coefficient: &Rational, factors: &[Factor]) -> Parts {
    let side = |sign: i32| {
        let side = factors.iter().filter(|factor| factor.exponent.signum() == sign);
        side.map(|factor| (factor.base, factor.exponent.unsigned_abs())).collect()
    };
    Parts {
        negative: coefficient.is_negative(),
        numer: coefficient.numer().unsigned_abs(),
        denom: coefficient.denom().unsigned_abs(),
        over: side(1),
        under: side(-1),
    }
}

/// A sum's terms, the first that is added leading.
pub(super) fn ordered(graph: &Graph, terms: &[crate::graph::Term]) -> Vec<Parts> {
    let mut parts: Vec<Parts> = terms.iter().map(|term| parts(graph, &term.coefficient, term.node)).collect();
    if let Some(lead) = parts.iter().position(|part| !part.negative) {
        parts[..=lead].rotate_right(1);
    }
    parts
}
