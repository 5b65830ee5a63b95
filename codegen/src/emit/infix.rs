//! What languages with infix operators and no macros have in common.

use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

use crate::graph::{Constant, Program, Rational, Step, Value, to_f64};

use super::layout::{WIDTH, terms};
use super::names::Names;

/// The words of a language.
pub(super) trait Dialect {
    fn constant(&self, constant: &Constant) -> String;
    fn function(&self, name: &'static str) -> String;
}

/// The function for whole turns, which no language has by itself.
pub(super) const WHOLE_TURNS: &str = "whole_turns";

/// An exact constant in decimal, or as the quotient that a compiler rounds correctly.
pub(super) fn decimal(r: &Rational) -> String {
    let decimal = |value: f64| format!("{value:?}");
    match quotient(r) {
        None => decimal(to_f64(r)),
        Some([numer, denom]) => format!("{} / {}", decimal(numer), decimal(denom)),
    }
}

/// Numerator and denominator of a constant that has no short decimal but is the quotient of two numbers that a compiler
/// reads exactly.
pub(super) fn quotient(r: &Rational) -> Option<[f64; 2]> {
    let exact = |n: &BigInt| n.bits() <= u64::from(f64::MANTISSA_DIGITS);
    let (numer, denom) = (r.numer(), r.denom());
    // A millionth, and so what divides it, has a decimal of few digits.
    let short = (BigInt::from(1_000_000) % &denom).is_zero();
    (!short && exact(&numer) && exact(&denom)).then_some([numer.to_f64()?, denom.to_f64()?])
}

/// How tightly the operators around a place bind what stands there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Operand,
    /// What a method is called on, where there are methods.
    Receiver,
}

/// A binary operator or a sign: how it binds, how tightly what stands right of it must be bound, its character. `None` for
/// functions. Operators group to the left, and grouping is rounding: what stands right of one is parenthesised.
pub(super) fn operator(step: Step) -> Option<(Binding, Binding, char)> {
    Some(match step {
        Step::Add(..) => (Binding::Sum, Binding::Product, '+'),
        Step::Sub(..) => (Binding::Sum, Binding::Product, '-'),
        Step::Mul(..) => (Binding::Product, Binding::Operand, '*'),
        Step::Div(..) => (Binding::Product, Binding::Operand, '/'),
        Step::Neg(_) => (Binding::Sum, Binding::Operand, '-'),
        Step::Sqrt(_) | Step::Sin(_) | Step::Cos(_) | Step::WholeTurns(_) => return None,
    })
}

/// Writes a program's expressions.
pub(super) struct Infix<'a, D> {
    pub program: &'a Program,
    pub names: &'a Names,
    pub dialect: D,
}

impl<D: Dialect> Infix<'_, D> {
    /// `start = expression end`, long expressions one term a line between `brackets`.
    pub(super) fn assigned(&self, start: &str, expression: &str, brackets: [&str; 2], end: &str) -> String {
        let [open, close] = brackets;
        match terms(expression, WIDTH.saturating_sub(start.len() + 3 + end.len())).as_slice() {
            [only] => format!("{start} = {only}{end}\n"),
            lines => {
                let lines: Vec<String> = lines.iter().map(|line| format!("        {line}")).collect();
                format!("{start} ={open}\n{}{close}{end}\n", lines.join("\n"))
            }
        }
    }

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

    fn write_step(&self, step: Step, room: Binding, text: &mut String) {
        let Some((binding, right, sign)) = operator(step) else {
            return self.call(step, text);
        };
        if room > binding {
            text.push('(');
        }
        match step {
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) | Step::Div(a, b) => {
                self.write(a, binding, text);
                text.extend([' ', sign, ' ']);
                self.write(b, right, text);
            }
            _ => {
                text.push(sign);
                step.operands().for_each(|a| self.write(a, right, text));
            }
        }
        if room > binding {
            text.push(')');
        }
    }

    fn call(&self, step: Step, text: &mut String) {
        let name = match step {
            Step::Sin(_) => "sin",
            Step::Cos(_) => "cos",
            Step::WholeTurns(_) => WHOLE_TURNS,
            _ => "sqrt",
        };
        *text += &self.dialect.function(name);
        text.push('(');
        step.operands().for_each(|a| self.write(a, Binding::Sum, text));
        text.push(')');
    }
}
