//! What resolving has found so far, and what every part of it needs: exact values of texts.

use crate::algebra::{AlgebraError, Alphabet, ErrorId, Order, Poly, PolyVector, SweepId, dot};
use crate::expression::{EvaluationError, Meaning, Scope, SyntaxError, parse};
use crate::model::{Problem, ProblemKind};
use crate::source::{Span, Text};

/// The symbols so far and the problems so far. A step that fails records its problem and answers `None`.
#[derive(Default)]
pub(super) struct Resolver {
    pub alphabet: Alphabet,
    /// ISO name of each error made, for look-up by either name.
    pub iso: Vec<(String, ErrorId)>,
    pub problems: Vec<Problem>,
    /// What the run that is being resolved defines.
    pub defined: Vec<(String, Poly)>,
}

impl Resolver {
    pub fn problem<T>(&mut self, span: &Span, kind: ProblemKind) -> Option<T> {
        self.problems.push(Problem { span: span.clone(), kind });
        None
    }

    pub fn exact<T>(&mut self, span: &Span, result: Result<T, AlgebraError>) -> Option<T> {
        result.map_or_else(|e| self.problem(span, ProblemKind::Meaning(Meaning::Algebra(e))), Some)
    }

    pub fn error(&self, name: &str) -> Option<ErrorId> {
        let by_iso = self.iso.iter().find(|(iso, _)| iso == name).map(|(_, id)| *id);
        by_iso.or_else(|| self.alphabet.find_error(name))
    }

    /// An exact unit vector, along an axis of the machine's coordinates or of three components.
    pub fn direction(&mut self, written: &[Text], owner: &Span, sweep: Option<SweepId>) -> Option<PolyVector> {
        let direction = match written {
            [single] => {
                let unit =
                    |i: usize, sign: i128| core::array::from_fn(|j| Poly::integer(if i == j { sign } else { 0 }));
                let signed = [("x", 0, 1), ("y", 1, 1), ("z", 2, 1), ("-x", 0, -1), ("-y", 1, -1), ("-z", 2, -1)];
                match signed.iter().find(|(name, ..)| *name == single.value) {
                    Some((_, i, sign)) => unit(*i, *sign),
                    None => return self.problem(&single.span, ProblemKind::NotAUnitVector),
                }
            }
            three => self.vector(three, owner, sweep)?,
        };
        let off = dot(&direction, &direction, Order::NOMINAL)
            .and_then(|square| square.minus(&Poly::one())?.vanishes(&self.alphabet));
        let span = written.first().map_or(owner.clone(), |t| t.span.clone());
        if self.exact(&span, off)? { Some(direction) } else { self.problem(&span, ProblemKind::NotAUnitVector) }
    }

    /// Three expressions; an empty list is the origin.
    pub fn vector(&mut self, texts: &[Text], span: &Span, sweep: Option<SweepId>) -> Option<PolyVector> {
        if texts.is_empty() {
            return Some(PolyVector::default());
        }
        if texts.len() != 3 {
            let span = texts.first().map_or(span.clone(), |t| t.span.clone());
            return self.problem(&span, ProblemKind::NotThree(texts.len()));
        }
        let components: Vec<Poly> = texts.iter().filter_map(|t| self.poly(t, sweep)).collect();
        components.try_into().ok()
    }

    pub fn poly(&mut self, text: &Text, sweep: Option<SweepId>) -> Option<Poly> {
        let expr = self.parsed(text, parse(&text.value))?;
        let value = self.scope(sweep).poly(&expr);
        self.meaning(text, value)
    }

    /// What expressions may use: along a sweep what its run defines, too.
    pub fn scope(&self, sweep: Option<SweepId>) -> Scope<'_> {
        let defined = if sweep.is_some() { self.defined.as_slice() } else { &[] };
        Scope { alphabet: &self.alphabet, sweep, defined }
    }

    pub fn parsed<T>(&mut self, text: &Text, result: Result<T, SyntaxError>) -> Option<T> {
        result.map_or_else(|e| self.problem(&text.place(&e.span), ProblemKind::Syntax(e.expected)), Some)
    }

    pub fn meaning<T>(&mut self, text: &Text, result: Result<T, EvaluationError>) -> Option<T> {
        result.map_or_else(|(span, meaning)| self.problem(&text.place(&span), ProblemKind::Meaning(meaning)), Some)
    }
}
