//! The description of a machine and its runs, every symbol resolved: where the derivation starts.
//!
//! A [`Model`] is consistent by construction: it comes from a [`super::Draft`], which a model file, the builder and the
//! derive macro all fill, and whose `build` refuses what the later rooms could not handle.

use crate::algebra::{Alphabet, ErrorId, NominalId, Poly, PolyVector, SweepId};
use crate::basis::{Basis, Coordinate};
use crate::ids::{AxisId, FunctionId, RunId};
use crate::iso::{Component, Notation, iso_location};
use crate::source::{Span, Text};

use super::prior::{Assumption, Limits, StatedInstrument};
use typed_index_collections::TiVec;

/// A machine, the runs that measure it, and what is assumed of its errors.
#[derive(Clone, Debug)]
pub struct Model {
    /// Catalogue name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// How errors are called.
    pub notation: Notation,
    /// All symbols.
    pub alphabet: Alphabet,
    /// Usual values of constants, mm.
    pub lengths: Vec<(NominalId, f64)>,
    /// Axes between the machine's base and the workpiece, from the base outwards.
    pub workpiece: Vec<Axis>,
    /// Axes between the machine's base and the tool, from the base outwards.
    pub tool: Vec<Axis>,
    /// The runs in the order of their elimination.
    pub runs: TiVec<RunId, Run>,
    /// What is assumed of every motion error: errors without an entry must not appear in a reading. Behind them the location
    /// errors that the runs are made to find, as functions that are the same everywhere.
    pub functions: TiVec<FunctionId, ErrorFunction>,
    /// Parameters to be used as pivots first, in this order.
    pub order: Vec<Text>,
    /// Conditions between parameters, taken as exact.
    pub assumptions: Vec<Assumption>,
    /// Largest sizes of errors.
    pub limits: Limits,
    /// What is stated of the instrument.
    pub instrument: Option<StatedInstrument>,
}

impl Model {
    /// The axes, workpiece side first.
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.workpiece.iter().chain(&self.tool)
    }

    /// An axis, if the machine has it.
    pub fn axis(&self, id: AxisId) -> Option<&Axis> {
        self.axes().nth(id.into())
    }

    /// The axis of a motion error and which of its six it is.
    pub fn axis_of(&self, error: ErrorId) -> Option<(AxisId, Component)> {
        self.axes().enumerate().find_map(|(i, axis)| {
            let at = axis.motion.iter().position(|&e| e == error)?;
            Some((AxisId::from(i), Component::ALL[at]))
        })
    }

    /// The axis of a location error and which of its six it is.
    pub fn axis_of_location(&self, error: ErrorId) -> Option<(AxisId, Component)> {
        self.axes().enumerate().find_map(|(i, axis)| {
            let at = axis.location.iter().position(|&e| e == Some(error))?;
            Some((AxisId::from(i), Component::ALL[at]))
        })
    }

    /// The axis of a function: whose motion error it is, or whose location error.
    pub fn axis_of_function(&self, function: FunctionId) -> Option<(AxisId, &Axis)> {
        let error = self.functions.get(function)?.error;
        let (id, _) = self.axis_of(error).or_else(|| self.axis_of_location(error))?;
        Some((id, self.axis(id)?))
    }

    /// ISO 230-1's name of a location error: `EX0C`.
    pub fn iso_location(&self, error: ErrorId) -> Option<String> {
        let (id, component) = self.axis_of_location(error)?;
        Some(iso_location(component, &self.axis(id)?.name))
    }

    /// Whether it is the parameter of a nuisance term.
    pub fn is_nuisance(&self, error: ErrorId) -> bool {
        self.runs.iter().any(|run| run.nuisance.iter().any(|n| n.error == error))
    }

    /// The assumption about a motion error.
    pub fn function(&self, error: ErrorId) -> Option<(FunctionId, &ErrorFunction)> {
        self.functions.iter_enumerated().find(|(_, f)| f.error == error)
    }
}

/// What is assumed of a motion error as a function of its axis' coordinate, or a location error that is to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorFunction {
    /// The error.
    pub error: ErrorId,
    /// Its basis.
    pub basis: Basis,
    /// True for a function the runs are made to find: reported with its band, its coefficients keep their own names.
    pub estimate: bool,
    /// Where it is described.
    pub place: Span,
}

impl ErrorFunction {
    /// Whether it is a location error: the same at every coordinate.
    pub fn is_location(&self) -> bool {
        self.basis.is_one()
    }
}

/// One axis with its errors.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Its name on the machine: `A`, `Y`, `C2`.
    pub name: String,
    /// What its coordinate is called in equations, files and functions: `a` of the axis A.
    pub coordinate: String,
    /// Turning or sliding.
    pub kind: AxisKind,
    /// Exact unit vector of the positive motion, in machine coordinates.
    pub direction: PolyVector,
    /// Location errors (ISO 230-1 EX0A … EC0A), X Y Z A B C, where the model has them.
    pub location: [Option<ErrorId>; 6],
    /// Against which other axes its orientation errors are declared.
    pub references: Vec<Reference>,
    /// Lowest and highest coordinate, rad or mm.
    pub range: Option<[f64; 2]>,
    /// Motion errors (EXA … ECA), X Y Z A B C.
    pub motion: [ErrorId; 6],
}

/// An orientation error that is declared as squareness or parallelism to another axis: ISO 230-1's `EC(0X)Y`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reference {
    /// The orientation error.
    pub component: Component,
    /// Name of the axis that defines the direction.
    pub axis: String,
    /// Where it is declared.
    pub place: Span,
}

/// Turning or sliding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// Coordinates in rad.
    Rotary,
    /// Coordinates in mm.
    Linear,
}

/// One measurement: a path and what is read along it.
#[derive(Clone, Debug)]
pub struct Run {
    /// Its name in files and on the command line.
    pub name: String,
    /// The path's parameter.
    pub sweep: SweepId,
    /// Coordinate of every axis.
    pub at: TiVec<AxisId, Coordinate>,
    /// The ball on the workpiece side.
    pub workpiece_ball: Ball,
    /// The ball on the tool side.
    pub tool_ball: Ball,
    /// What is read.
    pub reading: ReadingKind,
    /// What moves its axes with the feed and not with the geometry.
    pub nuisance: Vec<Nuisance>,
    /// Errors of resting axes that this run leaves out: they do to it what its set-up errors do.
    pub left_out: Vec<ErrorId>,
    /// Where its name and its reading are described.
    pub places: [Span; 2],
}

/// A term of a run's own that moves an axis with the feed and not with the geometry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Nuisance {
    /// Its parameter.
    pub error: ErrorId,
    /// The axis.
    pub axis: AxisId,
    /// What it does.
    pub kind: NuisanceKind,
    /// The axis' sense, or the sweep's of a lag.
    pub sense: NominalId,
    /// True where the axis moves against that sense.
    pub against: bool,
    /// By how much the parameter moves the axis at first order: factors of its motion errors X Y Z A B C.
    pub factors: [Poly; 6],
}

/// What a nuisance term does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NuisanceKind {
    /// The reversal value B of ISO 230-2, mm or rad: the axis is B/2 further where its coordinate increases, B/2 less where it
    /// decreases.
    Backlash,
    /// The same of another of its six motions: lateral play, mm or rad.
    LateralPlay(Component),
    /// The axis is where it should have been at a sweep this angle (rad) before: its following error at a constant feed, in a
    /// circle that of the servo mismatch where another axis has none.
    Lag,
}

/// A ball of the instrument.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ball {
    /// Nominal place in the frame of the last axis, mm.
    pub at: PolyVector,
    /// Its set-up errors along x, y, z.
    pub setup: Option<[ErrorId; 3]>,
}

/// What an instrument reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadingKind {
    /// The radial deviation of a bar whose nominal length is this constant, T(4).
    BarLength(NominalId),
    /// The displacement of the tool ball against the workpiece ball, which nominally coincide, along this exact unit
    /// vector in machine coordinates; it may turn with the sweep. One channel of an R-test or of a probe on a sphere.
    Displacement(PolyVector),
}
