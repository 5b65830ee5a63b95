//! What the fit of a generated model may refuse.

use crate::lstsq::Rejected;
use core::{error, fmt};

/// A length of the set-up that is not a positive finite number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ImpossibleLength {
    /// The length's name in the model.
    pub name: &'static str,
}

/// Why the samples of another fit are not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MergeError {
    /// They were taken with other lengths of the set-up.
    OtherLengths,
    /// The arithmetic refuses them.
    Rejected(Rejected),
}

/// The value of a function is not a finite number, as at a coordinate that is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

impl From<Rejected> for MergeError {
    fn from(rejected: Rejected) -> Self {
        Self::Rejected(rejected)
    }
}

impl ImpossibleLength {
    /// Of the length called `name`.
    pub(crate) fn of(name: &'static str) -> Self {
        Self { name }
    }
}

impl fmt::Display for ImpossibleLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the length {} is not a positive finite number of mm", self.name)
    }
}

impl fmt::Display for MergeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherLengths => f.write_str("the other fit has other lengths of the set-up"),
            Self::Rejected(rejected) => fmt::Display::fmt(rejected, f),
        }
    }
}

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the value is not a finite number")
    }
}

impl error::Error for ImpossibleLength {}
impl error::Error for MergeError {}
impl error::Error for NotFinite {}
