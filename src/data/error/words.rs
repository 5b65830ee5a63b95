//! Angles, names and lists as messages show them.

use std::fmt;

use trunnion_codegen::problems::shown;
use trunnion_codegen::quantity::Unit;

/// An angle in rad, shown in degrees without the last digits of the conversion and without a sign at zero.
pub(super) struct Degrees(pub(super) f64);

impl fmt::Display for Degrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}°", Unit::Deg.decimal(self.0 + 0.0).trim_end_matches(".0"))
    }
}

/// UnitNames with commas between them.
pub(super) struct List<'a>(pub(super) &'a [String]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(&self.0.join(", ")))
    }
}

/// A name in each of its units; alone where it has none.
pub(super) struct UnitNames<'a>(pub(super) &'a str, pub(super) &'a [Unit]);

impl fmt::Display for UnitNames<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.1.is_empty() {
            return f.write_str(self.0);
        }
        for (at, unit) in self.1.iter().enumerate() {
            let between = if at > 0 { " or " } else { "" };
            write!(f, "{between}{}_{unit}", self.0)?;
        }
        Ok(())
    }
}
