//! Lengths and angles, and the units they are written in. Inside, lengths are in mm and angles in rad.

use core::fmt;

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length, mm inside.
    Length,
    /// An angle, rad inside.
    Angle,
}

/// A unit of a length or an angle.
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

impl Quantity {
    /// The unit inside: mm or rad.
    pub const fn inner(self) -> Unit {
        match self {
            Self::Length => Unit::Mm,
            Self::Angle => Unit::Rad,
        }
    }

    /// The unit of an axis' coordinate in files and reports: mm or degrees.
    pub const fn coordinate(self) -> Unit {
        match self {
            Self::Length => Unit::Mm,
            Self::Angle => Unit::Deg,
        }
    }

    /// The unit of an error in files and reports: µm or µrad.
    pub const fn deviation(self) -> Unit {
        match self {
            Self::Length => Unit::Um,
            Self::Angle => Unit::Urad,
        }
    }
}

impl Unit {
    /// As the end of a column's name, without the underscore: `um`.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Deg => "deg",
            Self::Rad => "rad",
            Self::Urad => "urad",
            Self::Um => "um",
            Self::Mm => "mm",
        }
    }

    /// As people write it: `µm`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Deg => "°",
            Self::Rad => "rad",
            Self::Urad => "µrad",
            Self::Um => "µm",
            Self::Mm => "mm",
        }
    }

    /// One of it in mm or rad.
    pub const fn factor(self) -> f64 {
        match self {
            Self::Deg => core::f64::consts::PI / 180.0,
            Self::Rad | Self::Mm => 1.0,
            Self::Urad => 1e-6,
            Self::Um => 1e-3,
        }
    }

    /// A value in this unit, in mm or rad: for the scaled units the double nearest to the decimal fraction, which a product with
    /// the inexact [`factor`](Self::factor) need not be.
    pub fn to_inner(self, value: f64) -> f64 {
        match self {
            Self::Deg => value.to_radians(),
            Self::Rad | Self::Mm => value,
            Self::Urad => value / 1e6,
            Self::Um => value / 1e3,
        }
    }

    /// A value in mm or rad, in this unit.
    pub fn from_inner(self, value: f64) -> f64 {
        match self {
            Self::Deg => value.to_degrees(),
            Self::Rad | Self::Mm => value,
            Self::Urad => value * 1e6,
            Self::Um => value * 1e3,
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

/// The suffix.
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
