//! The nominal length of the bar.

use thiserror::Error;

/// Nominal radius of the circle, which is the nominal length of the bar: from 1 mm to 10 m.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Radius(f64);

/// Why a radius is impossible.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RadiusError {
    /// NaN or infinite.
    #[error("radius {0} mm is not a number\n  expected the nominal length of the bar in mm, e.g. 150")]
    NotFinite(f64),
    /// Zero or negative.
    #[error("radius {0} mm is not positive\n  expected the nominal length of the bar in mm, e.g. 150")]
    NotPositive(f64),
    /// Shorter than any bar.
    #[error("radius {0} mm is shorter than {min} mm, the least a bar can be\n  expected the nominal length of the bar in mm, e.g. 150 (not in m)", min = Radius::MIN_MM)]
    TooShort(f64),
    /// Longer than any bar.
    #[error("radius {0} mm is longer than {max} mm, the most a bar can be\n  expected the nominal length of the bar in mm, e.g. 150 (not in µm)", max = Radius::MAX_MM)]
    TooLong(f64),
}

impl Radius {
    /// The shortest radius taken, in mm.
    pub const MIN_MM: f64 = 1.0;
    /// The longest radius taken, in mm.
    pub const MAX_MM: f64 = 10_000.0;

    /// A radius in mm.
    ///
    /// # Errors
    /// [`RadiusError`] where no bar can be that long.
    pub fn new(mm: f64) -> Result<Self, RadiusError> {
        if !mm.is_finite() {
            Err(RadiusError::NotFinite(mm))
        } else if mm <= 0.0 {
            Err(RadiusError::NotPositive(mm))
        } else if mm < Self::MIN_MM {
            Err(RadiusError::TooShort(mm))
        } else if mm > Self::MAX_MM {
            Err(RadiusError::TooLong(mm))
        } else {
            Ok(Self(mm))
        }
    }

    /// The radius in mm.
    pub const fn mm(self) -> f64 {
        self.0
    }
}
