//! What uncertainty comes from.

use super::gum::Contribution;
use core::fmt;

/// A source of uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// The scatter of the readings.
    Noise,
    /// The instrument's error that stays the same from one reading to the next.
    Instrument,
    /// The instrument's error in proportion to the reading.
    Proportional,
    /// The bar's length.
    BarLength,
    /// The bar's temperature.
    Temperature,
    /// The lengths of the set-up.
    Lengths,
    /// The tables of known functions.
    Tables,
    /// What the model's assumptions ignore.
    Assumptions,
    /// What the fit drops: products of errors.
    Linearisation,
    /// Other errors, within their limits, that no run tells from the function.
    Confounding,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Noise => "noise",
            Self::Instrument => "instrument",
            Self::Proportional => "proportional",
            Self::BarLength => "bar length",
            Self::Temperature => "temperature",
            Self::Lengths => "set-up lengths",
            Self::Tables => "known tables",
            Self::Assumptions => "assumptions",
            Self::Linearisation => "linearisation",
            Self::Confounding => "confounding",
        })
    }
}

/// A line of a budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it comes from.
    pub source: Source,
    /// How much it is.
    pub contribution: Contribution,
}
