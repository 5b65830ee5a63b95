//! The equations of a derivation in one style, before a format arranges them.

use super::function::Written;
use super::printer::{Printer, Style, indexed};
use crate::algebra::{ErrorId, Fraction, Monomial, Poly, Rational};
use crate::basis::{Basis, BasisFunction};
use crate::identify::{BaseParameter, Derivation, DerivedRun, Group};
use crate::ids::{BaseId, FunctionId, ParameterId, RunId};
use crate::model::{ErrorFunction, Model, ReadingKind};

/// `a`, `a and b`, `a, b and c`
fn listed(mut names: Vec<String>) -> String {
    match names.pop() {
        None => String::new(),
        Some(last) if names.is_empty() => last,
        Some(last) => format!("{} and {last}", names.join(", ")),
    }
}

/// A confounded group in words: `o_ya and t_y1 only appear as t_y1 − o_ya (k6)`.
pub fn group(model: &Model, derivation: &Derivation, group: &Group) -> String {
    Document::new(model, derivation, Style::Pretty).group(group)
}

/// A base parameter in physical ones: `−o_ya + R²·d_yy2 + t_y1`.
pub fn definition(model: &Model, derivation: &Derivation, base: &BaseParameter) -> String {
    Document::new(model, derivation, Style::Pretty).definition(&base.definition)
}

/// Prints the parts of one derivation.
pub(super) struct Document<'a> {
    pub model: &'a Model,
    pub derivation: &'a Derivation,
    pub printer: Printer<'a>,
}

impl<'a> Document<'a> {
    pub fn new(model: &'a Model, derivation: &'a Derivation, style: Style) -> Self {
        Self { model, derivation, printer: Printer { alphabet: &model.alphabet, style } }
    }

    /// An error's name; a motion error of the paper's notation is a Greek letter in LaTeX.
    pub fn error(&self, id: ErrorId) -> String {
        let name = self.model.alphabet.error_name(id);
        let motion = self.model.axis_of(id).is_some();
        match (self.printer.style, name.split_once('_')) {
            (Style::Latex, Some(("d", rest))) if motion => format!("\\delta_{{{}}}", rest.replace('_', "\\_")),
            (Style::Latex, Some(("e", rest))) if motion => format!("\\varepsilon_{{{}}}", rest.replace('_', "\\_")),
            (Style::MathMl, Some(("d", rest))) if motion => indexed("<mi>δ</mi>", rest),
            (Style::MathMl, Some(("e", rest))) if motion => indexed("<mi>ε</mi>", rest),
            _ => self.printer.name(name),
        }
    }

    /// The name of what a run reads: `ΔR` of a bar, `Δx` or `Δn` of a displacement.
    pub fn label(&self, run: RunId) -> String {
        let letter = match self.model.runs.get(run).map(|r| &r.reading) {
            Some(ReadingKind::Displacement(direction)) => {
                let unit = |(at, letter): (usize, char)| {
                    let along = |(i, p): (usize, &Poly)| *p == Poly::integer(i128::from(i == at));
                    direction.iter().enumerate().all(along).then_some(letter)
                };
                [(0, 'x'), (1, 'y'), (2, 'z')].into_iter().find_map(unit).unwrap_or('n')
            }
            _ => 'R',
        };
        match self.printer.style {
            Style::Latex => format!("\\Delta {letter}"),
            Style::MathMl => format!("<mrow><mi>Δ</mi><mi>{letter}</mi></mrow>"),
            Style::Plain | Style::Pretty => format!("Δ{letter}"),
        }
    }

    /// A run's linear reading with equal factors collected: `s·(d_yy + d_yz − d_ya) + c·(…) + …`, T(5).
    pub fn reading(&self, run: &DerivedRun) -> String {
        let mut groups: Vec<(Poly, Vec<(bool, ErrorId)>)> = Vec::new();
        for (errors, coefficient) in run.reading.by_errors() {
            let Some(error) = errors.errors().next() else { continue };
            let negative = coefficient.printed().first().is_some_and(|(_, c)| c.is_negative());
            let size = if negative { coefficient.negated() } else { coefficient };
            match groups.iter_mut().find(|(factor, _)| *factor == size) {
                Some((_, members)) => members.push((negative, error)),
                None => groups.push((size, vec![(negative, error)])),
            }
        }
        groups.sort_by_key(|(factor, _)| {
            let degree = |(m, _): &(Monomial, Rational)| m.powers().iter().map(|p| i32::from(*p)).sum::<i32>();
            factor.printed().iter().map(degree).max()
        });
        let print = |(factor, members): &(Poly, Vec<(bool, ErrorId)>)| {
            let flip = members.iter().all(|(negative, _)| *negative);
            let inner = self.printer.sum(members.iter().map(|(negative, e)| (*negative != flip, self.error(*e))));
            let inner = if members.len() > 1 { self.printer.parenthesised(&inner) } else { inner };
            let text = match factor.as_number() {
                Some(n) if n.is_one() => inner,
                _ => self.printer.product(&[self.bracketed(factor), inner]),
            };
            (flip, text)
        };
        self.printer.sum(groups.iter().rev().map(print))
    }

    fn bracketed(&self, p: &Poly) -> String {
        let text = self.printer.poly(p);
        if p.terms().len() > 1 { self.printer.parenthesised(&text) } else { text }
    }

    /// A base parameter in physical ones.
    pub fn definition(&self, definition: &[(ParameterId, Fraction)]) -> String {
        self.printer
            .combination(definition.iter().map(|(j, f)| (f, self.printer.name(&self.derivation.parameters[*j].name))))
    }

    /// True for a coefficient that is only itself: `e_xa1 = e_xa1`.
    pub fn is_itself(&self, b: &BaseParameter) -> bool {
        matches!(b.definition.as_slice(), [(j, f)] if *f == Fraction::one() && self.derivation.parameters[*j].name == b.name)
    }

    /// A confounded group in words: `o_ya and t_y1 only appear as t_y1 − o_ya (k6)`.
    pub fn group(&self, group: &Group) -> String {
        let parameter = |j: &ParameterId| self.printer.name(&self.derivation.parameters[*j].name);
        let base = |b: &BaseId| self.printer.name(&self.derivation.base[*b].name);
        let members = listed(group.parameters.iter().map(parameter).collect());
        match group.base.as_slice() {
            [] => format!("{members} do not appear"),
            [only] => format!(
                "{members} only appear as {} ({})",
                self.definition(&self.derivation.base[*only].definition),
                base(only)
            ),
            several => format!("{members} only appear in {}", listed(several.iter().map(base).collect())),
        }
    }

    /// A run's model equation, T(7) and T(9): known functions, then the base parameters.
    pub fn equation(&self, run: &DerivedRun) -> String {
        let known: Vec<(Fraction, String)> = run
            .known
            .iter()
            .map(|(f, p)| (Fraction::whole(p.clone()), self.error(self.model.functions[*f].error)))
            .collect();
        let estimated = self.estimated(run);
        let lumped = run.regressors.iter().filter(|(b, _)| self.is_lumped(*b));
        let lumped = lumped.map(|(b, r)| (r, self.printer.name(&self.derivation.base[*b].name)));
        self.printer.combination(
            known
                .iter()
                .map(|(f, n)| (f, n.clone()))
                .chain(estimated.iter().map(|(f, n)| (f, n.clone())))
                .chain(lumped),
        )
    }

    /// Whether a base parameter stands in the equation under its number.
    fn is_lumped(&self, base: BaseId) -> bool {
        let b = &self.derivation.base[base];
        b.lumped || b.estimates.is_none()
    }

    /// The estimated functions with their coefficients in the reading: `R·e_xa`.
    fn estimated(&self, run: &DerivedRun) -> Vec<(Fraction, String)> {
        let coefficient =
            |error: ErrorId| run.reading.by_errors().into_iter().find(|(m, _)| m.errors().next() == Some(error));
        // A location error that only sums have is in their base parameters.
        let alone = |id: FunctionId| {
            let own = |b: &BaseParameter| !b.lumped && b.estimates.is_some_and(|c| c.function == id);
            self.derivation.base.iter().any(own)
        };
        let functions = self.model.functions.iter_enumerated();
        let functions = functions.filter(|(id, f)| f.estimate && (!f.is_location() || alone(*id))).map(|(_, f)| f);
        functions.filter_map(|f| Some((Fraction::whole(coefficient(f.error)?.1), self.error(f.error)))).collect()
    }

    /// The motion errors' functions: a location error is one by itself.
    pub fn functions(&self) -> impl Iterator<Item = (FunctionId, &ErrorFunction)> {
        self.model.functions.iter_enumerated().filter(|(_, f)| !f.is_location())
    }

    /// An error's function written out in its coefficients, T(6) and T(10), of the coordinate `x`; `None` if it is not one.
    pub fn function(&self, id: FunctionId, x: &str) -> Option<String> {
        let f = &self.model.functions[id];
        let prefix = self.model.alphabet.error_name(f.error);
        match &f.basis {
            Basis::Zero => return Some(self.printer.number("0".to_owned())),
            Basis::Known => return None,
            Basis::Functions(_) if f.is_location() => return Some(self.printer.name(prefix)),
            Basis::Functions(_) => {}
        }
        let mut written = Written { printer: &self.printer, x };
        let term = |(suffix, f): (String, &BasisFunction)| {
            let name = self.printer.name(&format!("{prefix}{suffix}"));
            (false, self.printer.product(&[name, f.of(&mut written)]))
        };
        Some(self.printer.sum(f.basis.suffixes().zip(f.basis.functions()).map(term)))
    }

    /// The coordinate's letter of an axis error: `a` for the axis A.
    pub fn coordinate(&self, id: FunctionId) -> String {
        self.model.axis_of_function(id).map_or_else(|| "x".to_owned(), |(_, axis)| axis.coordinate.clone())
    }
}
