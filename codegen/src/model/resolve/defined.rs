//! What a run defines for its expressions, and angles given by their sine and cosine.

use super::resolver::Resolver;
use crate::algebra::{Angle, Arctangent, Order, Poly, Root, SweepId};
use crate::expression::{Expr, ExprKind, parse};
use crate::model::{Axis, DraftRun, ProblemKind};
use crate::source::Text;

impl Resolver {
    /// Takes the definitions of a run, each of which may use those before it.
    pub fn define(&mut self, run: &DraftRun, sweep: SweepId) {
        self.defined.clear();
        for (name, text) in &run.define {
            let value = self.definition(name, text, sweep);
            self.defined.extend(value.map(|value| (name.value.clone(), value)));
        }
    }

    fn definition(&mut self, name: &Text, text: &Text, sweep: SweepId) -> Option<Poly> {
        let expr = self.parsed(text, parse(&text.value))?;
        let is_new = self.defined.iter().all(|(own, _)| *own != name.value);
        if !is_new {
            return self.problem(&name.span, ProblemKind::Taken(name.value.clone()));
        }
        let of = match &expr.node {
            ExprKind::Call(function, 0, of) if function == "sqrt" => self.value(text, of, sweep)?,
            _ => Poly::ZERO,
        };
        if of.as_number().is_some() {
            return (self.is_name(name) && self.is_free(name)).then(|| self.value(text, &expr, sweep)).flatten();
        }
        let root = Root { of: of.terms().to_vec() };
        let known = self.alphabet.has_root(&root, &name.value);
        if !(known || (self.is_name(name) && self.is_free(name))) {
            return None;
        }
        let made = self.alphabet.root(root, name.value.clone());
        self.exact(&text.span, made).map(Poly::nominal)
    }

    fn value(&mut self, text: &Text, expr: &Expr, sweep: SweepId) -> Option<Poly> {
        let value = self.scope(Some(sweep)).poly(expr);
        let value = self.meaning(text, value)?;
        let normal = value.normal(&self.alphabet);
        self.exact(&text.span, normal)
    }

    /// A rotary coordinate that is given by its sine and cosine.
    pub fn arctangent(&mut self, text: &Text, sin: &Expr, cos: &Expr, axis: &Axis, sweep: SweepId) -> Option<Angle> {
        let (sin, cos) = (self.value(text, sin, sweep)?, self.value(text, cos, sweep)?);
        let square = |p: &Poly| p.times(p, Order::NOMINAL);
        let off = square(&sin).and_then(|s| s.plus(&square(&cos)?)?.minus(&Poly::one())?.vanishes(&self.alphabet));
        if !self.exact(&text.span, off)? {
            return self.problem(&text.span, ProblemKind::NotOnACircle);
        }
        let name = self.alphabet.free(format!("angle_{}", axis.name));
        let angle = Arctangent { sweep, sin: sin.terms().to_vec(), cos: cos.terms().to_vec() };
        let made = self.alphabet.arctangent(angle, name);
        let poly = Poly::nominal(self.exact(&text.span, made)?);
        Some(Angle { given: Some((Box::new([sin, cos]), 1)), poly, ..Angle::zero() })
    }
}
