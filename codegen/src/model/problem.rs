//! What can be wrong with a description, each with its place and what would have been right.

use crate::algebra::AlgebraError;
use crate::basis::NoBasis;
use crate::expression::{Expected, Meaning};
use crate::limits::{DIGITS, NAME, TERMS};
use crate::source::{Span, shown};
use core::fmt::{self, Write as _};

/// One problem of a description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where it is in the source; empty where the description did not come from a file.
    pub span: Span,
    /// What it is.
    pub kind: ProblemKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProblemKind {
    /// The file is no TOML: the reader's words.
    Toml(String),
    /// A key that means nothing here, and the keys that do.
    UnknownKey(String, &'static [&'static str]),
    /// A key that must be there.
    Missing(&'static str),
    /// A value of another type.
    Type(&'static str),
    /// A value outside a list.
    OneOf(String, &'static [&'static str]),
    /// A name that is used as something else already.
    Taken(String),
    /// Not a name: a letter, then letters, digits and underscores.
    NotAName(String),
    /// A name after which no file can be called on Windows.
    Device(String),
    /// A whole number out of its range.
    Range(u8, u8),
    /// An axis that is not described under `[axis.…]`.
    UnknownAxis(String),
    /// An axis that is on neither side.
    Unplaced(String),
    /// A run without a coordinate for an axis.
    NoCoordinate(String),
    /// Not an error of this machine.
    UnknownError(String),
    /// Not a location error of this axis.
    NotALocation(String),
    /// An orientation error about an axis of coordinates that does not change the angle between the two axes.
    NoAngle(char, String, String),
    /// An axis that is its own reference.
    OwnReference(String),
    /// A reference axis that the axis itself carries, so that it turns along.
    CarriedReference(String, String),
    /// A reference axis with an orientation error of the same component.
    TurnedReference(String, char),
    /// A list of another length than three.
    NotThree(usize),
    /// A direction whose length is not exactly 1.
    NotAUnitVector,
    /// Not a constant of the model.
    NotAConstant(String),
    /// A Fourier sum of a linear axis.
    FourierOfLength,
    /// An error to be estimated that has no basis of functions.
    NothingToEstimate(String),
    /// Not an expression.
    Syntax(Expected),
    /// An expression that means nothing.
    Meaning(Meaning),
    /// A condition that is not linear and homogeneous in f.
    NotACondition,
    /// No function satisfies the conditions.
    NoBasis(NoBasis),
    /// A range that is none.
    NotARange,
    /// No usual value of a constant.
    NotALength(String),
    /// A name that no limit can have.
    NotALimit(String),
    /// A size that is negative or not finite.
    NotASize,
    /// An assumption that is not linear and homogeneous in parameters.
    NotAnAssumption,
    /// A name that is no parameter, or with a point no function.
    NothingToAssume(String),
    /// A point of a function that is not given in its axis' coordinate.
    NotAPoint(String),
    /// The model has no run.
    NoRuns,
    /// A sine and a cosine whose squares do not add up to 1.
    NotOnACircle,
    /// A function of an axis' angle less whole turns, along a path that gives its sine and cosine.
    TurnOfArctangent(String),
    /// Not a nuisance term.
    NotANuisance(String),
    /// A nuisance term of an axis that does not move in its run.
    Standing(String),
    /// A servo mismatch where only one axis moves.
    MovesAlone,
    /// A run whose balls are not nominally the bar's length apart: the length, what they are apart instead.
    NotTheBar(String, String),
    /// A run that reads a displacement of balls that do not nominally coincide: what they are apart instead.
    NotTogether(String),
    /// A run that sees a motion error of which nothing is assumed: the run, the error, its coefficient.
    NothingAssumed(String, String, String),
    /// More of something than a model may have.
    TooMany(&'static str, usize),
    /// A name in `order` that is no parameter of the runs.
    UnknownParameter(String),
    /// An exact computation failed while a run was derived.
    Derivation(AlgebraError),
}

impl fmt::Display for ProblemKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let f = &mut Seen(f);
        match self {
            Self::Toml(words) => write!(f, "not TOML: {words}"),
            Self::UnknownKey(key, _) => write!(f, "unknown key `{key}`"),
            Self::Missing(key) => write!(f, "`{key}` is missing"),
            Self::Type(expected) => write!(f, "not {expected}"),
            Self::OneOf(value, _) => write!(f, "unknown value `{value}`"),
            Self::Taken(name) => write!(f, "the name `{name}` is taken already"),
            Self::NotAName(name) => write!(f, "`{name}` is not a name"),
            Self::Device(name) => write!(f, "`{name}` is a device, not a file, on Windows"),
            Self::Range(low, high) => write!(f, "not a whole number from {low} to {high}"),
            Self::UnknownAxis(axis) => write!(f, "there is no [axis.{axis}]"),
            Self::Unplaced(axis) => write!(f, "axis {axis} is on neither side"),
            Self::NoCoordinate(axis) => write!(f, "no coordinate for axis {axis}"),
            Self::UnknownError(name) => write!(f, "`{name}` is not an error of this machine"),
            Self::NotALocation(name) => write!(f, "`{name}` is not a location error of this axis"),
            Self::NotThree(n) => write!(f, "{n} components"),
            Self::NotAUnitVector => write!(f, "the direction's length is not exactly 1"),
            Self::NotAConstant(name) => write!(f, "`{name}` is not a constant of this model"),
            Self::FourierOfLength => write!(f, "a Fourier sum needs an angle, this axis is linear"),
            Self::NothingToEstimate(name) => write!(f, "`{name}` has no basis to be estimated in"),
            Self::Syntax(expected) => write!(f, "{expected}"),
            Self::Meaning(meaning) => write!(f, "{meaning}"),
            Self::NotACondition => write!(f, "not a linear homogeneous condition on f"),
            Self::NoBasis(why) => write!(f, "{why}"),
            Self::NotARange => write!(f, "not a range"),
            Self::NotALimit(name) => write!(f, "`{name}` is not the limit of an error or a length of this machine"),
            Self::NotALength(name) => write!(f, "`{name}` is not the usual length of a constant"),
            Self::NotASize => write!(f, "not a size"),
            Self::NotAnAssumption => write!(f, "not a linear homogeneous condition on parameters"),
            Self::NothingToAssume(name) => write!(f, "`{name}` is nothing that could be assumed here"),
            Self::NotAPoint(_) => write!(f, "not a point of the function's axis"),
            Self::NoRuns => write!(f, "the model has no run"),
            Self::NotOnACircle => write!(f, "the squares of this sine and cosine do not add up to 1"),
            Self::TurnOfArctangent(axis) => {
                write!(
                    f,
                    "a function of axis {axis} is one of the angle less whole turns, and this run gives its sine and cosine"
                )
            }
            Self::NotANuisance(term) => write!(f, "`{term}` is not what a run may have besides the geometry"),
            Self::Standing(axis) => write!(f, "axis {axis} does not move in this run"),
            Self::MovesAlone => write!(f, "a servo mismatch is one of two axes, and fewer move in this run"),
            Self::NoAngle(letter, other, axis) => {
                write!(f, "a rotation {letter} does not change the angle between {other} and {axis}")
            }
            Self::OwnReference(axis) => write!(f, "axis {axis} has no angle to itself"),
            Self::CarriedReference(other, axis) => write!(f, "axis {other} is carried by {axis} and turns with it"),
            Self::TurnedReference(other, letter) => {
                write!(f, "axis {other} has an orientation error E{letter}0{other} itself")
            }
            Self::NotTheBar(bar, length) => write!(f, "the balls are nominally {length} apart, not {bar}"),
            Self::NotTogether(length) => write!(f, "the balls are nominally {length} apart, not together"),
            Self::NothingAssumed(run, error, factor) => {
                write!(f, "run {run} sees {error} with the factor {factor}, and nothing is assumed of it")
            }
            Self::TooMany(what, most) => write!(f, "more than {most} {what}"),
            Self::UnknownParameter(name) => write!(f, "`{name}` is not a parameter that the runs see"),
            Self::Derivation(e) => write!(f, "{e}"),
        }
    }
}

impl core::error::Error for ProblemKind {}

/// Writes what was quoted from the description visibly, and no more of it than a message shows.
struct Seen<'a, 'b>(&'a mut fmt::Formatter<'b>);

impl fmt::Write for Seen<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write_str(&shown(text))
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.kind, f)
    }
}

impl core::error::Error for Problem {}

impl ProblemKind {
    /// True for what another problem may have caused: a name that is not there, a place without a value.
    pub(super) fn may_follow(&self) -> bool {
        matches!(
            self,
            Self::Missing(_)
                | Self::Meaning(Meaning::UnknownName(_))
                | Self::NotAConstant(_)
                | Self::UnknownError(_)
                | Self::UnknownAxis(_)
                | Self::Unplaced(_)
                | Self::NoCoordinate(_)
                | Self::NoAngle(..)
                | Self::NothingToEstimate(_)
                | Self::NothingToAssume(_)
                | Self::NotALimit(_)
                | Self::NoRuns
        )
    }

    /// What the pointer says at its place.
    pub fn pointer(&self) -> &'static str {
        match self {
            Self::Toml(_) | Self::Syntax(_) => "here",
            Self::UnknownKey(..) => "not known here",
            Self::Missing(_) | Self::NoCoordinate(_) | Self::NoRuns => "incomplete",
            Self::Type(_) | Self::OneOf(..) | Self::Range(..) | Self::NotAName(_) | Self::Device(_) => "this value",
            Self::Taken(_) => "used a second time",
            Self::UnknownAxis(_) | Self::UnknownError(_) | Self::NotAConstant(_) | Self::UnknownParameter(_) => {
                "unknown"
            }
            Self::NotThree(_) | Self::NotAUnitVector => "this vector",
            Self::NotTheBar(..) | Self::NotTogether(_) => "this reading",
            Self::NothingAssumed(..) => "this run",
            _ => "this",
        }
    }

    /// What would have been right.
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Toml(_) => "expected a model file: mend this line, or give a model's name".into(),
            Self::UnknownKey(_, known) | Self::OneOf(_, known) => format!("expected {}", list(known)),
            Self::UnknownAxis(axis) => format!("describe it under [axis.{axis}], with `rotary` or `linear`"),
            Self::NotAName(_) => {
                format!("a letter first, then letters, digits and underscores, {NAME} characters at most")
            }
            Self::Device(_) => "files are called after models and runs: another name, or a longer one".into(),
            Self::TooMany(..) => "no machine needs as many: leave some out, or describe it in several files".into(),
            Self::Meaning(Meaning::TooManyTerms) => format!("a coordinate or length of at most {TERMS} terms"),
            Self::Meaning(Meaning::TooManyDigits) => format!("numbers of at most {DIGITS} digits: a constant stands for others"),
            Self::Unplaced(_) => {
                "name it in `workpiece = […]` or `tool = […]`, from the machine's base outwards".into()
            }
            Self::NoCoordinate(axis) => {
                format!("add `{axis} = \"…\"` to `at`: an expression of the sweep, or \"rest\"")
            }
            Self::UnknownError(_) => "an ISO 230-1 name such as EYY or EAA, or the model's own name for it".into(),
            Self::NotALocation(_) => {
                "EX0, EY0, EZ0 for offsets, EA0, EB0, EC0 for orientation, followed by the axis' name; \
                 EC(0X)Y for squareness to X"
                    .into()
            }
            Self::NoAngle(..) => "use the component about an axis that is square to both, or drop the reference".into(),
            Self::OwnReference(axis) => format!("name another axis: EC(0X){axis} is the squareness of {axis} to X"),
            Self::CarriedReference(other, axis) => format!("declare the angle on {other}, against {axis}"),
            Self::TurnedReference(..) => "a reference defines the direction: drop its error or choose another".into(),
            Self::NotTheBar(..) => "path and balls must keep the bar's length: check `at` and both balls".into(),
            Self::NotTogether(_) => "path must carry one ball along with the other: check `at` and both balls".into(),
            Self::NothingAssumed(_, error, _) => {
                format!(
                    "add `{error} = …` under [function]: {{ polynomial = 2 }}, {{ fourier = 2 }}, \"known\" or \"zero\""
                )
            }
            Self::UnknownParameter(_) => {
                "location and set-up errors have their names, coefficients a number: EYY1, EAA_cos1".into()
            }
            Self::NotThree(_) => "three expressions, along x, y and z".into(),
            Self::NotAUnitVector => {
                "`x`, `-y`, or three components such as [\"0\", \"1/sqrt(2)\", \"1/sqrt(2)\"]".into()
            }
            Self::NotAConstant(_) => "name it in `constants = […]`".into(),
            Self::FourierOfLength => "{ polynomial = 2 }, of the axis' travel".into(),
            Self::Taken(_) => "every name stands for one thing, in generated source whatever its case".into(),
            Self::Missing("rotary` or `linear") => {
                "`rotary = \"x\"` or `linear = \"y\"`: what it does, along which direction".into()
            }
            Self::Missing("polynomial` or `fourier") => "a basis is { polynomial = 2 } or { fourier = 2 }".into(),
            Self::Missing(key) => format!("add `{key} = …`"),
            Self::NothingToEstimate(_) => "give it a polynomial or a Fourier sum under [function]".into(),
            Self::NotACondition => "for example \"f(0) = 0\", \"f(2*pi) = f(0)\", \"f'(2*pi) = f'(0)\"".into(),
            Self::NoBasis(NoBasis::OnlyZero) => "raise the degree or drop a condition".into(),
            Self::NotARange => "two numbers, the lower first: [-30, 120], in degrees of a rotary axis, mm of a linear one".into(),
            Self::NotALimit(_) => {
                "`length_um`, `angle_urad`, an error's name and unit (`EXC_um`, `EAA_urad`), or a constant's (`L_mm`)".into()
            }
            Self::NotALength(_) => "a name from `constants` with its unit, and a positive number: `R_mm = 150`".into(),
            Self::NotASize => "a finite number, 0 or above".into(),
            Self::NotAnAssumption => "for example \"0\", \"EYC_sin1\", \"2*L*ECC_cos2\", \"0 at c = 0\"".into(),
            Self::NothingToAssume(_) => {
                "location and set-up errors have their names, coefficients a number (EYY1, EAA_cos1); a function is \"0\", \
                 or something at a point of its axis"
                    .into()
            }
            Self::NotAPoint(letter) => format!("the axis' letter and its coordinate, mm or rad: `{letter} = 0`"),
            Self::NotOnACircle => "atan2(y, x) with y² + x² = 1 exactly, along the whole sweep".into(),
            Self::TurnOfArctangent(_) => "use { fourier = n }, or a polynomial without conditions that make it periodic".into(),
            Self::NotANuisance(_) => {
                "expected \"backlash Y\", \"lag Y\" (of an axis), \"lateral play EZY\" (of a motion error) or \"mismatch\"".into()
            }
            Self::Standing(_) => "it neither reverses nor lags: drop the term".into(),
            Self::MovesAlone => "drop the term".into(),
            Self::NoRuns => "describe at least one under [run.NAME]".into(),
            Self::Meaning(Meaning::UnknownName(_)) => "the sweep of this run, `pi`, or one of `constants`".into(),
            Self::Meaning(Meaning::UnknownFunction(_)) => "expected sin, cos or sqrt".into(),
            Self::Meaning(Meaning::NotAnAngle) => {
                "whole multiples of the sweep plus whole multiples of pi/4 have an exact sine".into()
            }
            _ => return None,
        })
    }
}

fn list(known: &[&str]) -> String {
    known.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", ")
}
