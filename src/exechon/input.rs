//! Files of poses, joints and touches. Lines are read one at a time, in constant memory; `-` is standard input.

use super::PointError;
use crate::data::limits::TOUCHES;
use crate::data::{FileError, FileProblem, Line, Lines, Need, Stamp, Unit, Wanted};
use std::path::{Path, PathBuf};
use trunnion_solver::circle::CircleError;
use trunnion_solver::probe::ProbeError;

/// What is wrong with a file and where; shown as `file:line: what` with the remedy on the next line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// It is no such file.
    #[error(transparent)]
    File(#[from] FileError),
    /// The machine cannot be where a line says.
    #[error("{file}:{line}: {problem}\n  {remedy}", file = .file.display(), remedy = .problem.remedy())]
    Point {
        /// The file.
        file: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// Why not.
        problem: PointError,
    },
    /// The touches have no circle.
    #[error(
        "{file}: {problem}\n  expected points all around a ring, at least three of them different and not in line",
        file = .file.display()
    )]
    Circle {
        /// The file.
        file: PathBuf,
        /// Why not.
        problem: CircleError,
    },
    /// The touches give no offset.
    #[error(
        "{file}: {problem}\n  expected touches in four directions, and four more with the spindle reversed",
        file = .file.display()
    )]
    Offset {
        /// The file.
        file: PathBuf,
        /// Why not.
        problem: ProbeError,
    },
}

/// A touch in a file: the spindle axis (mm) and the spindle angle (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TouchLine {
    pub line: u64,
    pub position: [f64; 3],
    pub spindle: f64,
}

const fn mm(name: &str) -> Wanted<'_> {
    Wanted::new(name, &[Unit::Mm])
}

const fn deg(name: &str) -> Wanted<'_> {
    Wanted::new(name, &[Unit::Deg])
}

const fn number(name: &str) -> Wanted<'_> {
    Wanted::new(name, &[])
}

/// Tool points, mm, and directions: `x_mm,y_mm,z_mm,i,j,k`.
pub(super) const POSES: [Wanted; 6] = [mm("x"), mm("y"), mm("z"), number("i"), number("j"), number("k")];

/// Struts, mm, and axes, rad: `l1_mm,l2_mm,l3_mm,a_deg,c_deg`.
pub(super) const JOINTS: [Wanted; 5] = [mm("l1"), mm("l2"), mm("l3"), deg("a"), deg("c")];

/// Lines of `N` numbers.
pub(super) struct Rows<const N: usize>(Lines);

impl<const N: usize> Rows<N> {
    /// Opens a file with these columns, in any order.
    pub fn open(file: &Path, wanted: [Wanted; N]) -> Result<Self, FileError> {
        Ok(Self(Lines::open(file, &wanted)?))
    }

    /// An error on a line of this file.
    pub fn refuse(&self, line: u64, problem: PointError) -> InputError {
        InputError::Point { file: self.0.file().to_owned(), line, problem }
    }
}

impl<const N: usize> Iterator for Rows<N> {
    /// The line and its numbers.
    type Item = Result<(u64, [f64; N]), FileError>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.0.next()?.map(|line| (line.line, std::array::from_fn(|column| line.values[column]))))
    }
}

/// Reads, with what was read, at least `least` touches, at most [`TOUCHES`]: `x_mm,y_mm,z_mm,spindle_deg`; a spindle angle that may be absent is then 0.
pub(super) fn touches(file: &Path, spindle: Option<f64>, least: usize) -> Result<(Vec<TouchLine>, Stamp), FileError> {
    let wanted = [mm("x"), mm("y"), mm("z"), Wanted { absent: spindle, ..deg("spindle") }];
    let touch = |Line { line, values }: Line| match *values.as_slice() {
        [x, y, z, spindle] => Some(TouchLine { line, position: [x, y, z], spindle }),
        _ => None,
    };
    let (lines, stamping) = Lines::stamped(file, &wanted)?;
    let touches = lines.all(TOUCHES, Need::Touches, touch)?;
    match touches.len() >= least {
        true => Ok((touches, stamping.stamp())),
        false => {
            let problem = FileProblem::TooFew { present: touches.len(), needed: least, why: Need::Touches };
            Err(FileError { file: file.to_owned(), problem })
        }
    }
}
