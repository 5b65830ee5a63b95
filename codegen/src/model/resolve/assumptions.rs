//! Assumptions: `EYC_cos2 = "0"`, `EXC_cos1 = "EYC_sin1"`, `EXC = "0 at c = 0"`.

use super::resolver::Resolver;
use crate::algebra::{Order, Poly};
use crate::basis::Coordinate;
use crate::expression::{EvaluationError, Expr, ExprKind, Operator, Scope, parse};
use crate::ids::FunctionId;
use crate::model::unknown::{Coefficient, Origin};
use crate::model::{Assumption, Axis, AxisKind, Draft, ErrorFunction, ProblemKind};
use crate::source::Text;
use typed_index_collections::TiSlice;

/// A sum of parameters, or of functions at a point, by name.
type Named = Vec<(Poly, Text)>;

impl Resolver {
    /// All of them, between parameters of the errors of `axes` and their `functions`.
    pub fn assumptions(
        &mut self,
        draft: &Draft,
        axes: &[&Axis],
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) -> Vec<Assumption> {
        let mut all = Vec::new();
        for (left, right) in &draft.assume {
            let whole = self.error(&left.value).and_then(|e| functions.position(|f| f.error == e));
            match (whole, right.value.trim()) {
                (Some(function), "0") => {
                    let terms = functions[function].basis.functions().keys();
                    all.extend(terms.map(|term| {
                        let one = vec![(Origin::Coefficient(Coefficient { function, term }), Poly::one())];
                        assumption(left, right, one, Vec::new())
                    }));
                }
                _ => all.extend(self.assumption(left, right, axes, functions)),
            }
        }
        all
    }

    fn assumption(
        &mut self,
        left: &Text,
        right: &Text,
        axes: &[&Axis],
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) -> Option<Assumption> {
        let (value, point) = match right.value.find(" at ") {
            None => (right.clone(), None),
            Some(at) => (part(right, 0, at), Some(part(right, at + 4, right.value.len()))),
        };
        let expr = self.parsed(&value, parse(&value.value))?;
        let mut sum = Vec::new();
        let linear = self.collect(&value, &expr, &Poly::integer(-1), &mut sum);
        if !self.meaning(&value, linear)? {
            return self.problem(&right.span, ProblemKind::NotAnAssumption);
        }
        let one = self.terms(&(Poly::one(), left.clone()), point.as_ref(), axes, functions)?;
        let mut others = Vec::new();
        for named in &sum {
            others.extend(self.terms(named, point.as_ref(), axes, functions)?);
        }
        Some(assumption(left, right, one, others))
    }

    /// Adds `factor · e` to `sum`; false if e is not linear and homogeneous in names that are no constants.
    fn collect(&self, text: &Text, e: &Expr, factor: &Poly, sum: &mut Named) -> Result<bool, EvaluationError> {
        let scope = Scope { alphabet: &self.alphabet, sweep: None, defined: &[] };
        let scaled = |by: Poly| {
            let product = by.times(factor, Order::NOMINAL);
            product.map_err(|a| (e.span.clone(), crate::expression::Meaning::Algebra(a)))
        };
        match &e.node {
            ExprKind::Name(name) if self.alphabet.find_constant(name).is_none() && name != "pi" => {
                sum.push((factor.clone(), Text { value: name.clone(), span: text.place(&e.span) }));
                Ok(true)
            }
            ExprKind::Negative(x) => self.collect(text, x, &factor.negated(), sum),
            ExprKind::Binary(Operator::Plus, x, y) => {
                Ok(self.collect(text, x, factor, sum)? && self.collect(text, y, factor, sum)?)
            }
            ExprKind::Binary(Operator::Minus, x, y) => {
                Ok(self.collect(text, x, factor, sum)? && self.collect(text, y, &factor.negated(), sum)?)
            }
            ExprKind::Binary(Operator::Times, x, y) => match (scope.poly(x), scope.poly(y)) {
                (Ok(by), _) => self.collect(text, y, &scaled(by)?, sum),
                (_, Ok(by)) => self.collect(text, x, &scaled(by)?, sum),
                _ => Ok(false),
            },
            ExprKind::Binary(Operator::Over, x, y) => {
                let one = Expr { node: ExprKind::Number(1, 1), span: e.span.clone() };
                let over = ExprKind::Binary(Operator::Over, Box::new(one), y.clone());
                let by = scope.poly(&Expr { node: over, span: e.span.clone() })?;
                self.collect(text, x, &scaled(by)?, sum)
            }
            _ => Ok(scope.poly(e)?.is_zero()),
        }
    }

    /// A parameter, or a function's coefficients at a point, times a factor.
    fn terms(
        &mut self,
        (factor, name): &(Poly, Text),
        point: Option<&Text>,
        axes: &[&Axis],
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) -> Option<Vec<(Origin, Poly)>> {
        let error = self.error(&name.value);
        let function = error.and_then(|e| functions.position(|f| f.error == e));
        let moved = |f: FunctionId| axes.iter().find(|a| a.motion.contains(&functions[f].error));
        if let (Some(point), Some((function, axis))) = (point, function.and_then(|f| Some((f, moved(f)?)))) {
            let coordinate = self.point(point, axis)?;
            let values = functions[function].basis.along(&coordinate, &self.alphabet);
            let values = self.exact(&point.span, values)?;
            let mut terms = Vec::new();
            for (term, value) in values.iter_enumerated() {
                let value = value.times(factor, Order::NOMINAL).and_then(|v| v.normal(&self.alphabet));
                let origin = Origin::Coefficient(Coefficient { function, term });
                terms.push((origin, self.exact(&point.span, value)?));
            }
            return Some(terms);
        }
        let moves = |e| axes.iter().any(|a| a.motion.contains(&e));
        let constant = error.filter(|e| point.is_none() && function.is_none() && !moves(*e)).map(Origin::Constant);
        let coefficient = || {
            let of = |(function, f): (FunctionId, &ErrorFunction)| {
                let suffix = name.value.strip_prefix(self.alphabet.error_name(f.error))?;
                let term = f.basis.functions().iter_enumerated().find(|(term, own)| own.suffix(*term) == suffix)?.0;
                Some(Origin::Coefficient(Coefficient { function, term }))
            };
            functions.iter_enumerated().find_map(of).filter(|_| point.is_none())
        };
        match constant.or_else(coefficient) {
            Some(origin) => Some(vec![(origin, factor.clone())]),
            None => self.problem(&name.span, ProblemKind::NothingToAssume(name.value.clone())),
        }
    }

    /// `c = 0`: the axis' letter and an exact coordinate.
    fn point(&mut self, text: &Text, axis: &Axis) -> Option<Coordinate> {
        let letter = axis.name.to_lowercase();
        let written = text.value.split_once('=').filter(|(name, _)| name.trim() == letter);
        let Some((name, _)) = written else {
            return self.problem(&text.span, ProblemKind::NotAPoint(letter));
        };
        let value = part(text, name.len() + 1, text.value.len());
        let expr = self.parsed(&value, parse(&value.value))?;
        let scope = Scope { alphabet: &self.alphabet, sweep: None, defined: &[] };
        match axis.kind {
            AxisKind::Linear => {
                let at = scope.poly(&expr);
                self.meaning(&value, at).map(Coordinate::Linear)
            }
            AxisKind::Rotary => {
                let at = scope.angle(&expr);
                self.meaning(&value, at).map(Coordinate::Rotary)
            }
        }
    }
}

fn assumption(left: &Text, right: &Text, one: Vec<(Origin, Poly)>, others: Vec<(Origin, Poly)>) -> Assumption {
    let words: Vec<&str> = right.value.split_whitespace().collect();
    let text = format!("{} = {}", left.value, words.join(" "));
    Assumption { text, left: one.len(), terms: [one, others].concat(), place: left.span.clone() }
}

/// A part of a text with its place.
fn part(text: &Text, from: usize, to: usize) -> Text {
    let place = text.place(&(from..to));
    // As if it had a quote of its own before it.
    let span = if text.span.is_empty() { 0..0 } else { place.start.saturating_sub(1)..place.end };
    Text { value: text.value.get(from..to).unwrap_or_default().to_owned(), span }
}
