//! The description of a machine: model files, the builder, names.
//!
//! After this room every symbol is resolved, every axis has a coordinate in every run, and every expression
//! is exact.

mod builder;
mod candidates;
mod conditions;
mod description;
mod draft;
mod file;
mod prior;
mod problem;
mod reference;
mod resolve;
mod size;
mod stated;
mod unknown;
mod written;

pub use candidates::candidates;
pub use description::{
    Axis, AxisKind, Ball, ErrorFunction, Model, Nuisance, NuisanceKind, ReadingKind, Reference, Run,
};
pub use draft::{
    Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftInstrument, DraftReading, DraftRun, Number,
};
pub use file::{read, read_draft, read_draft_stated, read_stated};
pub use prior::{Assumption, Limits, StatedInstrument};
pub use problem::{Problem, ProblemKind};
pub use stated::STATED;

pub use unknown::{Coefficient, Origin};
pub use written::{key, string};

pub use crate::expression::{
    EvaluationError, Expected, Expr, ExprKind, Meaning, Operator, Scope, SyntaxError, parse, parse_equation,
};
pub use crate::iso::{Component, Notation, iso_location, iso_motion};
pub use crate::source::{Span, Text};
