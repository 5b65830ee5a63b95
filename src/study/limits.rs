//! The largest errors that a machine may have.

use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::model::Model;
use trunnion_codegen::quantity::{Quantity, Unit};

/// Largest errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorLimits {
    /// Of lengths, mm.
    pub length: f64,
    /// Of angles, rad.
    pub angle: f64,
}

impl ErrorLimits {
    /// The paper's: ±30 µm and ±100 µrad.
    pub const PAPER: Self = Self { length: 0.03, angle: 1e-4 };

    /// Limits in µm and µrad.
    pub fn scaled(length_um: f64, angle_urad: f64) -> Self {
        Self { length: length_um * Unit::Um.factor(), angle: angle_urad * Unit::Urad.factor() }
    }

    /// Those of a model that are not given (mm, rad), else the paper's.
    pub fn stated(model: &Model, length: Option<f64>, angle: Option<f64>) -> Self {
        Self {
            length: length.or(model.limits.length).unwrap_or(Self::PAPER.length),
            angle: angle.or(model.limits.angle).unwrap_or(Self::PAPER.angle),
        }
    }

    /// The limit of an error of a model: its own, or that of its kind.
    pub fn of_error(&self, model: &Model, error: ErrorId) -> f64 {
        model.limits.of(error).unwrap_or_else(|| self.of(model.alphabet.error_quantity(error)))
    }

    /// The limit of errors of a kind.
    pub fn of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Length => self.length,
            Quantity::Angle => self.angle,
        }
    }
}
