//! The description of a machine: model files, the builder, names.
//!
//! After this room every symbol is resolved, every axis has a coordinate in every run, and every expression
//! is exact.

mod builder;
mod conditions;
mod description;
mod draft;
mod evaluate;
mod expression;
mod file;
mod notation;
mod problem;
mod reference;
mod resolve;

pub use description::{Axis, AxisKind, Ball, Component, Coordinate, Function, Model, ReadingKind, Reference, Run};
pub use draft::{Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftReading, DraftRun, Text};
pub use evaluate::{Angle, EvaluationError, Meaning, Scope, at, nominal_value};
pub use expression::{Expected, Expr, Node, Operator, Span, SyntaxError, parse, parse_equation};
pub use file::{read, read_draft};
pub use notation::{Notation, iso_location, iso_motion};
pub use problem::{Problem, ProblemKind};
