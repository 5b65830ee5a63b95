//! What is stated beforehand: limits of errors, ranges of axes, the instrument; options in place of the model file's.

use super::Refused;
use super::number;
use super::pair::pair;
use clap::Args;
use trunnion::study::{ErrorLimits, Instrument, Setup, set_range};
use trunnion_codegen::model::{Model, StatedInstrument};
use trunnion_codegen::quantity::Unit;

/// Limits of errors.
#[derive(Clone, Copy, Debug, Args)]
pub struct LimitArguments {
    /// Largest length error, µm; without it the model file's, or 30.
    #[arg(long, value_name = "UM", value_parser = number::noise, allow_negative_numbers = true)]
    length_um: Option<f64>,
    /// Largest angle error, µrad; without it the model file's, or 100.
    #[arg(long, value_name = "URAD", value_parser = number::noise, allow_negative_numbers = true)]
    angle_urad: Option<f64>,
}

impl LimitArguments {
    /// The limits of errors that have no own in the model.
    pub fn limits(&self, setup: &Setup) -> ErrorLimits {
        self.of(&setup.model)
    }

    /// The same for a model that has no lengths yet.
    pub fn of(&self, model: &Model) -> ErrorLimits {
        let length = self.length_um.map(|um| Unit::Um.to_inner(um));
        let angle = self.angle_urad.map(|urad| Unit::Urad.to_inner(urad));
        ErrorLimits::stated(model, length, angle)
    }
}

/// Ranges of axes.
#[derive(Clone, Debug, Args)]
pub struct RangeArguments {
    /// Range of an axis, degrees or mm, in place of the model file's; once for each axis.
    #[arg(long = "range", value_name = "AXIS=A:B")]
    ranges: Vec<String>,
}

impl RangeArguments {
    /// Gives the axes their ranges.
    pub fn apply(&self, model: &mut Model) -> Result<(), Refused> {
        let mut given: Vec<&str> = Vec::new();
        for text in &self.ranges {
            let number = |t: &str| number::position(t).ok();
            let parsed = pair(text).and_then(|(axis, range)| {
                let (low, high) = range.split_once(':')?;
                Some((axis, number(low)?, number(high)?)).filter(|(_, low, high)| low < high)
            });
            let not = Refused::NotAPair {
                option: "range",
                pair: "AXIS=A:B",
                given: text.clone(),
                range: " with A below B, from -100000 to 100000",
                example: "A=-30:120",
            };
            let (name, low, high) = parsed.ok_or(not)?;
            if given.contains(&name) || !set_range(model, name, [low, high]) {
                let names: Vec<&str> = model.axes().map(|axis| axis.name.as_str()).collect();
                return Err(Refused::RangeOf(text.clone(), names.join(", ")));
            }
            given.push(name);
        }
        Ok(())
    }
}

/// The options of [`InstrumentArguments`].
pub const INSTRUMENT: [&str; 7] = [
    "instrument",
    "instrument_um",
    "instrument_noise_um",
    "instrument_share",
    "bar_length_um",
    "temperature_k",
    "expansion_per_k",
];

/// The instrument.
#[derive(Clone, Debug, Args)]
pub struct InstrumentArguments {
    /// An instrument whose published errors to take: QC20-W (check them against the certificate).
    #[arg(long, value_name = "NAME")]
    instrument: Option<String>,
    /// A reading is wrong by at most this, µm, whatever it is.
    #[arg(long, value_name = "UM", value_parser = number::noise, allow_negative_numbers = true)]
    instrument_um: Option<f64>,
    /// What changes from one reading to the next stays within this, µm: larger residuals are told.
    #[arg(long, value_name = "UM", value_parser = number::noise, allow_negative_numbers = true)]
    instrument_noise_um: Option<f64>,
    /// It is wrong by at most this share of itself besides.
    #[arg(long, value_name = "SHARE", value_parser = number::noise, allow_negative_numbers = true)]
    instrument_share: Option<f64>,
    /// The bar's length is wrong by at most this, µm.
    #[arg(long, value_name = "UM", value_parser = number::noise, allow_negative_numbers = true)]
    bar_length_um: Option<f64>,
    /// The bar's temperature is away from that of its calibration by at most this, K.
    #[arg(long, value_name = "K", value_parser = number::noise, allow_negative_numbers = true)]
    temperature_k: Option<f64>,
    /// The bar's expansion, 1/K.
    #[arg(long, value_name = "1/K", value_parser = number::noise, allow_negative_numbers = true)]
    expansion_per_k: Option<f64>,
}

impl InstrumentArguments {
    /// The instrument whose published errors are taken, where they are.
    pub fn name(&self, model: &Model) -> Option<String> {
        self.instrument.clone().or_else(|| model.instrument.as_ref()?.preset.clone())
    }

    /// The model's instrument with what is given here in its place.
    pub fn instrument(&self, model: &Model) -> Result<Instrument, Refused> {
        let preset = |name: &String| {
            let known = || Refused::Instrument(name.clone(), StatedInstrument::PRESETS.join(", "));
            StatedInstrument::preset(name).ok_or_else(known)
        };
        let mut stated = match &self.instrument {
            Some(name) => preset(name)?,
            None => model.instrument.clone().unwrap_or_default(),
        };
        let own = [
            (self.instrument_um, Unit::Um.factor(), &mut stated.constant),
            (self.instrument_noise_um, Unit::Um.factor(), &mut stated.noise),
            (self.instrument_share, 1.0, &mut stated.proportional),
            (self.bar_length_um, Unit::Um.factor(), &mut stated.bar_length),
            (self.temperature_k, 1.0, &mut stated.temperature),
            (self.expansion_per_k, 1.0, &mut stated.expansion),
        ];
        for (value, factor, place) in own {
            if let Some(value) = value {
                *place = value * factor;
            }
        }
        Ok(Instrument::of(&stated))
    }
}
