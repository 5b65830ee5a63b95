//! Conditions as text: `f'(2*pi) = f'(0)`.

use super::draft::Text;
use super::evaluate::Scope;
use super::expression::{Expr, Node, Operator, parse_equation};
use super::resolve::Resolver;
use super::{EvaluationError, ProblemKind};
use crate::algebra::{Order, Poly};
use crate::basis::Condition;

/// The condition `left − right = 0`.
pub(super) fn condition(resolver: &mut Resolver, text: &Text) -> Option<Condition> {
    let (left, right) = resolver.parsed(text, parse_equation(&text.value))?;
    let scope = Scope { alphabet: &resolver.alphabet, sweep: None };
    let mut terms = Vec::new();
    let read = collect(&scope, &left, &Poly::one(), &mut terms)
        .and_then(|l| Ok(l && collect(&scope, &right, &Poly::integer(-1), &mut terms)?));
    match resolver.meaning(text, read)? {
        true if !terms.is_empty() => Some(Condition { terms }),
        _ => resolver.problem(&text.span, ProblemKind::NotACondition),
    }
}

/// Adds `factor · e` to `terms`; false if e is not linear and homogeneous in f.
fn collect(
    scope: &Scope,
    e: &Expr,
    factor: &Poly,
    terms: &mut Vec<(u32, Poly, Poly)>,
) -> Result<bool, EvaluationError> {
    match &e.node {
        Node::Call(name, primes, point) if name == "f" => {
            terms.push((*primes, scope.poly(point)?, factor.clone()));
            Ok(true)
        }
        Node::Negative(x) => collect(scope, x, &factor.negated(), terms),
        Node::Binary(Operator::Plus, x, y) => {
            Ok(collect(scope, x, factor, terms)? && collect(scope, y, factor, terms)?)
        }
        Node::Binary(Operator::Minus, x, y) => {
            Ok(collect(scope, x, factor, terms)? && collect(scope, y, &factor.negated(), terms)?)
        }
        Node::Binary(Operator::Times, x, y) if !has_f(x) => {
            let scaled = scope.poly(x)?.times(factor, Order::NOMINAL);
            collect(scope, y, &scaled.map_err(|a| (e.span.clone(), super::Meaning::Algebra(a)))?, terms)
        }
        _ if !has_f(e) => Ok(scope.poly(e)?.is_zero()),
        _ => Ok(false),
    }
}

fn has_f(e: &Expr) -> bool {
    match &e.node {
        Node::Call(name, _, x) => name == "f" || has_f(x),
        Node::Negative(x) => has_f(x),
        Node::Binary(_, x, y) => has_f(x) || has_f(y),
        Node::Number(..) | Node::Name(_) => false,
    }
}
