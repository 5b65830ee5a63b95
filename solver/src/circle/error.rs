//! Why points have no circle.

use core::{error, fmt};

/// Why points have no circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CircleError {
    /// Fewer than three points.
    TooFewPoints {
        /// How many there are.
        points: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// The point, counted from 0.
        point: usize,
    },
    /// All points are one.
    AllEqual,
    /// All points are on one straight line.
    InLine,
    /// A straight line fits the points better than any circle: the farther off its centre, the nearer a circle comes to them.
    AlongLine,
    /// Two parallel lines enclose the points more closely than any two concentric circles: no zone is the narrowest.
    BetweenLines,
    /// The iteration does not settle: the points are not near one circle.
    NoConvergence,
}

impl fmt::Display for CircleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewPoints { points } => write!(f, "{points} point(s) where a circle needs at least 3"),
            Self::NotFinite { point } => write!(f, "point {} has a coordinate that is not a finite number", point + 1),
            Self::AllEqual => f.write_str("all points are equal: there is no circle through them"),
            Self::InLine => f.write_str("the points are on a straight line: there is no circle through them"),
            Self::AlongLine => f.write_str("the points are nearer to a straight line than to any circle"),
            Self::BetweenLines => f.write_str(
                "the points lie closer between two parallel lines than between any two circles about one centre",
            ),
            Self::NoConvergence => f.write_str("the points are not near one circle"),
        }
    }
}

impl error::Error for CircleError {}
