//! Arguments that several calls take.

use crate::errors::Class;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::ops::RangeInclusive;
use trunnion::study::{ErrorLimits, Estimator, Instrument, Variance, set_range};
use trunnion_codegen::model::{Model, StatedInstrument};
use trunnion_codegen::quantity::Unit;

/// Ranges of axes, degrees or mm, by the axes' names.
pub type Ranges = BTreeMap<String, (f64, f64)>;

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

/// A model with the ranges of some of its axes in place of its own: degrees or mm by the axis' name.
pub fn ranged(model: &Model, ranges: Option<Ranges>) -> PyResult<Cow<'_, Model>> {
    let mut model = Cow::Borrowed(model);
    for (axis, (low, high)) in ranges.into_iter().flatten() {
        let name = format!("ranges[{axis:?}]");
        let (low, high) = (within(&name, low, -1e5..=1e5)?, within(&name, high, -1e5..=1e5)?);
        if low >= high {
            return Err(PyValueError::new_err(format!("{name}: empty\n  expected (low, high) with low below high")));
        }
        if !set_range(model.to_mut(), &axis, [low, high]) {
            let axes: Vec<&str> = model.axes().map(|axis| axis.name.as_str()).collect();
            let told = format!("the machine has no axis `{axis}`\n  expected one of {}", axes.join(", "));
            return Err(Class::Data.error(told));
        }
    }
    Ok(model)
}

/// Limits of errors: those given, else the model's.
pub fn limits(model: &Model, length_um: Option<f64>, angle_urad: Option<f64>) -> PyResult<ErrorLimits> {
    let length = length_um.map(|um| size("length_um", um)).transpose()?.map(|um| Unit::Um.to_inner(um));
    let angle = angle_urad.map(|urad| size("angle_urad", urad)).transpose()?.map(|urad| Unit::Urad.to_inner(urad));
    Ok(ErrorLimits::stated(model, length, angle))
}

/// An instrument's errors: its name, or values in place of the model's.
#[derive(Clone, FromPyObject)]
pub enum Stated {
    Name(String),
    Values(BTreeMap<String, Value>),
}

/// A value of a table `[instrument]`.
#[derive(Clone, FromPyObject)]
pub enum Value {
    Number(f64),
    Text(String),
}

/// An instrument, and the name of the one whose published errors are taken: those given, else the model's, as the options of `trunnion fit`.
pub fn instrument(model: &Model, given: Option<Stated>) -> PyResult<(Instrument, Option<String>)> {
    let known = |name: &str| {
        let presets = StatedInstrument::PRESETS.join(", ");
        let told = "or values as in [instrument] of a model file, {\"constant_um\": 0.7}";
        Class::Model.error(format!("instrument {name:?}: not known\n  expected {presets}, {told}"))
    };
    let preset = |name: &str| StatedInstrument::preset(name).ok_or_else(|| known(name));
    let own = || model.instrument.clone().unwrap_or_default();
    let stated = match given {
        None => own(),
        Some(Stated::Name(name)) => preset(&name)?,
        Some(Stated::Values(mut values)) => {
            let mut stated = match values.remove("preset") {
                Some(Value::Text(name)) => preset(&name)?,
                Some(Value::Number(number)) => return Err(known(&number.to_string())),
                None => own(),
            };
            for (key, value) in values {
                let (place, factor) = match key.as_str() {
                    "constant_um" => (&mut stated.constant, Unit::Um.factor()),
                    "noise_um" => (&mut stated.noise, Unit::Um.factor()),
                    "proportional" => (&mut stated.proportional, 1.0),
                    "bar_length_um" => (&mut stated.bar_length, Unit::Um.factor()),
                    "temperature_k" => (&mut stated.temperature, 1.0),
                    "expansion_per_k" => (&mut stated.expansion, 1.0),
                    _ => return Err(known(&key)),
                };
                let Value::Number(number) = value else { return Err(known(&key)) };
                *place = size(&key, number)? * factor;
            }
            stated
        }
    };
    Ok((Instrument::of(&stated), stated.preset))
}
