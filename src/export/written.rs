//! A written table, and the error that it leaves.

use super::facts::Between;
use super::table::Table;

/// Coordinates at which the error is looked at, to an interval.
const LOOKED_AT: usize = 32;

/// The errors that a control takes off at each row of a table, mm or rad, forward and reverse: rounded to the digits written and to
/// its own numbers.
pub type Kept = [Vec<f64>; 2];

/// A table as a control takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The file.
    pub text: String,
    /// What the control makes of its rows.
    pub kept: Kept,
}

/// The largest difference between a function and what a control makes of its table, over the table's range, mm or rad: between rows,
/// and by rounding. `error` gives the errors in either direction at a coordinate in degrees or mm.
pub fn left(table: &Table, kept: &Kept, between: Between, error: impl Fn(f64) -> [f64; 2]) -> f64 {
    let difference = |(at, x): (usize, f64)| {
        let (row, share) = (at / LOOKED_AT, (at % LOOKED_AT) as f64 / LOOKED_AT as f64);
        let of = |kept: &[f64], error: f64| {
            let before = kept.get(row).copied().unwrap_or(f64::NAN);
            let behind = kept.get(row + 1).copied().unwrap_or(before);
            match between {
                Between::Straight => (before + share * (behind - before) - error).abs(),
                Between::Somewhere if share == 0.0 => (before - error).abs(),
                Between::Somewhere => (before - error).abs().max((behind - error).abs()),
            }
        };
        let [forward, reverse] = error(x);
        of(&kept[0], forward).max(of(&kept[1], reverse))
    };
    table.grid.dense(LOOKED_AT).enumerate().map(difference).fold(0.0, f64::max)
}
