//! Polynomials and fractions as people write them.

use crate::algebra::{Alphabet, Fraction, Monomial, Nominal, Poly, Rational};
use num_traits::One;

/// How an expression is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// `R**2*s**3`: ASCII, read by Python and SymPy.
    Plain,
    /// `R²·s³`
    Pretty,
    /// `R^{2}s^{3}`
    Latex,
}

/// Writes expressions over one alphabet in one style.
#[derive(Clone, Copy)]
pub struct Printer<'a> {
    /// The symbols.
    pub alphabet: &'a Alphabet,
    /// The style.
    pub style: Style,
}

impl Printer<'_> {
    /// A polynomial, the terms of highest degree in the sweep first.
    pub fn poly(&self, p: &Poly) -> String {
        self.sum(p.printed().into_iter().map(|(m, c)| (c.is_negative(), self.term(&m, &c))))
    }

    /// A quotient.
    pub fn fraction(&self, f: &Fraction) -> String {
        let Some(denominator) = f.denominator() else { return self.poly(f.numerator()) };
        let (n, d) = (self.poly(f.numerator()), self.poly(denominator));
        match self.style {
            Style::Latex => format!("\\frac{{{n}}}{{{d}}}"),
            _ if f.numerator().terms().len() == 1 => format!("{n}/({d})"),
            _ => format!("({n})/({d})"),
        }
    }

    /// `Σ factor · name`, names bare where the factor is ±1.
    pub fn combination<'n>(&self, terms: impl Iterator<Item = (&'n Fraction, String)>) -> String {
        self.sum(terms.map(|(factor, name)| {
            // A denominator's leading coefficient is 1: the numerator has the sign.
            let negative = matches!(factor.numerator().terms(), [(_, c)] if c.is_negative());
            let size = if negative { factor.negated() } else { factor.clone() };
            let text = match size.numerator().as_number().filter(|_| size.denominator().is_none()) {
                Some(n) if n.is_one() => name,
                _ if size.numerator().terms().len() > 1 && size.denominator().is_none() => {
                    self.product(&[self.parenthesised(&self.fraction(&size)), name])
                }
                _ => self.product(&[self.fraction(&size), name]),
            };
            (negative, text)
        }))
    }

    /// Terms joined by their signs; a term is given without its sign.
    pub fn sum(&self, terms: impl Iterator<Item = (bool, String)>) -> String {
        let mut out = String::new();
        for (negative, text) in terms {
            let minus = self.minus();
            match (out.is_empty(), negative) {
                (true, false) => {}
                (true, true) => out.push_str(minus),
                (false, false) => out.push_str(" + "),
                (false, true) => out.extend([" ", minus, " "]),
            }
            out.push_str(&text);
        }
        if out.is_empty() { "0".to_owned() } else { out }
    }

    /// The sign of a negative term.
    pub fn minus(&self) -> &'static str {
        if self.style == Style::Pretty { "−" } else { "-" }
    }

    /// Factors side by side.
    pub fn product(&self, factors: &[String]) -> String {
        factors.join(match self.style {
            Style::Plain => "*",
            Style::Pretty => "·",
            Style::Latex => " ",
        })
    }

    /// `(x)`
    pub fn parenthesised(&self, x: &str) -> String {
        if self.style == Style::Latex { format!("\\left({x}\\right)") } else { format!("({x})") }
    }

    /// A term without its sign.
    fn term(&self, m: &Monomial, c: &Rational) -> String {
        let (n, d) = (c.abs().numer(), c.denom());
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (id, nominal) in self.alphabet.nominals() {
            let exponent = m.exponent(id);
            if exponent != 0 {
                let side = if exponent > 0 { &mut above } else { &mut below };
                side.push(self.power(&self.nominal(nominal, &self.alphabet.nominal_name(id)), exponent.unsigned_abs()));
            }
        }
        above.extend(m.errors().map(|e| self.name(self.alphabet.error_name(e))));
        if !n.is_one() || above.is_empty() {
            above.insert(0, n.to_string());
        }
        if !d.is_one() {
            below.insert(0, d.to_string());
        }
        match (self.style, below.len()) {
            (_, 0) => self.product(&above),
            (Style::Latex, _) => format!("\\frac{{{}}}{{{}}}", self.product(&above), self.product(&below)),
            (_, 1) => format!("{}/{}", self.product(&above), below[0]),
            _ => format!("{}/({})", self.product(&above), self.product(&below)),
        }
    }

    fn power(&self, base: &str, exponent: u8) -> String {
        match (exponent, self.style) {
            (1, _) => base.to_owned(),
            (_, Style::Plain) => format!("{base}**{exponent}"),
            (_, Style::Latex) => format!("{base}^{{{exponent}}}"),
            (_, Style::Pretty) => {
                let digit = |d: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d.to_digit(10).unwrap_or(0) as usize);
                base.chars().chain(exponent.to_string().chars().filter_map(digit)).collect()
            }
        }
    }

    fn nominal(&self, nominal: &Nominal, plain: &str) -> String {
        match (self.style, nominal) {
            (Style::Plain, _) => plain.to_owned(),
            (Style::Pretty, Nominal::Pi) => "π".to_owned(),
            (Style::Pretty, Nominal::Root2) => "√2".to_owned(),
            (Style::Latex, Nominal::Pi) => "\\pi".to_owned(),
            (Style::Latex, Nominal::Root2) => "\\sqrt{2}".to_owned(),
            // As a function where it has no letter of its own.
            (Style::Latex, Nominal::Sin(_) | Nominal::Cos(_)) if plain.ends_with(')') => {
                let sweep = plain.get(4..plain.len() - 1).unwrap_or_default();
                format!("\\{}({})", plain.get(..3).unwrap_or_default(), self.name(sweep))
            }
            _ => self.name(plain),
        }
    }

    /// A name: `d_yy1` in LaTeX is `d_{yy1}`, `EYY` is `E_{YY}`, `ECC_cos1` is `E_{CC,cos1}`, `k1` is `k_{1}`. A name that another
    /// could be taken for stands upright as it is: `k_1`, `E_YY`, `length`.
    pub fn name(&self, name: &str) -> String {
        if self.style != Style::Latex {
            return name.to_owned();
        }
        let is_iso = |n: &str| {
            n.len() > 2 && n.starts_with('E') && n.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit())
        };
        let escaped = |text: &str| text.replace('_', "\\_");
        if let Some((iso, tail)) = name.split_once('_').filter(|(iso, _)| is_iso(iso)) {
            return format!("E_{{{},{}}}", &iso[1..], escaped(tail));
        }
        let digits = || name.find(|c: char| c.is_ascii_digit()).unwrap_or(name.len());
        let (head, tail, alike) = match name.split_once('_') {
            Some((head, tail)) => {
                let joined = format!("{head}{tail}");
                (head, tail, tail.is_empty() || tail.starts_with(|c: char| c.is_ascii_digit()) || is_iso(&joined))
            }
            None => {
                let (head, tail) = name.split_at(if is_iso(name) { 1 } else { digits() });
                (head, tail, false)
            }
        };
        match head.len() {
            1 if !alike && tail.is_empty() => head.to_owned(),
            1 if !alike => format!("{head}_{{{}}}", escaped(tail)),
            _ => format!("\\mathrm{{{}}}", escaped(name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Order, Quantity};
    use crate::model::{Scope, parse};

    #[test]
    fn three_styles() {
        let mut alphabet = Alphabet::default();
        alphabet.constant("R").unwrap();
        let sweep = alphabet.sweep("a").unwrap();
        let e = Poly::error(alphabet.error("e_xy", Quantity::Angle).unwrap());
        let nominal = Scope { alphabet: &alphabet, sweep: Some(sweep), defined: &[] }
            .poly(&parse("-3*sqrt(2)*pi*R**2*sin(a)**3/(2*R**3) + R*a").unwrap())
            .unwrap();
        let p = nominal.times(&e, Order::LINEAR).unwrap();
        let print = |style| Printer { alphabet: &alphabet, style }.poly(&p);
        assert_eq!(print(Style::Plain), "-3*pi*sqrt(2)*s**3*e_xy/(2*R) + R*a*e_xy");
        assert_eq!(print(Style::Pretty), "−3·π·√2·s³·e_xy/(2·R) + R·a·e_xy");
        assert_eq!(print(Style::Latex), "-\\frac{3 \\pi \\sqrt{2} s^{3} e_{xy}}{2 R} + R a e_{xy}");
    }
}
