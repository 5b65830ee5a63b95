//! What languages with infix operators and no macros have in common.

use crate::graph::{Constant, Program, Rational, Step, Value, to_f64};

use super::names::Names;

/// The words of a language.
pub(super) trait Dialect {
    fn constant(&self, constant: &Constant) -> String;
    fn function(&self, name: &'static str) -> String;
}

/// An exact constant in decimal, or as the quotient that a compiler rounds correctly.
pub(super) fn decimal(r: &Rational) -> String {
    let exact = |n: i128| n.unsigned_abs() <= 1 << 53;
    let decimal = |value: f64| format!("{value:?}");
    if *r.denom() == 1 || !exact(*r.numer()) || !exact(*r.denom()) || terminates(*r.denom()) {
        return decimal(to_f64(r));
    }
    format!("{} / {}", decimal(*r.numer() as f64), decimal(*r.denom() as f64))
}

/// Whether n-ths have a decimal of few digits.
pub(super) fn terminates(n: i128) -> bool {
    n > 0 && 1_000_000 % n == 0
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Operand,
}

pub(super) struct Writer<'a, D> {
    pub program: &'a Program,
    pub names: &'a Names,
    pub dialect: D,
}

impl<D: Dialect> Writer<'_, D> {
    /// A step's own expression, for the line that names it.
    pub(super) fn step(&self, at: usize) -> String {
        let mut text = String::new();
        self.write_step(self.program.steps()[at], Binding::Sum, &mut text);
        text
    }

    pub(super) fn value(&self, value: Value) -> String {
        let mut text = String::new();
        self.write(value, Binding::Sum, &mut text);
        text
    }

    fn write(&self, value: Value, room: Binding, text: &mut String) {
        match value {
            Value::Input(at) => *text += &self.names.inputs[at as usize],
            Value::Constant(at) => {
                let constant = self.dialect.constant(&self.program.constants()[at as usize]);
                let quotient = constant.contains(" / ") && !constant.ends_with(')') && room > Binding::Sum;
                *text += &if quotient { format!("({constant})") } else { constant };
            }
            Value::Step(at) => match &self.names.steps[at as usize] {
                Some(name) => *text += name,
                None => self.write_step(self.program.steps()[at as usize], room, text),
            },
        }
    }

    /// Operators group to the left, and grouping is rounding: what stands right of one is parenthesised.
    fn write_step(&self, step: Step, room: Binding, text: &mut String) {
        let (binding, right, operator) = match step {
            Step::Add(..) => (Binding::Sum, Binding::Product, " + "),
            Step::Sub(..) => (Binding::Sum, Binding::Product, " - "),
            Step::Mul(..) => (Binding::Product, Binding::Operand, " * "),
            Step::Div(..) => (Binding::Product, Binding::Operand, " / "),
            Step::Neg(_) => (Binding::Sum, Binding::Operand, "-"),
            Step::Sqrt(_) => return self.call("sqrt", step, text),
            Step::Sin(_) => return self.call("sin", step, text),
            Step::Cos(_) => return self.call("cos", step, text),
        };
        if room > binding {
            text.push('(');
        }
        match step {
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) | Step::Div(a, b) => {
                self.write(a, binding, text);
                *text += operator;
                self.write(b, right, text);
            }
            _ => {
                *text += operator;
                step.operands().for_each(|a| self.write(a, right, text));
            }
        }
        if room > binding {
            text.push(')');
        }
    }

    fn call(&self, function: &'static str, step: Step, text: &mut String) {
        *text += &self.dialect.function(function);
        text.push('(');
        for (at, operand) in step.operands().enumerate() {
            *text += if at > 0 { ", " } else { "" };
            self.write(operand, Binding::Sum, text);
        }
        text.push(')');
    }
}
