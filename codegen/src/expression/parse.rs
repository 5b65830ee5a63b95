//! From a text to an expression.

use super::{Expected, Expr, ExprKind, Operator, SyntaxError};
use crate::limits::{NESTING, OPERATORS};
use crate::source::Span;

/// Parses a whole text.
pub fn parse(text: &str) -> Result<Expr, SyntaxError> {
    let mut parser = Parser { text, at: 0, depth: 0, operators: 0 };
    let expr = parser.sum()?;
    parser.blanks();
    if parser.at < text.len() { Err(parser.error(Expected::Operator)) } else { Ok(expr) }
}

/// Parses `left = right`; spans count from the start of the text.
pub fn parse_equation(text: &str) -> Result<(Expr, Expr), SyntaxError> {
    let equals: Vec<usize> = text.match_indices('=').map(|(i, _)| i).collect();
    let [at] = equals.as_slice() else {
        return Err(SyntaxError { span: 0..text.len(), expected: Expected::Equation });
    };
    let right = parse(&text[at + 1..]).map_err(|e| SyntaxError { span: shift(e.span, at + 1), ..e })?;
    Ok((parse(&text[..*at])?, right))
}

fn shift(span: Span, by: usize) -> Span {
    span.start + by..span.end + by
}

/// Recursive descent: sum → product → signed → power → operand.
struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    operators: usize,
}

impl Parser<'_> {
    fn blanks(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn error(&self, expected: Expected) -> SyntaxError {
        let width = self.text[self.at..].chars().next().map_or(0, char::len_utf8);
        SyntaxError { span: self.at..self.at + width, expected }
    }

    fn take(&mut self, token: &str) -> bool {
        self.blanks();
        let found = self.text[self.at..].starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> &str {
        let rest = &self.text[self.at..];
        let length = rest.find(|c| !keep(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn sum(&mut self) -> Result<Expr, SyntaxError> {
        let mut left = self.product()?;
        loop {
            let operator = match () {
                () if self.take("+") => Operator::Plus,
                () if self.take("-") => Operator::Minus,
                () => return Ok(left),
            };
            left = self.binary(operator, left, Self::product)?;
        }
    }

    fn product(&mut self) -> Result<Expr, SyntaxError> {
        let mut left = self.signed()?;
        loop {
            let operator = match () {
                () if self.take("*") => Operator::Times,
                () if self.take("/") => Operator::Over,
                () => return Ok(left),
            };
            left = self.binary(operator, left, Self::signed)?;
        }
    }

    /// With the operand on the right. As many operators as there are may be the depth of the tree.
    fn binary(
        &mut self,
        operator: Operator,
        left: Expr,
        right: fn(&mut Self) -> Result<Expr, SyntaxError>,
    ) -> Result<Expr, SyntaxError> {
        self.operators += 1;
        if self.operators > OPERATORS {
            return Err(self.error(Expected::FewerOperators));
        }
        let right = right(self)?;
        let span = left.span.start..right.span.end;
        Ok(Expr { node: ExprKind::Binary(operator, Box::new(left), Box::new(right)), span })
    }

    fn signed(&mut self) -> Result<Expr, SyntaxError> {
        self.depth += 1;
        if self.depth > NESTING {
            return Err(self.error(Expected::ShallowerNesting));
        }
        self.blanks();
        let start = self.at;
        let expr = if self.take("-") {
            let inner = self.signed()?;
            let span = start..inner.span.end;
            Ok(Expr { node: ExprKind::Negative(Box::new(inner)), span })
        } else {
            self.power()
        };
        self.depth -= 1;
        expr
    }

    fn power(&mut self) -> Result<Expr, SyntaxError> {
        let base = self.operand()?;
        if self.take("**") || self.take("^") {
            return self.binary(Operator::Power, base, Self::signed);
        }
        Ok(base)
    }

    fn operand(&mut self) -> Result<Expr, SyntaxError> {
        self.blanks();
        let start = self.at;
        if self.take("(") {
            let inner = self.sum()?;
            return if self.take(")") {
                Ok(Expr { span: start..self.at, ..inner })
            } else {
                Err(self.error(Expected::Closing))
            };
        }
        match self.text[start..].chars().next() {
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(start),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(start),
            _ => Err(self.error(Expected::Operand)),
        }
    }

    fn number(&mut self, start: usize) -> Result<Expr, SyntaxError> {
        let whole = self.take_while(|c| c.is_ascii_digit()).to_owned();
        let point = self.text[self.at..].starts_with('.');
        self.at += usize::from(point);
        let decimals = if point { self.take_while(|c| c.is_ascii_digit()).to_owned() } else { String::new() };
        let digits = format!("{whole}{decimals}");
        let span = start..self.at;
        if digits.is_empty() {
            return Err(SyntaxError { span, expected: Expected::Operand });
        }
        match digits.parse() {
            Ok(n) if digits.len() <= 30 => {
                Ok(Expr { node: ExprKind::Number(n, 10i128.pow(decimals.len() as u32)), span })
            }
            _ => Err(SyntaxError { span, expected: Expected::ShorterNumber }),
        }
    }

    fn name(&mut self, start: usize) -> Result<Expr, SyntaxError> {
        let name = self.take_while(|c| c.is_alphanumeric() || c == '_').to_owned();
        let primes = self.take_while(|c| c == '\'').len() as u32;
        if !self.take("(") {
            let node = if primes == 0 { ExprKind::Name(name) } else { return Err(self.error(Expected::Operand)) };
            return Ok(Expr {
                node,
                span: start
                    ..start
                        + self.text[start..]
                            .find(|c: char| !(c.is_alphanumeric() || c == '_'))
                            .unwrap_or(self.text.len() - start),
            });
        }
        let argument = self.sum()?;
        if name == "atan2" && primes == 0 && self.take(",") {
            let cosine = self.sum()?;
            return if self.take(")") {
                let node = ExprKind::Arctangent(Box::new(argument), Box::new(cosine));
                Ok(Expr { node, span: start..self.at })
            } else {
                Err(self.error(Expected::Closing))
            };
        }
        if self.take(")") {
            Ok(Expr { node: ExprKind::Call(name, primes, Box::new(argument)), span: start..self.at })
        } else {
            Err(self.error(Expected::Closing))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn precedence_and_spans() {
        let e = parse("-R*cos(2*a) + 1.5").unwrap();
        assert_eq!(e.span, 0..17);
        let ExprKind::Binary(Operator::Plus, left, right) = e.node else { panic!("not a sum") };
        assert_eq!((left.span, right.node), (0..11, ExprKind::Number(15, 10)));
        assert!(matches!(parse("2**3**2").unwrap().node, ExprKind::Binary(Operator::Power, ..)));
    }

    #[test]
    fn errors_point_at_the_place() {
        let at = |text| parse(text).map_err(|e| (e.span.start, e.expected)).unwrap_err();
        assert_eq!(at("R*"), (2, Expected::Operand));
        assert_eq!(at("(R"), (2, Expected::Closing));
        assert_eq!(at("R cos"), (2, Expected::Operator));
        assert_eq!(at("f'"), (2, Expected::Operand));
        assert_eq!(at(&"(".repeat(200)), (99 + 1, Expected::ShallowerNesting));
        let sum = |operators: usize| parse(&("R".to_owned() + &"+R".repeat(operators)));
        assert!(sum(OPERATORS).is_ok());
        assert_eq!(sum(17_000).unwrap_err().expected, Expected::FewerOperators);
        assert_eq!(parse_equation("f(0)").unwrap_err().expected, Expected::Equation);
        assert_eq!(parse_equation("f(0) = g(").unwrap_err().span, 9..9);
    }
}
