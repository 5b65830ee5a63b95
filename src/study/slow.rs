//! Errors that stay nearly the same from one reading to the next.
//!
//! An error of the instrument, or of a table, that stays the same from one reading to the next is not averaged away. Of what
//! shape it is nobody knows; it is taken as slow: a constant and the first harmonics of the sweep, each with an equal share of
//! the variance, so that its standard uncertainty is the stated one at every reading. All runs of a measurement are made with one
//! instrument: its slow error is one function of the sweep, the same in every run.

/// Harmonics of the sweep in a slow error.
const HARMONICS: usize = 4;
/// Functions of a slow error: 1, cos, sin, …
pub const SLOW: usize = 2 * HARMONICS + 1;

/// The functions of a slow error with a standard deviation of 1, at an angle.
pub fn slow(angle: f64, each: &mut [f64]) {
    let share = 1.0 / (HARMONICS as f64 + 1.0).sqrt();
    for (k, value) in each.iter_mut().enumerate() {
        let (sin, cos) = (k.div_ceil(2) as f64 * angle).sin_cos();
        *value = share * if k % 2 == 0 && k > 0 { sin } else { cos };
    }
}
