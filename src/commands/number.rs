//! Numbers of options: each kind has its range and says it. The option's name and the value are told with it.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;
use trunnion::data::limits::POSITIONS;

/// A number of a type within a range, `above` being a bound that it has to be beyond itself.
fn within<T: FromStr + PartialOrd + Display + Copy>(
    text: &str,
    above: Option<T>,
    range: RangeInclusive<T>,
    what: &str,
) -> Result<T, String> {
    let number = text.trim().parse::<T>().ok();
    // NaN is in no range.
    let taken = number.filter(|x| range.contains(x) && above.is_none_or(|bound| *x > bound));
    taken.ok_or_else(|| {
        let wrong = if number.is_some() { "out of range" } else { "not a number of that kind" };
        let (low, high) = range.clone().into_inner();
        let from = above.map_or_else(|| format!("from {low}"), |bound| format!("above {bound}"));
        format!("{wrong}\n  expected {what} {from} to {high}")
    })
}

/// A length that there is, mm.
pub fn length(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=1e5, "a length in mm")
}

/// A length that may be none, mm.
pub fn size(text: &str) -> Result<f64, String> {
    within(text, None, 0.0..=1e5, "a length in mm")
}

/// A coordinate, mm.
pub fn position(text: &str) -> Result<f64, String> {
    within(text, None, -1e5..=1e5, "a position in mm")
}

/// The size of a noise, an error, a limit, in the option's unit.
pub fn noise(text: &str) -> Result<f64, String> {
    within(text, None, 0.0..=1e4, "a number")
}

/// A standard deviation that has to be there, µm.
pub fn spread(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=1e4, "a number of µm")
}

/// An expanded uncertainty to be reached, µrad or µm.
pub fn goal(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=1e6, "an uncertainty in µrad or µm, e.g. 2,")
}

/// Positions at which something is probed.
pub fn stops(text: &str) -> Result<usize, String> {
    within(text, None, 3..=POSITIONS, "a number of positions")
}

/// An angle between positions, degrees.
pub fn between(text: &str) -> Result<f64, String> {
    within(text, None, 1.0..=90.0, "an angle in degrees")
}

/// A feed that there is, mm/min.
pub fn feed(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=1e6, "a feed in mm/min")
}

/// An angle within ten turns, degrees.
pub fn angle(text: &str) -> Result<f64, String> {
    within(text, None, -3600.0..=3600.0, "an angle in degrees")
}

/// A part of a turn, degrees.
pub fn step(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=360.0, "an angle in degrees")
}

/// A rate, degrees a minute.
pub fn rate(text: &str) -> Result<f64, String> {
    within(text, Some(0.0), 0.0..=36000.0, "degrees a minute")
}

/// A way beyond an end, degrees.
pub fn beyond(text: &str) -> Result<f64, String> {
    within(text, None, 0.0..=180.0, "an angle in degrees")
}

/// A number of things.
pub fn count<const LEAST: u32, const MOST: u32>(text: &str) -> Result<u32, String> {
    within(text, None, LEAST..=MOST, "a whole number")
}

/// `X,Y,…`: N coordinates, mm.
pub fn positions<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let values = text.split(',').map(position).collect::<Result<Vec<_>, _>>()?;
    let example = ["1.5"; N].join(",");
    values
        .try_into()
        .map_err(|_| format!("not {N} numbers\n  expected {N} positions in mm with commas between: {example}"))
}
