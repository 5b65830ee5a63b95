//! From the text of an expression to exact polynomials: coordinates, angles, points.

use super::{Expr, ExprKind, Operator};
use crate::algebra::{AlgebraError, Alphabet, Angle, Monomial, Order, Poly, Rational, SweepId};
use crate::limits::{DIGITS, PRODUCTS, TERMS};
use crate::source::Span;

/// What is wrong with a well-formed expression.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Meaning {
    /// A name that is neither a constant of the model nor the run's sweep.
    UnknownName(String),
    /// A function other than `sin`, `cos`, `sqrt`.
    UnknownFunction(String),
    /// The argument of `sin` or `cos`, or a rotary axis' coordinate, that is not `n*sweep + k*pi/4`.
    NotAnAngle,
    /// A divisor with more than one term.
    Divisor,
    /// An exponent that is not a whole number from 0 to 20.
    Exponent,
    /// A square root other than of 2·n² or n².
    Root,
    /// A part or a step to it with more than [`TERMS`] terms, or of more than [`PRODUCTS`] products of two.
    TooManyTerms,
    /// A part or a step to it with a number of more than [`DIGITS`] digits.
    TooManyDigits,
    /// An exact computation failed.
    Algebra(AlgebraError),
}

impl core::fmt::Display for Meaning {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::UnknownName(name) => write!(f, "unknown name `{name}`"),
            Self::UnknownFunction(name) => write!(f, "unknown function `{name}`"),
            Self::NotAnAngle => f.write_str("not an angle with an exact sine and cosine"),
            Self::Divisor => f.write_str("division by a sum"),
            Self::Exponent => f.write_str("an exponent is a whole number from 0 to 20"),
            Self::Root => {
                f.write_str("only square roots of n² and 2n² are exact here; one of a sum stands alone under `define`")
            }
            Self::TooManyTerms => write!(f, "more than {TERMS} terms when it is multiplied out"),
            Self::TooManyDigits => write!(f, "a number of more than {DIGITS} digits when it is worked out"),
            Self::Algebra(e) => core::fmt::Display::fmt(e, f),
        }
    }
}

impl core::error::Error for Meaning {}

/// What is wrong, and where in the expression.
pub type EvaluationError = (Span, Meaning);

/// The names an expression may use.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    /// The model's symbols.
    pub alphabet: &'a Alphabet,
    /// The sweep in force.
    pub sweep: Option<SweepId>,
    /// What a run defines.
    pub defined: &'a [(String, Poly)],
}

impl Scope<'_> {
    /// Value of an expression.
    pub fn poly(&self, e: &Expr) -> Result<Poly, EvaluationError> {
        bounded(e, self.value(e)?)
    }

    fn value(&self, e: &Expr) -> Result<Poly, EvaluationError> {
        let exact = |r: Result<Poly, AlgebraError>| r.map_err(|a| (e.span.clone(), Meaning::Algebra(a)));
        let fail = |m: Meaning| Err((e.span.clone(), m));
        match &e.node {
            ExprKind::Number(n, d) => Ok(Poly::constant(Rational::new(*n, *d))),
            ExprKind::Name(name) => self.name(name).ok_or_else(|| (e.span.clone(), Meaning::UnknownName(name.clone()))),
            ExprKind::Negative(x) => Ok(self.poly(x)?.negated()),
            ExprKind::Binary(Operator::Power, x, n) => {
                match self.poly(n)?.as_number().and_then(|n| n.to_integer()).map(u32::try_from) {
                    Some(Ok(n)) if n <= 20 => power(e, &self.poly(x)?, n),
                    _ => Err((n.span.clone(), Meaning::Exponent)),
                }
            }
            ExprKind::Binary(operator, x, y) => {
                let (x, divisor, y) = (self.poly(x)?, &y.span, self.poly(y)?);
                match operator {
                    Operator::Plus => exact(x.plus(&y)),
                    Operator::Minus => exact(x.minus(&y)),
                    Operator::Over => match y.terms() {
                        [] => Err((divisor.clone(), Meaning::Algebra(AlgebraError::DivisionByZero))),
                        [(m, c)] => {
                            let over = m.recip().and_then(|m| Ok(Poly::term(m, c.recip()?)));
                            exact(over.and_then(|over| x.times(&over, Order::NOMINAL)))
                        }
                        _ => Err((divisor.clone(), Meaning::Divisor)),
                    },
                    _ => product(e, &x, &y),
                }
            }
            ExprKind::Call(name, 0, argument) => match name.as_str() {
                "sin" | "cos" => {
                    let (sin, cos) = self
                        .angle(argument)?
                        .sin_cos(self.alphabet)
                        .map_err(|a| (e.span.clone(), Meaning::Algebra(a)))?;
                    Ok(if name == "sin" { sin } else { cos })
                }
                "sqrt" => match self.poly(argument)?.as_number().and_then(root) {
                    Some(root) => Ok(root),
                    None => Err((argument.span.clone(), Meaning::Root)),
                },
                _ => fail(Meaning::UnknownFunction(name.clone())),
            },
            ExprKind::Arctangent(..) => fail(Meaning::NotAnAngle),
            ExprKind::Call(name, ..) => fail(Meaning::UnknownFunction(name.clone())),
        }
    }

    /// Value of an expression as an angle with exact sine and cosine.
    pub fn angle(&self, e: &Expr) -> Result<Angle, EvaluationError> {
        let poly = self.poly(e)?;
        self.as_angle(poly).ok_or_else(|| (e.span.clone(), Meaning::NotAnAngle))
    }

    fn name(&self, name: &str) -> Option<Poly> {
        let sweep = self.sweep.filter(|&s| self.alphabet.sweep_name(s) == name);
        if let Some((_, poly)) = self.defined.iter().find(|(own, _)| own == name) {
            return Some(poly.clone());
        }
        let id = match sweep {
            Some(sweep) => self.alphabet.sweep_symbols(sweep)[0],
            None if name == "pi" => Alphabet::PI,
            None => self.alphabet.find_constant(name)?,
        };
        Some(Poly::nominal(id))
    }

    fn as_angle(&self, poly: Poly) -> Option<Angle> {
        let mut angle = Angle::zero();
        let whole =
            |c: &Rational| c.to_integer().and_then(|n| i32::try_from(n).ok()).filter(|n| n.unsigned_abs() <= 64);
        for (m, c) in poly.terms() {
            if *m == Monomial::nominal(Alphabet::PI, 1) {
                angle.eighths = whole(&(c * &Rational::from(4)))?;
            } else {
                let sweep = self.sweep.filter(|&s| *m == Monomial::nominal(self.alphabet.sweep_symbols(s)[0], 1))?;
                angle.sweep = Some((sweep, whole(c)?));
            }
        }
        Some(Angle { poly, ..angle })
    }
}

/// A product that is the value of an expression, or a step to it.
fn product(e: &Expr, x: &Poly, y: &Poly) -> Result<Poly, EvaluationError> {
    if x.terms().len() * y.terms().len() > PRODUCTS {
        return Err((e.span.clone(), Meaning::TooManyTerms));
    }
    bounded(e, x.times(y, Order::NOMINAL).map_err(|a| (e.span.clone(), Meaning::Algebra(a)))?)
}

/// A power, whose coefficients are whole to the last step.
fn power(e: &Expr, x: &Poly, n: u32) -> Result<Poly, EvaluationError> {
    let exact = |r: Result<_, AlgebraError>| r.map_err(|a| (e.span.clone(), Meaning::Algebra(a)));
    let (common, whole) = exact(x.primitive())?;
    let whole = (0..n).try_fold(Poly::one(), |power, _| product(e, &power, &whole))?;
    let common = common.power(n.cast_signed()).ok_or_else(|| (e.span.clone(), Meaning::TooManyDigits))?;
    product(e, &whole, &Poly::constant(common))
}

/// A value with neither too many terms nor too many digits: what is made of it takes as long as the squares of both say.
fn bounded(e: &Expr, value: Poly) -> Result<Poly, EvaluationError> {
    let long = |c: &Rational| c.bits() as f64 * core::f64::consts::LOG10_2 > DIGITS as f64;
    match value.terms() {
        terms if terms.len() > TERMS => Err((e.span.clone(), Meaning::TooManyTerms)),
        terms if terms.iter().any(|(_, c)| long(c)) => Err((e.span.clone(), Meaning::TooManyDigits)),
        _ => Ok(value),
    }
}

/// √(n/d) as a rational or a rational times √2.
fn root(square: Rational) -> Option<Poly> {
    match square.sqrt() {
        Some(r) => Some(Poly::constant(r)),
        None => {
            let half = &square * &Rational::new(1, 2);
            half.sqrt().map(|r| Poly::term(Monomial::nominal(Alphabet::ROOT2, 1), r))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;
    use crate::algebra::at;

    #[test]
    fn multiples_and_45_degrees_are_exact() {
        let mut alphabet = Alphabet::default();
        alphabet.constant("R").unwrap();
        let sweep = alphabet.sweep("a").unwrap();
        let scope = Scope { alphabet: &alphabet, sweep: Some(sweep), defined: &[] };
        let value = |text: &str| scope.poly(&parse(text).unwrap());
        for (text, expected) in [
            ("sin(3*a - pi/4)", f64::sin(3.0 * 0.7 - core::f64::consts::FRAC_PI_4)),
            ("cos(-2*a + 5*pi/4)*R/2", f64::cos(-1.4 + 5.0 * core::f64::consts::FRAC_PI_4) * 50.0),
            ("sqrt(1/2) + sqrt(9/4) - 0.25**2", 0.5f64.sqrt() + 1.5 - 0.0625),
            ("a*R", 70.0),
        ] {
            let got = at(&value(text).unwrap(), &alphabet, 0.7, |_| 100.0);
            assert!((got - expected).abs() < 1e-12, "{text}: {got} {expected}");
        }
        assert_eq!(value("sin(a/2)").unwrap_err(), (4..7, Meaning::NotAnAngle));
        assert_eq!(value("R/(1+R)").unwrap_err().1, Meaning::Divisor);
        assert_eq!(value("R**a").unwrap_err().1, Meaning::Exponent);
        assert_eq!(value("q").unwrap_err(), (0..1, Meaning::UnknownName("q".into())));
        assert_eq!(value("((1+R)*(1+a)*(1+sin(a))*(1+cos(a)))**20").unwrap_err().1, Meaning::TooManyTerms);
        assert_eq!(value("R/0").unwrap_err().1, Meaning::Algebra(AlgebraError::DivisionByZero));
        assert!(value("(R + 10**14*a)**20").is_ok());
        assert_eq!(value("(R + 10**16*a)**20").unwrap_err(), (0..18, Meaning::TooManyDigits));
        // Found by fuzzing: with 2,000 digits it took a second.
        assert_eq!(
            value("(R + 12/-88460**8/22220/.102222/-88460**8/22220/R)**20").unwrap_err().1,
            Meaning::TooManyDigits
        );
    }
}
