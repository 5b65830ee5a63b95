//! Why an instrument's own file gives no readings.

use std::fmt;

use thiserror::Error;

use crate::circular::{Axis, Plane};
use crate::data::limits::{INSTRUMENT, NAMESPACES, NODES, SAMPLES, TAG};

/// Fewest readings of a run: fewer are no circle.
pub const FEWEST: usize = 12;

/// Why an instrument's own file gives no readings.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{what}")]
pub struct ImportProblem {
    /// The line, counted from 1; none where it concerns the whole file.
    line: Option<u64>,
    /// What is wrong.
    #[source]
    what: Wrong,
}

impl ImportProblem {
    /// The line, counted from 1; none where it concerns the whole file.
    pub fn line(&self) -> Option<u64> {
        self.line
    }

    /// What is wrong.
    pub fn what(&self) -> &Wrong {
        &self.what
    }
}

/// What is wrong with an instrument's own file.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Wrong {
    /// More than [`INSTRUMENT`] bytes.
    #[error("more than {INSTRUMENT} bytes\n  expected the file of one test")]
    TooLong,
    /// More than [`NODES`] elements.
    #[error("more than {NODES} elements\n  expected the file of one test")]
    TooManyElements,
    /// A tag of more than [`TAG`] bytes.
    #[error("a tag of more than {TAG} bytes\n  expected the file of one test")]
    LongTag,
    /// More than [`NAMESPACES`] declarations of namespaces.
    #[error("more than {NAMESPACES} namespaces\n  expected the file of one test")]
    TooManyNamespaces,
    /// Not XML, or not all of it.
    #[error("{0}\n  expected a whole XML file: copy it again, or save the test again")]
    Xml(String),
    /// The declaration of an entity.
    #[error(
        "declares an entity\n  expected a file as the instrument's program writes it, which does not: a few entities can stand for gigabytes"
    )]
    Entity,
    /// The root of some other file.
    #[error(
        "the file of another program: its first element is <{0}>\n  expected a test of Renishaw Ballbar 20 (.b5r), which begins with <TEST_DOCUMENT>"
    )]
    Other(String),
    /// No run.
    #[error("no run in this test\n  expected <BALLBAR_RUN> with its readings: save the test once it is measured")]
    NoRuns,
    /// A run without readings.
    #[error("run {0} has no READINGS\n  expected them beside its RUN_DIRECTION: save the test with its data")]
    NoReadings(usize),
    /// A run with too few of them.
    #[error("a run of {0} readings\n  expected at least {FEWEST}, of a circle or an arc")]
    FewReadings(usize),
    /// Readings that are too many to be kept.
    #[error("more than {SAMPLES} readings\n  expected fewer: divide the file")]
    ManyReadings,
    /// A run that goes neither way.
    #[error("RUN_DIRECTION {0:?}\n  expected CW or CCW")]
    Direction(String),
    /// No number where one belongs.
    #[error("{text:?} in {element} is not a number\n  expected a number such as 12.5")]
    Number {
        /// The element.
        element: &'static str,
        /// What stands there, or its beginning.
        text: String,
    },
    /// A length that no bar has.
    #[error("NOMINAL_LENGTH {0} mm\n  expected the length of a bar in mm, such as 150")]
    Length(f64),
    /// No plane.
    #[error("test plane {0:?}\n  expected two of X, Y and Z, such as XY")]
    NoPlane(String),
    /// Axes that are not those of the plane.
    #[error("test plane {plane} with the axes {axes}\n  expected the axes of the plane: is this the right test?")]
    Axes {
        /// The plane.
        plane: Plane,
        /// Its axes as the file names them.
        axes: String,
    },
    /// Another plane than that stated.
    #[error("test plane {found}\n  expected a test in the plane {stated}, as stated")]
    OtherPlane {
        /// The file's.
        found: Plane,
        /// What was stated.
        stated: Plane,
    },
    /// The same plane, its axes in the other order.
    #[error(
        "test plane {found}\n  expected a test in the plane {stated}, as stated, whose angles count from {first} and not from {other}: \
         state {found}",
        first = .stated.axis(Axis::First),
        other = .found.axis(Axis::First)
    )]
    Exchanged {
        /// The file's.
        found: Plane,
        /// What was stated.
        stated: Plane,
    },
    /// Another plane than that in which a run's axes move.
    #[error("test plane {found}\n  expected the file of this run, which moves {axes}")]
    RunPlane {
        /// The file's.
        found: Plane,
        /// The linear axes that the run moves.
        axes: String,
    },
    /// Another bar than the one stated.
    #[error(
        "NOMINAL_LENGTH {found_mm} mm where the radius is {bar_mm} mm\n  expected the file of a bar of that length, or the radius of \
         this one"
    )]
    OtherBar {
        /// The file's, mm.
        found_mm: f64,
        /// What is stated, mm.
        bar_mm: f64,
    },
    /// Readings of displacements are wanted, of which there are none.
    #[error("the readings of a bar\n  expected a CSV file with three displacements")]
    NoDisplacements,
    /// A unit that is not known.
    #[error(
        "AF_CIRCULARITY in {0:?}\n  expected UT_LENGTH_MM or UT_LENGTH_UM; or the unit of the readings stated, mm or um"
    )]
    FeatureUnit(String),
    /// A unit that cannot be found.
    #[error("the unit of the readings is not in the file, and {0}\n  expected it to be stated: mm or um")]
    NoUnit(Inconclusive),
    /// An arc whose ends are not known.
    #[error(
        "where the readings begin and end is not in the file, and {0}\n  expected the ends of the arc to be stated, in degrees"
    )]
    NoEnds(NoArc),
    /// Nothing is left of a run.
    #[error("no sample of this run lies from {from_deg}° to {to_deg}°\n  expected an arc that was measured")]
    Outside {
        /// One end.
        from_deg: f64,
        /// The other end.
        to_deg: f64,
    },
}

impl Wrong {
    /// On a line, counted from 1.
    pub(crate) fn at(self, line: u64) -> ImportProblem {
        ImportProblem { line: Some(line), what: self }
    }

    /// Of the file as a whole.
    pub(crate) fn of_all(self) -> ImportProblem {
        ImportProblem { line: None, what: self }
    }
}

/// Why the unit of readings cannot be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inconclusive {
    /// No run says how round it was.
    NoCircularity,
    /// What the run says fits neither unit, or both.
    Unlike {
        /// The circularity of the readings as they stand.
        readings: f64,
        /// What the run says, mm.
        told_mm: f64,
    },
    /// Runs of one file would have different units.
    Different,
}

impl fmt::Display for Inconclusive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCircularity => f.write_str("no run has an AF_CIRCULARITY to compare with"),
            Self::Unlike { readings, told_mm } => write!(
                f,
                "a circularity of {readings:.4} of the readings as they stand, beside an AF_CIRCULARITY of {told_mm} mm, fits neither mm nor µm"
            ),
            Self::Different => f.write_str("its runs seem to have different ones"),
        }
    }
}

/// Why the ends of an arc are not known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoArc {
    /// The test's name has no arc.
    NotNamed(String),
    /// It has one of which the beginning is anybody's guess.
    Open(String),
    /// The plane is seen from another side.
    View(String),
}

impl fmt::Display for NoArc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotNamed(name) => write!(f, "the test's name {name:?} has no arc such as 220grad or 360deg"),
            Self::Open(name) => write!(f, "an arc as short as that in the test's name {name:?} may begin anywhere"),
            Self::View(view) => write!(f, "the plane is seen as {view:?}, not as \"+A+B\""),
        }
    }
}
