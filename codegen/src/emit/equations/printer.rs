//! Polynomials and fractions as people write them.

use crate::algebra::{Alphabet, Fraction, Monomial, Nominal, Poly, Rational};
use crate::source::visible;
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
    /// `<msup><mi>R</mi><mn>2</mn></msup>…`: elements of MathML Core. Terms of a sum have blanks between them, nothing else has.
    MathMl,
}

/// How a name is typeset: a name that another could be taken for stands upright as it is.
enum Typeset<'a> {
    Letter(&'a str),
    Indexed(&'a str, String),
    Upright(&'a str),
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
            Style::Latex | Style::MathMl => self.over(&n, &d),
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
                (false, false) => out.extend([" ", self.plus(), " "]),
                (false, true) => out.extend([" ", minus, " "]),
            }
            out.push_str(&text);
        }
        if out.is_empty() { self.number("0".to_owned()) } else { out }
    }

    /// The sign between terms.
    pub fn plus(&self) -> &'static str {
        if self.style == Style::MathMl { "<mo>+</mo>" } else { "+" }
    }

    /// The sign of a negative term.
    pub fn minus(&self) -> &'static str {
        match self.style {
            Style::Plain | Style::Latex => "-",
            Style::Pretty => "−",
            Style::MathMl => "<mo>−</mo>",
        }
    }

    /// A whole number.
    pub fn number(&self, digits: String) -> String {
        if self.style == Style::MathMl { format!("<mn>{digits}</mn>") } else { digits }
    }

    /// A quotient that is typeset as one.
    fn over(&self, above: &str, below: &str) -> String {
        match self.style {
            Style::MathMl => format!("<mfrac><mrow>{above}</mrow><mrow>{below}</mrow></mfrac>"),
            _ => format!("\\frac{{{above}}}{{{below}}}"),
        }
    }

    /// Factors side by side.
    pub fn product(&self, factors: &[String]) -> String {
        factors.join(match self.style {
            Style::Plain => "*",
            Style::Pretty => "·",
            Style::Latex => " ",
            Style::MathMl => INVISIBLE_TIMES,
        })
    }

    /// `(x)`
    pub fn parenthesised(&self, x: &str) -> String {
        match self.style {
            Style::Latex => format!("\\left({x}\\right)"),
            Style::MathMl => format!("<mrow><mo>(</mo>{x}<mo>)</mo></mrow>"),
            _ => format!("({x})"),
        }
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
            above.insert(0, self.number(n.to_string()));
        }
        if !d.is_one() {
            below.insert(0, self.number(d.to_string()));
        }
        match (self.style, below.len()) {
            (_, 0) => self.product(&above),
            (Style::Latex | Style::MathMl, _) => self.over(&self.product(&above), &self.product(&below)),
            (_, 1) => format!("{}/{}", self.product(&above), below[0]),
            _ => format!("{}/({})", self.product(&above), self.product(&below)),
        }
    }

    fn power(&self, base: &str, exponent: u8) -> String {
        match (exponent, self.style) {
            (1, _) => base.to_owned(),
            (_, Style::Plain) => format!("{base}**{exponent}"),
            (_, Style::Latex) => format!("{base}^{{{exponent}}}"),
            (_, Style::MathMl) => format!("<msup>{base}<mn>{exponent}</mn></msup>"),
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
            (Style::MathMl, Nominal::Pi) => "<mi>π</mi>".to_owned(),
            (Style::MathMl, Nominal::Root2) => "<msqrt><mn>2</mn></msqrt>".to_owned(),
            // As a function where it has no letter of its own.
            (Style::Latex | Style::MathMl, Nominal::Sin(_) | Nominal::Cos(_)) if plain.ends_with(')') => {
                let (function, sweep) = (plain.get(..3), plain.get(4..plain.len() - 1).unwrap_or_default());
                self.applied(function.unwrap_or_default(), &format!("({})", self.name(sweep)))
            }
            _ => self.name(plain),
        }
    }

    /// A function of what follows it.
    pub fn applied(&self, function: &str, to: &str) -> String {
        match (self.style, to.strip_prefix('(').and_then(|to| to.strip_suffix(')'))) {
            (Style::Latex, None) => format!("\\{function} {to}"),
            (Style::Latex, Some(_)) => format!("\\{function}{to}"),
            (Style::MathMl, None) => format!("<mrow><mi>{function}</mi><mo>&#x2061;</mo><mrow>{to}</mrow></mrow>"),
            (Style::MathMl, Some(to)) => {
                format!("<mrow><mi>{function}</mi><mo>&#x2061;</mo>{}</mrow>", self.parenthesised(to))
            }
            (_, None) => format!("{function}({to})"),
            (_, Some(_)) => format!("{function}{to}"),
        }
    }

    /// A name: `d_yy1` in LaTeX is `d_{yy1}`, `EYY` is `E_{YY}`, `ECC_cos1` is `E_{CC,cos1}`, `k1` is `k_{1}`, the same in MathML.
    /// A name that another could be taken for stands upright as it is: `k_1`, `E_YY`, `length`.
    pub fn name(&self, name: &str) -> String {
        let underscored = |text: &str| text.replace('_', "\\_");
        match (self.style, typeset(name)) {
            (Style::Plain | Style::Pretty, _) => name.to_owned(),
            (Style::Latex, Typeset::Letter(letter)) => letter.to_owned(),
            (Style::Latex, Typeset::Indexed(letter, index)) => format!("{letter}_{{{}}}", underscored(&index)),
            (Style::Latex, Typeset::Upright(name)) => format!("\\mathrm{{{}}}", underscored(name)),
            (Style::MathMl, Typeset::Letter(letter)) => format!("<mi>{}</mi>", escaped(letter)),
            (Style::MathMl, Typeset::Indexed(letter, index)) => {
                indexed(&format!("<mi>{}</mi>", escaped(letter)), &index)
            }
            (Style::MathMl, Typeset::Upright(name)) => format!("<mtext>{}</mtext>", escaped(name)),
        }
    }
}

/// A product's sign: nothing is seen of it but that its factors are two.
const INVISIBLE_TIMES: &str = "<mo lspace=\"0.08em\" rspace=\"0.08em\">&#x2062;</mo>";

/// An element of MathML with an index.
pub(super) fn indexed(element: &str, index: &str) -> String {
    format!("<msub>{element}<mtext>{}</mtext></msub>", escaped(index))
}

/// A text within elements.
fn escaped(text: &str) -> String {
    visible(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn typeset(name: &str) -> Typeset<'_> {
    let is_iso =
        |n: &str| n.len() > 2 && n.starts_with('E') && n.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit());
    if let Some((iso, tail)) = name.split_once('_').filter(|(iso, _)| is_iso(iso)) {
        return Typeset::Indexed("E", format!("{},{tail}", &iso[1..]));
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
        1 if !alike && tail.is_empty() => Typeset::Letter(head),
        1 if !alike => Typeset::Indexed(head, tail.to_owned()),
        _ => Typeset::Upright(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Order, Quantity};
    use crate::model::{Scope, parse};

    #[test]
    fn every_style() {
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
        let times = INVISIBLE_TIMES;
        let (e, r) = ("<msub><mi>e</mi><mtext>xy</mtext></msub>", "<mi>R</mi>");
        let above = ["<mn>3</mn>", "<mi>π</mi>", "<msqrt><mn>2</mn></msqrt>", "<msup><mi>s</mi><mn>3</mn></msup>", e];
        let (above, below) = (above.join(times), ["<mn>2</mn>", r].join(times));
        let quotient = format!("<mfrac><mrow>{above}</mrow><mrow>{below}</mrow></mfrac>");
        let expected = format!("<mo>−</mo>{quotient} <mo>+</mo> {}", [r, "<mi>a</mi>", e].join(times));
        assert_eq!(print(Style::MathMl), expected);
    }
}
