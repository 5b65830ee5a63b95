//! Functions of a coordinate, written as factors.

use super::printer::{Printer, Style};
use crate::algebra::Fraction;
use crate::basis::{Arithmetic, Univariate};

/// Writes functions of the coordinate `x`.
pub(super) struct Written<'a> {
    pub printer: &'a Printer<'a>,
    pub x: &'a str,
}

impl Written<'_> {
    fn power(&self, n: usize) -> String {
        let x = self.x;
        match (n, self.printer.style) {
            (1, _) => x.to_owned(),
            (_, Style::Latex) => format!("{x}^{{{n}}}"),
            (_, Style::MathMl) => format!("<msup>{x}<mn>{n}</mn></msup>"),
            (_, Style::Plain) => format!("{x}**{n}"),
            (_, Style::Pretty) => format!(
                "{x}{}",
                ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'].get(n).map_or(format!("^{n}"), char::to_string)
            ),
        }
    }

    fn wave(&self, name: &str, multiple: u8) -> String {
        let times = match multiple {
            1 => self.x.to_owned(),
            k => self.printer.product(&[self.printer.number(k.to_string()), self.x.to_owned()]),
        };
        self.printer.applied(name, &times)
    }
}

impl Arithmetic for Written<'_> {
    type Value = String;

    /// Highest power first, in parentheses if it is a sum.
    fn polynomial(&mut self, f: &Univariate) -> String {
        let terms = f.0.iter().enumerate().rev().filter(|(_, c)| !c.is_zero());
        let terms: Vec<(Fraction, usize)> = terms.map(|(n, c)| (Fraction::whole(c.clone()), n)).collect();
        let constant = terms.iter().find(|(_, n)| *n == 0).map(|(f, _)| f);
        let powers = terms.iter().filter(|(_, n)| *n > 0).map(|(f, n)| (f, self.power(*n)));
        let powers = self.printer.combination(powers);
        match (constant, terms.len()) {
            (None, 0 | 1) => powers,
            (None, _) => self.printer.parenthesised(&powers),
            (Some(c), 1) => self.printer.fraction(c),
            (Some(c), _) => {
                let negative = c.numerator().printed().first().is_some_and(|(_, c)| c.is_negative());
                let (sign, size) =
                    if negative { (self.printer.minus(), c.negated()) } else { (self.printer.plus(), c.clone()) };
                let several = size.numerator().terms().len() > 1 && negative;
                let size = self.printer.fraction(&size);
                let size = if several { self.printer.parenthesised(&size) } else { size };
                self.printer.parenthesised(&format!("{powers} {sign} {size}"))
            }
        }
    }

    fn cosine(&mut self, multiple: u8) -> String {
        self.wave("cos", multiple)
    }

    fn sine(&mut self, multiple: u8) -> String {
        self.wave("sin", multiple)
    }
}
