//! The plane of a test.

use std::fmt;

/// A coordinate plane by its two axes, in the order that they were named.
#[derive(Clone, Copy, Debug, Eq)]
pub struct Plane([char; 2]);

impl Plane {
    /// Of a name such as `XY`; none of other names.
    pub fn of(name: &str) -> Option<Self> {
        let mut letters = name.trim().chars().map(|letter| letter.to_ascii_uppercase());
        match [letters.next()?, letters.next()?] {
            [a, b] if a != b && [a, b].iter().all(|letter| "XYZ".contains(*letter)) && letters.next().is_none() => {
                Some(Self([a, b]))
            }
            _ => None,
        }
    }
}

/// Whichever axis is named first.
impl PartialEq for Plane {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0 || self.0 == [other.0[1], other.0[0]]
    }
}

impl fmt::Display for Plane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.0[0], self.0[1])
    }
}
