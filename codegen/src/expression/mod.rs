//! Expressions of model files: `R*cos(a)`, `2*pi`, `f'(2*pi)`.
//!
//! After this room a text is an exact polynomial, an angle with an exact sine and cosine, or a problem with its place.

mod evaluate;
mod parse;
mod syntax;
mod write;

pub use evaluate::{EvaluationError, Meaning, Scope};
pub use parse::{parse, parse_equation};
pub use syntax::{Expected, Expr, ExprKind, Operator, SyntaxError};
pub(crate) use write::write;
