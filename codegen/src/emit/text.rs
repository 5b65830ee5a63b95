//! Infix text: plain (`1/2*R**2*s**3`, as Python and SymPy read it) and pretty (`1/2·R²·s³`).

use crate::graph::{Factor, Graph, Id, Node, Rational};

use super::parts::{Parts, of_factors, ordered};

/// Plain ASCII infix with `**`, `sqrt`, `atan2` and `pi`; symbols keep their names.
#[must_use]
pub fn plain(graph: &Graph, id: Id) -> String {
    write(graph, id, &Plain)
}

/// Unicode infix: superscripts, `·`, `−`, `√`, `π`; `name` says how a symbol is written.
#[must_use]
pub fn pretty(graph: &Graph, id: Id, name: &dyn Fn(&str) -> String) -> String {
    write(graph, id, &Pretty(name))
}

fn write(graph: &Graph, id: Id, style: &dyn Style) -> String {
    let mut writer = Writer { graph, style, text: String::new() };
    writer.expression(id, Binding::Sum);
    writer.text
}

/// What the surroundings can hold without parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Atom,
}

trait Style {
    fn symbol(&self, name: &str) -> String;
    fn power(&self, exponent: u32) -> String;
    fn times(&self) -> &'static str;
    fn minus(&self) -> &'static str;
    fn pi(&self) -> &'static str;
    fn root(&self) -> &'static str;
    fn root_of_two(&self) -> &'static str;
}

struct Plain;

impl Style for Plain {
    fn symbol(&self, name: &str) -> String {
        name.to_owned()
    }
    fn power(&self, exponent: u32) -> String {
        format!("**{exponent}")
    }
    fn times(&self) -> &'static str {
        "*"
    }
    fn minus(&self) -> &'static str {
        "-"
    }
    fn pi(&self) -> &'static str {
        "pi"
    }
    fn root(&self) -> &'static str {
        "sqrt"
    }
    fn root_of_two(&self) -> &'static str {
        "sqrt(2)"
    }
}

struct Pretty<'a>(&'a dyn Fn(&str) -> String);

impl Style for Pretty<'_> {
    fn symbol(&self, name: &str) -> String {
        (self.0)(name)
    }
    fn power(&self, exponent: u32) -> String {
        let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let decimal = exponent.to_string();
        decimal.chars().filter_map(|digit| digits.get(digit.to_digit(10)? as usize)).collect()
    }
    fn times(&self) -> &'static str {
        "·"
    }
    fn minus(&self) -> &'static str {
        "−"
    }
    fn pi(&self) -> &'static str {
        "π"
    }
    fn root(&self) -> &'static str {
        "√"
    }
    fn root_of_two(&self) -> &'static str {
        "√2"
    }
}

struct Writer<'a> {
    graph: &'a Graph,
    style: &'a dyn Style,
    text: String,
}

impl Writer<'_> {
    fn expression(&mut self, id: Id, room: Binding) {
        let graph = self.graph;
        match graph.node(id) {
            Node::Symbol(symbol) => self.text += &self.style.symbol(graph.name(*symbol)),
            Node::Pi => self.text += self.style.pi(),
            Node::Sqrt2 => self.text += self.style.root_of_two(),
            Node::Rational(r) => self.signed(&of_factors(r, &[]), room),
            Node::Product(coefficient, factors) => self.product(coefficient, factors, room),
            Node::Sum(terms) => {
                self.open(room > Binding::Sum);
                for (at, part) in ordered(graph, terms).iter().enumerate() {
                    match (at, part.negative) {
                        (0, false) => {}
                        (0, true) => self.text += self.style.minus(),
                        (_, false) => self.text += " + ",
                        (_, true) => {
                            self.text.push(' ');
                            self.text += self.style.minus();
                            self.text.push(' ');
                        }
                    }
                    self.size(part);
                }
                self.close(room > Binding::Sum);
            }
            Node::Sqrt(u) => self.call(self.style.root(), &[*u]),
            Node::Sin(u) => self.call("sin", &[*u]),
            Node::Cos(u) => self.call("cos", &[*u]),
            Node::Atan2(y, x) => self.call("atan2", &[*y, *x]),
        }
    }

    fn open(&mut self, needed: bool) {
        if needed {
            self.text.push('(');
        }
    }

    fn close(&mut self, needed: bool) {
        if needed {
            self.text.push(')');
        }
    }

    fn call(&mut self, function: &str, arguments: &[Id]) {
        self.text += function;
        self.text.push('(');
        for (at, &argument) in arguments.iter().enumerate() {
            self.text += if at > 0 { ", " } else { "" };
            self.expression(argument, Binding::Sum);
        }
        self.text.push(')');
    }

    fn product(&mut self, coefficient: &Rational, factors: &[Factor], room: Binding) {
        self.signed(&of_factors(coefficient, factors), room);
    }

    fn signed(&mut self, parts: &Parts, room: Binding) {
        let factors = parts.over.len() + parts.under.len() + usize::from(parts.denom > 1);
        let atom = factors == 0 || (factors == 1 && parts.over.len() == 1 && parts.numer == 1 && parts.over[0].1 == 1);
        let parenthesised = if parts.negative { room > Binding::Sum } else { room > Binding::Product && !atom };
        self.open(parenthesised);
        if parts.negative {
            self.text += self.style.minus();
        }
        self.size(parts);
        self.close(parenthesised);
    }

    /// Without the sign: `1/2*x*y`, `x/(2*y)`.
    fn size(&mut self, parts: &Parts) {
        let Parts { numer, denom, over, under, .. } = parts;
        let below = if under.is_empty() { 1 } else { *denom };
        let above = if under.is_empty() { *denom } else { 1 };
        let has_number = *numer != 1 || above != 1 || over.is_empty();
        if has_number {
            self.text += &numer.to_string();
        }
        if above != 1 {
            self.text += &format!("/{above}");
        }
        self.factors(over, has_number);
        if under.is_empty() {
            return;
        }
        let several = under.len() + usize::from(below != 1) > 1;
        self.text.push('/');
        self.open(several);
        if below != 1 {
            self.text += &below.to_string();
        }
        self.factors(under, below != 1);
        self.close(several);
    }

    fn factors(&mut self, factors: &[(Id, u32)], mut after: bool) {
        for &(base, exponent) in factors {
            self.text += if after { self.style.times() } else { "" };
            after = true;
            self.expression(base, Binding::Atom);
            if exponent != 1 {
                self.text += &self.style.power(exponent);
            }
        }
    }
}
