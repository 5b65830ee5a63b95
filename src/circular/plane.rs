//! The plane of a test and its axes.

use core::fmt;
use std::f64::consts::{FRAC_PI_2, PI};

/// Names that a linear axis may have.
const NAMES: &str = "XYZUVW";

/// Two linear axes: the angle of a test is counted from the first one's positive direction to the second one's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane([char; 2]);

impl Plane {
    /// A plane by its axes' names, such as `XY` or `ZX`; none of other texts.
    pub fn named(name: &str) -> Option<Self> {
        let mut names = name.trim().chars().map(|letter| letter.to_ascii_uppercase());
        let (first, second) = (names.next()?, names.next()?);
        let are_axes = [first, second].iter().all(|axis| NAMES.contains(*axis));
        (are_axes && first != second && names.next().is_none()).then_some(Self([first, second]))
    }

    /// Whether it is the same plane, whichever axis is named first.
    pub fn is_along(self, other: Self) -> bool {
        let Self([first, second]) = other;
        self == other || self == Self([second, first])
    }

    /// The name of an axis.
    pub fn axis(self, axis: Axis) -> char {
        let Self([first, second]) = self;
        if axis == Axis::First { first } else { second }
    }

    /// The end of an axis at which it reverses, such as `+X`.
    pub fn end(self, reversal: Reversal) -> String {
        format!("{}{}", if reversal.positive { '+' } else { '\u{2212}' }, self.axis(reversal.axis))
    }
}

impl Default for Plane {
    /// XY.
    fn default() -> Self {
        Self(['X', 'Y'])
    }
}

impl fmt::Display for Plane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([first, second]) = self;
        write!(f, "{first}{second}")
    }
}

/// One of the plane's axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along angle 0.
    First,
    /// Along 90°.
    Second,
}

impl Axis {
    /// Both.
    pub const ALL: [Self; 2] = [Self::First, Self::Second];

    /// The share of a radial direction that is along the axis: the cosine or the sine.
    pub fn along(self, angle: f64) -> f64 {
        if self == Self::First { angle.cos() } else { angle.sin() }
    }
}

/// Where an axis turns round on the circle: at the end of its travel there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reversal {
    /// The axis.
    pub axis: Axis,
    /// Whether it is the positive end.
    pub positive: bool,
}

impl Reversal {
    /// All four, by their angles.
    pub const ALL: [Self; 4] = [
        Self { axis: Axis::First, positive: true },
        Self { axis: Axis::Second, positive: true },
        Self { axis: Axis::First, positive: false },
        Self { axis: Axis::Second, positive: false },
    ];

    /// Its angle, rad.
    pub fn angle(self) -> f64 {
        let along = if self.axis == Axis::First { 0.0 } else { FRAC_PI_2 };
        if self.positive { along } else { along + PI }
    }

    /// That of the same axis at its other end.
    pub fn other(self) -> Self {
        Self { positive: !self.positive, ..self }
    }
}
