//! Conditions as text: `f'(2*pi) = f'(0)`.

use crate::algebra::{Order, Poly};
use crate::basis::LinearCondition;
use crate::expression::{EvaluationError, Expr, ExprKind, Meaning, Operator, Scope};

/// The condition `left − right = 0`; `None` if it is not linear and homogeneous in f.
pub(super) fn condition(scope: &Scope, left: &Expr, right: &Expr) -> Result<Option<LinearCondition>, EvaluationError> {
    let mut terms = Vec::new();
    let linear =
        collect(scope, left, &Poly::one(), &mut terms)? && collect(scope, right, &Poly::integer(-1), &mut terms)?;
    Ok((linear && !terms.is_empty()).then_some(LinearCondition { terms }))
}

/// Adds `factor · e` to `terms`; false if e is not linear and homogeneous in f.
fn collect(
    scope: &Scope,
    e: &Expr,
    factor: &Poly,
    terms: &mut Vec<(u32, Poly, Poly)>,
) -> Result<bool, EvaluationError> {
    match &e.node {
        ExprKind::Call(name, primes, point) if name == "f" => {
            terms.push((*primes, scope.poly(point)?, factor.clone()));
            Ok(true)
        }
        ExprKind::Negative(x) => collect(scope, x, &factor.negated(), terms),
        ExprKind::Binary(Operator::Plus, x, y) => {
            Ok(collect(scope, x, factor, terms)? && collect(scope, y, factor, terms)?)
        }
        ExprKind::Binary(Operator::Minus, x, y) => {
            Ok(collect(scope, x, factor, terms)? && collect(scope, y, &factor.negated(), terms)?)
        }
        ExprKind::Binary(Operator::Times, x, y) if !has_f(x) => {
            let scaled = scope.poly(x)?.times(factor, Order::NOMINAL);
            collect(scope, y, &scaled.map_err(|a| (e.span.clone(), Meaning::Algebra(a)))?, terms)
        }
        _ if !has_f(e) => Ok(scope.poly(e)?.is_zero()),
        _ => Ok(false),
    }
}

fn has_f(e: &Expr) -> bool {
    match &e.node {
        ExprKind::Call(name, _, x) => name == "f" || has_f(x),
        ExprKind::Negative(x) => has_f(x),
        ExprKind::Binary(_, x, y) | ExprKind::Arctangent(x, y) => has_f(x) || has_f(y),
        ExprKind::Number(..) | ExprKind::Name(_) => false,
    }
}
