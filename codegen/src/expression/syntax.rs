//! What an expression is made of, and where a text is none.

use crate::limits::{NESTING, OPERATORS};
use crate::source::Span;

/// An expression with its place in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expr {
    /// What it is.
    pub node: ExprKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms an expression takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExprKind {
    /// A decimal number as an exact fraction.
    Number(i128, i128),
    /// A constant, the sweep, or `pi`.
    Name(String),
    /// −x
    Negative(Box<Expr>),
    /// x + y, x − y, x·y, x / y, x ^ y
    Binary(Operator, Box<Expr>, Box<Expr>),
    /// `atan2(y, x)`: the angle with the sine y and the cosine x.
    Arctangent(Box<Expr>, Box<Expr>),
    /// `sin(x)`, `f(x)`, `f'(x)`: the name, the number of primes, the argument.
    Call(String, u32, Box<Expr>),
}

/// The binary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Times,
    /// `/`
    Over,
    /// `**` or `^`
    Power,
}

/// Where and why a text is no expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// The offending place.
    pub span: Span,
    /// What would have been right there.
    pub expected: Expected,
}

/// What the parser was looking for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Expected {
    /// A number, a name, a function call or a parenthesis.
    Operand,
    /// An operator or the end.
    Operator,
    /// `)`
    Closing,
    /// A number of at most 30 digits.
    ShorterNumber,
    /// Parentheses at most [`NESTING`] deep.
    ShallowerNesting,
    /// At most [`OPERATORS`] operators.
    FewerOperators,
    /// Exactly one `=`.
    Equation,
}

impl core::fmt::Display for Expected {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::ShallowerNesting => return write!(f, "nested more than {NESTING} deep"),
            Self::FewerOperators => return write!(f, "an expression of more than {OPERATORS} operators"),
            Self::Operand => "expected a number, a name, a function or a parenthesis here",
            Self::Operator => "expected an operator or the end here",
            Self::Closing => "expected `)` here",
            Self::ShorterNumber => "a number has at most 30 digits",
            Self::Equation => "expected one `=`",
        })
    }
}

impl core::fmt::Display for SyntaxError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "column {}: {}", self.span.start + 1, self.expected)
    }
}

impl core::error::Error for SyntaxError {}
