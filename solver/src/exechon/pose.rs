//! Where everything is.

use super::Vector;
use crate::Real;

/// Strut lengths and axis angles: what the drives do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints<T> {
    /// l1, l2, l3 in mm, joint to joint, E(1)–E(3).
    pub struts: [T; 3],
    /// The A axis, rad.
    pub a: T,
    /// The C axis, rad.
    pub c: T,
}

/// Which of the two solutions of the A and C axes for a tool direction: the sign of sin A.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// sin A < 0, as at the paper's home, A = −45°.
    Negative,
    /// sin A > 0.
    Positive,
}

/// Where Newton's iteration begins, and the branch it stays on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<T> {
    /// The platform's origin, mm, in base coordinates.
    pub platform: Vector<T>,
    /// Of the A axis.
    pub branch: Branch,
}

/// A solution: the whole machine in one position. All vectors are in base coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// The tool point, mm.
    pub point: Vector<T>,
    /// The moving platform's origin, mm.
    pub platform: Vector<T>,
    /// The platform's x, y and z axes: the columns of R_MP, E(4).
    pub axes: [Vector<T>; 3],
    /// The x, y and z axes of the A axis' coordinates, the last the tool direction: the columns of R_MP·R_C·R_A.
    pub spindle: [Vector<T>; 3],
    /// Struts and axes.
    pub joints: Joints<T>,
    /// Newton steps taken.
    pub iterations: u32,
}

impl Branch {
    /// The other solution's.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Positive => Self::Negative,
        }
    }

    pub(super) fn of<T: Real>(a: T) -> Self {
        if a.sin() < T::zero() { Self::Negative } else { Self::Positive }
    }

    pub(super) fn sign<T: Real>(self) -> T {
        match self {
            Self::Negative => -T::one(),
            Self::Positive => T::one(),
        }
    }
}

impl<T: Real> Pose<T> {
    /// The tool direction, of length one.
    pub fn direction(&self) -> &Vector<T> {
        let [_, _, t] = &self.spindle;
        t
    }

    /// A start for poses near this one, on its branch.
    pub fn start(&self) -> Start<T> {
        Start { platform: self.platform, branch: Branch::of(self.joints.a) }
    }
}
