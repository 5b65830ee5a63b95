//! Units as the suffix of a column name; inside, lengths are in mm and angles in rad.

use std::fmt;

/// What a column measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A length, mm inside.
    Length,
    /// An angle, rad inside.
    Angle,
}

/// A unit a column can be in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Degrees, `_deg`.
    Deg,
    /// Radians, `_rad`.
    Rad,
    /// Microradians, `_urad`.
    Urad,
    /// Micrometres, `_um`.
    Um,
    /// Millimetres, `_mm`.
    Mm,
}

impl Unit {
    /// The suffix without the underscore.
    pub const fn suffix(self) -> &'static str {
        match self {
            Unit::Deg => "deg",
            Unit::Rad => "rad",
            Unit::Urad => "urad",
            Unit::Um => "um",
            Unit::Mm => "mm",
        }
    }

    /// A value in this unit, in mm or rad.
    pub fn to_inner(self, value: f64) -> f64 {
        match self {
            Unit::Deg => value.to_radians(),
            Unit::Rad | Unit::Mm => value,
            Unit::Urad => value / 1e6,
            Unit::Um => value / 1e3,
        }
    }

    /// A value in mm or rad, in this unit.
    pub fn from_inner(self, value: f64) -> f64 {
        match self {
            Unit::Deg => value.to_degrees(),
            Unit::Rad | Unit::Mm => value,
            Unit::Urad => value * 1e6,
            Unit::Um => value * 1e3,
        }
    }

    /// The shortest decimal in this unit that reads back to exactly `value` (mm or rad).
    ///
    /// Every value that was read in this unit has one. A value computed in mm or rad may have none in a scaled unit
    /// (the scaled doubles are coarser there): then the decimal nearest to it, wrong by at most one unit in the last place.
    pub fn decimal(self, value: f64) -> String {
        let near = self.from_inner(value);
        let around = [near, near.next_up(), near.next_down(), near.next_up().next_up(), near.next_down().next_down()];
        around
            .into_iter()
            .filter(|candidate| self.to_inner(*candidate) == value)
            .map(|candidate| format!("{candidate:?}"))
            .min_by_key(String::len)
            .unwrap_or_else(|| format!("{near:?}"))
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.suffix())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_read_in_a_unit_is_written_as_it_stood() {
        for text in ["0.0", "30.0", "-20.796499", "0.1", "359.999999", "1e-7", "100.0", "57.3"] {
            let value: f64 = text.parse().unwrap_or(f64::NAN);
            for unit in [Unit::Deg, Unit::Rad, Unit::Urad, Unit::Um, Unit::Mm] {
                assert_eq!(unit.decimal(unit.to_inner(value)), text, "{unit}");
            }
        }
    }
}
