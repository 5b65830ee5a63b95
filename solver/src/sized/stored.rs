//! What the samples of a step have come to, as numbers: to be kept, sent, and taken by another estimator.

use crate::lstsq::{Blocked, Factor};
use core::{error, fmt};
use std::vec::Vec;

/// A step's factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// Samples taken.
    pub samples: u32,
    /// The numbers of its columns ([`Factor::stored`]).
    pub numbers: Vec<f64>,
}

/// Why what was stored is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotTaken {
    /// Of other columns, or of other steps.
    OtherSize,
    /// Numbers that no samples come to.
    NoFactor,
    /// More than `u32::MAX` samples together.
    TooMany,
}

impl fmt::Display for NotTaken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OtherSize => "it has other columns",
            Self::NoFactor => "its numbers are not those of any samples",
            Self::TooMany => "together there are more than 4,294,967,295 samples of a step",
        })
    }
}

impl error::Error for NotTaken {}

impl Stored {
    /// How many numbers a step of so many columns is.
    pub const fn len(columns: usize) -> usize {
        Factor::<f64, 1>::stored_len(columns)
    }

    pub(super) fn of<const P: usize>(blocked: &Blocked<f64, P>, columns: usize) -> Self {
        let factor = blocked.factor();
        Self { samples: factor.samples(), numbers: factor.stored(columns).collect() }
    }

    pub(super) fn add_to<const P: usize>(&self, blocked: &mut Blocked<f64, P>, columns: usize) -> Result<(), NotTaken> {
        if self.numbers.len() != Self::len(columns) {
            return Err(NotTaken::OtherSize);
        }
        let numbers = self.numbers.iter().copied();
        let factor = Factor::of_stored(columns, numbers, self.samples).ok_or(NotTaken::NoFactor)?;
        blocked.merge(&factor).map_err(|_| NotTaken::TooMany)
    }
}
