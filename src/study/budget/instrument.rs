//! What is known of the instrument.

use trunnion_codegen::model::StatedInstrument;

/// Standard uncertainties of the instrument.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Instrument {
    /// Of a reading, from what stays the same from one to the next, mm.
    pub constant: f64,
    /// Of a reading, as a share of it.
    pub proportional: f64,
    /// Of the bar's length, mm.
    pub bar_length: f64,
    /// Of the bar's temperature, K.
    pub temperature: f64,
    /// The bar's expansion, 1/K.
    pub expansion: f64,
    /// Of a reading, from what changes from one to the next, mm: what residuals are held against. 0 where it is not stated.
    pub noise: f64,
}

impl Instrument {
    /// From stated bounds: rectangular distributions, whose standard deviation is the bound over √3 (GUM 4.3.7).
    pub fn of(stated: &StatedInstrument) -> Self {
        let std = |bound: f64| bound / 3f64.sqrt();
        Self {
            constant: std(stated.constant),
            proportional: std(stated.proportional),
            bar_length: std(stated.bar_length),
            temperature: std(stated.temperature),
            expansion: stated.expansion,
            noise: std(stated.noise),
        }
    }
}
