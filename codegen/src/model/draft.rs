//! A machine as it was written down: texts with their places, nothing checked yet.
//!
//! The model file, the builder and the derive macros all end here; [`Draft::build`] turns it into a [`super::Model`].

use super::AxisKind;
use crate::source::{Span, Text};

/// A whole machine.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    /// Catalogue name.
    pub name: Text,
    /// One line for people.
    pub title: Text,
    /// `paper` or `iso230`.
    pub notation: Option<Text>,
    /// Lengths of the set-up.
    pub constants: Vec<Text>,
    /// Usual values of some of them, with the unit in the name: `R_mm`.
    pub lengths: Vec<Number>,
    /// Axes that carry the workpiece, from the base outwards.
    pub workpiece: Vec<Text>,
    /// Axes that carry the tool, from the base outwards.
    pub tool: Vec<Text>,
    /// The axes.
    pub axes: Vec<DraftAxis>,
    /// Own names for errors: ISO name, name.
    pub names: Vec<(Text, Text)>,
    /// The runs, in the order of their elimination.
    pub runs: Vec<DraftRun>,
    /// What is assumed of motion errors.
    pub functions: Vec<DraftFunction>,
    /// Motion errors the runs are made to find.
    pub estimate: Vec<Text>,
    /// Parameters preferred as pivots.
    pub order: Vec<Text>,
    /// Conditions taken as exact: a parameter or a function, and what it is.
    pub assume: Vec<(Text, Text)>,
    /// Largest sizes of errors, by name and unit.
    pub limits: Vec<Number>,
    /// What is stated of the instrument.
    pub instrument: Option<DraftInstrument>,
}

/// A number by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// The name, with a unit at its end: `EXC_um`.
    pub name: Text,
    /// The number.
    pub value: f64,
}

/// What is stated of the instrument.
#[derive(Clone, Debug, Default)]
pub struct DraftInstrument {
    /// A known instrument.
    pub preset: Option<Text>,
    /// Own values, in place of the preset's.
    pub values: Vec<Number>,
}

/// One axis.
#[derive(Clone, Debug)]
pub struct DraftAxis {
    /// Its name.
    pub name: Text,
    /// Turning or sliding.
    pub kind: AxisKind,
    /// `x`, `-z`, or three expressions.
    pub direction: Vec<Text>,
    /// ISO names of its location errors.
    pub location: Vec<Text>,
    /// The lowest and the highest coordinate, degrees or mm.
    pub range: Option<[f64; 2]>,
}

/// One run.
#[derive(Clone, Debug, Default)]
pub struct DraftRun {
    /// Its name.
    pub name: Text,
    /// The parameter of its path.
    pub sweep: Text,
    /// Names for parts of its expressions.
    pub define: Vec<(Text, Text)>,
    /// Axis and coordinate: an expression or `rest`.
    pub at: Vec<(Text, Text)>,
    /// The ball on the workpiece.
    pub workpiece_ball: DraftBall,
    /// The ball on the tool.
    pub tool_ball: DraftBall,
    /// What is read.
    pub reading: DraftReading,
    /// What moves its axes with the feed: `backlash Y`, `lateral play EZY`, `lag Y`, `mismatch`.
    pub nuisance: Vec<Text>,
}

/// What a run reads, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DraftReading {
    /// `"R"`: the length of a bar, a constant.
    Bar(Text),
    /// `{ displacement = … }`: `x`, `-z` or three expressions for one component; `xyz` for all three, each a run of its own.
    Displacement(Vec<Text>),
}

impl Default for DraftReading {
    fn default() -> Self {
        Self::Bar(Text::default())
    }
}

impl DraftReading {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            Self::Bar(text) => text.span.clone(),
            Self::Displacement(direction) => direction.first().map_or(0..0, |text| text.span.clone()),
        }
    }
}

/// One ball.
#[derive(Clone, Debug, Default)]
pub struct DraftBall {
    /// Nominal place; empty for the origin.
    pub at: Vec<Text>,
    /// Names of its set-up errors; empty for none.
    pub setup: Vec<Text>,
}

/// What is assumed of one motion error.
#[derive(Clone, Debug)]
pub struct DraftFunction {
    /// The error's name.
    pub error: Text,
    /// Its basis.
    pub basis: DraftBasis,
}

/// A basis as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DraftBasis {
    /// `"zero"`
    Zero,
    /// `"known"`
    Known,
    /// `{ polynomial = degree, conditions = […] }`
    Polynomial(u8, Vec<Text>),
    /// `{ fourier = harmonics }`
    Fourier(u8),
}

impl DraftBasis {
    /// The conditions of a polynomial.
    pub(super) fn conditions(&self) -> &[Text] {
        if let Self::Polynomial(_, conditions) = self { conditions } else { &[] }
    }
}
