//! The coordinates of a table: equal steps from one end to the other.

use crate::study::decimal;
use thiserror::Error;

/// Rows of a table, at most: more than any control takes.
pub const ROWS: usize = 20_000;
/// By how much of a step a range may miss being a whole number of steps.
const SLACK: f64 = 1e-6;

/// Coordinates in degrees or mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    from: f64,
    step: f64,
    intervals: usize,
}

/// Why a range has no such steps.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum GridError {
    /// It is no whole number of steps.
    #[error("{from}:{to} is no whole number of steps of {step}\n  expected for example {from}:{near}")]
    NotWhole {
        /// Its beginning.
        from: f64,
        /// Its end.
        to: f64,
        /// The step.
        step: f64,
        /// The whole number of steps nearest to its end.
        near: f64,
    },
    /// Not two multiples of the step within a range.
    #[error("not two multiples of {step} from {low:.3} to {high:.3}\n  expected a smaller step")]
    TooFew {
        /// The lowest coordinate.
        low: f64,
        /// The highest.
        high: f64,
        /// The step.
        step: f64,
    },
    /// More rows than are written.
    #[error("more than {ROWS} rows\n  expected a larger step")]
    TooMany,
}

impl Grid {
    /// `step` > 0 by `step` from `from` to `to`, which is beyond it.
    ///
    /// # Errors
    /// [`GridError`]
    pub fn new(from: f64, to: f64, step: f64) -> Result<Self, GridError> {
        let count = (to - from) / step;
        // Not so many that there is no such number.
        if count.is_nan() || count + 1.0 > ROWS as f64 + SLACK {
            return Err(GridError::TooMany);
        }
        let intervals = count.round().max(1.0) as usize;
        let grid = Self { from, step, intervals };
        let whole = (count - intervals as f64).abs() <= SLACK;
        if whole { Ok(grid) } else { Err(GridError::NotWhole { from, to, step, near: grid.to() }) }
    }

    /// The multiples of a step within two ends.
    ///
    /// # Errors
    /// [`GridError`]
    pub fn within((low, high): (f64, f64), step: f64) -> Result<Self, GridError> {
        let (first, last) = ((low / step - SLACK).ceil(), (high / step + SLACK).floor());
        match last > first {
            true => Self::new(decimal(first * step), decimal(last * step), step),
            false => Err(GridError::TooFew { low, high, step }),
        }
    }

    /// Its first coordinate.
    pub fn from(&self) -> f64 {
        self.from
    }

    /// Its last coordinate.
    pub fn to(&self) -> f64 {
        self.at(self.intervals)
    }

    /// From one to the next.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// How many there are.
    pub fn rows(&self) -> usize {
        self.intervals + 1
    }

    /// All of them.
    pub fn points(&self) -> impl Iterator<Item = f64> {
        (0..=self.intervals).map(|row| self.at(row))
    }

    /// Coordinates from the first to the last, `between` of them to an interval.
    pub fn dense(&self, between: usize) -> impl Iterator<Item = f64> {
        let steps = self.intervals * between;
        (0..=steps).map(move |i| self.from + self.step * (i as f64 / between as f64))
    }

    fn at(&self, row: usize) -> f64 {
        decimal(self.from + self.step * row as f64)
    }
}
