//! What is known before anything is measured: conditions between parameters, limits of errors, the instrument.

use super::unknown::Origin;
use crate::algebra::{ErrorId, NominalId, Poly};
use crate::source::Span;

/// A linear homogeneous condition `Σ factor · parameter = 0` that is taken as exact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assumption {
    /// As it was written: `EXC = 0 at c = 0`.
    pub text: String,
    /// Its terms; those of its left-hand side first.
    pub terms: Vec<(Origin, Poly)>,
    /// How many of the terms are the left-hand side's.
    pub left: usize,
    /// Where it is written.
    pub place: Span,
}

/// The largest sizes of errors, mm or rad: for what cannot be told from the data, and for simulation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits {
    /// Of every length error that has no own.
    pub length: Option<f64>,
    /// Of every angle error that has no own.
    pub angle: Option<f64>,
    /// Of single errors.
    pub errors: Vec<(ErrorId, f64)>,
    /// Of the set-up's lengths: by how much each may differ from its value, mm.
    pub constants: Vec<(NominalId, f64)>,
}

impl Limits {
    /// An error's own limit.
    pub fn of(&self, error: ErrorId) -> Option<f64> {
        self.errors.iter().find(|(e, _)| *e == error).map(|(_, limit)| *limit)
    }
}

/// What is stated of the instrument: bounds of its errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StatedInstrument {
    /// The instrument whose values these are, to be checked against its certificate.
    pub preset: Option<String>,
    /// A reading is wrong by at most this, mm, whatever it is.
    pub constant: f64,
    /// It is wrong by at most this share of itself besides.
    pub proportional: f64,
    /// The bar's length is wrong by at most this, mm.
    pub bar_length: f64,
    /// The bar's mean temperature is away from that of the calibration by at most this, K.
    pub temperature: f64,
    /// The bar's expansion, 1/K.
    pub expansion: f64,
    /// What changes from one reading to the next stays within this, mm; 0 where it is not stated.
    pub noise: f64,
}

impl StatedInstrument {
    /// The presets by name.
    pub const PRESETS: &[&str] = &["QC20-W"];

    /// An instrument as its maker states it; the values of one's own are in its certificate.
    pub fn preset(name: &str) -> Option<Self> {
        // ±(0.7 µm + 0.3 % of the reading), as published for the ball-bar; not taken from a certificate.
        (name == "QC20-W").then(|| Self {
            preset: Some(name.to_owned()),
            constant: 0.7e-3,
            proportional: 3e-3,
            ..Self::default()
        })
    }
}
