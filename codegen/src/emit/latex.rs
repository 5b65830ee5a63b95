//! LaTeX for display mathematics.

use crate::graph::{Graph, Id, Node};

use super::parts::{Parts, of_factors, ordered};

/// The expression in LaTeX; `name` gives a symbol's LaTeX (`a` → `\alpha`, `d_yy1` → `\delta_{yy1}`).
#[must_use]
pub fn latex(graph: &Graph, id: Id, name: &dyn Fn(&str) -> String) -> String {
    let mut writer = Writer { graph, name, text: String::new() };
    writer.expression(id);
    writer.text
}

struct Writer<'a> {
    graph: &'a Graph,
    name: &'a dyn Fn(&str) -> String,
    text: String,
}

impl Writer<'_> {
    fn expression(&mut self, id: Id) {
        let graph = self.graph;
        match graph.node(id) {
            Node::Symbol(symbol) => self.text += &(self.name)(graph.name(*symbol)),
            Node::Pi => self.text += "\\pi",
            Node::Sqrt2 => self.text += "\\sqrt{2}",
            Node::Rational(r) => self.signed(&of_factors(r, &[])),
            Node::Product(coefficient, factors) => self.signed(&of_factors(coefficient, factors)),
            Node::Sum(terms) => {
                for (at, part) in ordered(graph, terms).iter().enumerate() {
                    self.text += match (at, part.negative) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    };
                    self.size(part);
                }
            }
            Node::Sqrt(u) => {
                self.text += "\\sqrt{";
                self.expression(*u);
                self.text.push('}');
            }
            Node::Sin(_) | Node::Cos(_) | Node::Atan2(..) => self.raised(id, 1),
        }
    }

    fn bracketed(&mut self, id: Id) {
        self.text += "\\left(";
        self.expression(id);
        self.text += "\\right)";
    }

    fn signed(&mut self, parts: &Parts) {
        if parts.negative {
            self.text.push('-');
        }
        self.size(parts);
    }

    /// Without the sign: a fraction of numbers before the factors, or one fraction of all.
    fn size(&mut self, parts: &Parts) {
        let Parts { numer, denom, over, under, .. } = parts;
        if under.is_empty() {
            let has_number = (*numer, *denom) != (1, 1) || over.is_empty();
            if *denom != 1 {
                self.text += &format!("\\frac{{{numer}}}{{{denom}}}");
            } else if has_number {
                self.text += &numer.to_string();
            }
            self.factors(over, has_number);
            return;
        }
        for (open, number, factors) in [("\\frac{", numer, over), ("}{", denom, under)] {
            self.text += open;
            // The fraction's line groups what stands alone above or below it.
            if let (1, [(base, 1)]) = (*number, factors.as_slice()) {
                self.expression(*base);
                continue;
            }
            let has_number = *number != 1 || factors.is_empty();
            if has_number {
                self.text += &number.to_string();
            }
            self.factors(factors, has_number);
        }
        self.text.push('}');
    }

    /// Functions last: `\sin a\,R` would read as the sine of a product.
    fn factors(&mut self, factors: &[(Id, u32)], mut after: bool) {
        let is_function = |id: Id| matches!(self.graph.node(id), Node::Sin(_) | Node::Cos(_) | Node::Atan2(..));
        let (functions, plain): (Vec<_>, Vec<_>) = factors.iter().partition(|(base, _)| is_function(*base));
        for (base, exponent) in plain.into_iter().chain(functions) {
            self.text += if after { " " } else { "" };
            after = true;
            self.raised(base, exponent);
        }
    }

    fn raised(&mut self, base: Id, exponent: u32) {
        let graph = self.graph;
        let power = if exponent == 1 { String::new() } else { format!("^{{{exponent}}}") };
        match graph.node(base) {
            Node::Sin(u) | Node::Cos(u) => {
                let sine = matches!(graph.node(base), Node::Sin(_));
                self.text += if sine { "\\sin" } else { "\\cos" };
                self.text += &power;
                if matches!(graph.node(*u), Node::Symbol(_) | Node::Pi) {
                    self.text.push(' ');
                    self.expression(*u);
                } else {
                    self.bracketed(*u);
                }
            }
            Node::Atan2(y, x) => {
                self.text += "\\operatorname{atan2}";
                self.text += &power;
                self.text += "\\left(";
                self.expression(*y);
                self.text += ", ";
                self.expression(*x);
                self.text += "\\right)";
            }
            // Braces keep a superscript of the name's own apart from the power.
            Node::Symbol(_) if exponent != 1 => {
                let before = self.text.len();
                self.expression(base);
                if self.text[before..].contains('^') {
                    self.text.insert(before, '{');
                    self.text.push('}');
                }
                self.text += &power;
            }
            Node::Symbol(_) | Node::Pi | Node::Sqrt2 | Node::Sqrt(_) => {
                self.expression(base);
                self.text += &power;
            }
            Node::Sum(_) | Node::Product(..) | Node::Rational(_) => {
                self.bracketed(base);
                self.text += &power;
            }
        }
    }
}
