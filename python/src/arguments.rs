//! Arguments that several calls take.

use crate::errors::Class;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Display;
use std::ops::RangeInclusive;
use trunnion::study::{ErrorLimits, Estimator, Instrument, Variance};
use trunnion_codegen::model::{Model, StatedInstrument};
use trunnion_codegen::quantity::Unit;

/// A number within a range.
pub fn within<T: PartialOrd + Display + Copy>(name: &str, value: T, range: RangeInclusive<T>) -> PyResult<T> {
    // NaN is in no range.
    if range.contains(&value) {
        return Ok(value);
    }
    let (low, high) = range.into_inner();
    Err(PyValueError::new_err(format!("{name} = {value}: out of range\n  expected a number from {low} to {high}")))
}

/// The size of a noise, an error, a limit.
pub fn size(name: &str, value: f64) -> PyResult<f64> {
    within(name, value, 0.0..=1e4)
}

/// One of some words.
pub fn word<T: Copy>(name: &str, given: &str, words: &[(&str, T)]) -> PyResult<T> {
    let known = || words.iter().map(|(word, _)| format!("{word:?}")).collect::<Vec<_>>().join(" or ");
    let found = words.iter().find(|(word, _)| *word == given).map(|(_, value)| *value);
    found.ok_or_else(|| PyValueError::new_err(format!("{name} = {given:?}: not known\n  expected {}", known())))
}

pub fn estimator(given: &str) -> PyResult<Estimator> {
    word("estimator", given, &[("joint", Estimator::Joint), ("two-step", Estimator::TwoStep)])
}

/// The standard deviation of a reading where it is known, µm.
pub fn variance(sigma_um: Option<f64>) -> PyResult<Variance> {
    let sigma = sigma_um.map(|um| within("sigma_um", um, 1e-9..=1e4)).transpose()?;
    Ok(sigma.map_or(Variance::Residual, |um| Variance::Known(Unit::Um.to_inner(um))))
}

/// Degrees.
pub fn range((from, to): (f64, f64)) -> PyResult<(f64, f64)> {
    let (from, to) = (within("range_deg", from, -3600.0..=3600.0)?, within("range_deg", to, -3600.0..=3600.0)?);
    if from < to {
        Ok((from, to))
    } else {
        Err(PyValueError::new_err("range_deg: empty\n  expected (from, to) with from below to"))
    }
}

/// Limits of errors: those given, else the model's.
pub fn limits(model: &Model, length_um: Option<f64>, angle_urad: Option<f64>) -> PyResult<ErrorLimits> {
    let length = length_um.map(|um| size("length_um", um)).transpose()?.map(|um| Unit::Um.to_inner(um));
    let angle = angle_urad.map(|urad| size("angle_urad", urad)).transpose()?.map(|urad| Unit::Urad.to_inner(urad));
    Ok(ErrorLimits::stated(model, length, angle))
}

/// An instrument by name, else the model's.
pub fn instrument(model: &Model, name: Option<&str>) -> PyResult<Instrument> {
    let known = |name: &str| {
        let presets = StatedInstrument::PRESETS.join(", ");
        Class::Model
            .error(format!("instrument {name:?}: not known\n  expected {presets}, or [instrument] in the model file"))
    };
    let stated = match name {
        Some(name) => StatedInstrument::preset(name).ok_or_else(|| known(name))?,
        None => model.instrument.clone().unwrap_or_default(),
    };
    Ok(Instrument::of(&stated))
}
