//! Predicted uncertainty in words, for `derive` and `plan`.

use super::Refused;
use super::measured::Combine;
use super::number;
use clap::Args;
use std::fmt::Write;
use trunnion::data::Unit;
use trunnion::study::plan::{Intended, Predicted, predict, uniform_std};
use trunnion::study::{Estimator, Setup, coefficient_unit, coordinate};

/// How is intended to be measured.
#[derive(Clone, Copy, Debug, Args)]
pub struct Measuring {
    /// Samples of each run.
    #[arg(long, default_value_t = 360, value_parser = number::count::<2, 100_000>, allow_negative_numbers = true)]
    pub samples: u32,
    /// Half width of the uniform noise of the readings, µm.
    #[arg(long, value_name = "UM", default_value_t = 0.1, value_parser = number::noise, allow_negative_numbers = true)]
    pub noise_um: f64,
    /// How the runs are combined.
    #[arg(long, value_enum, default_value_t = Combine::Joint)]
    pub estimator: Combine,
}

impl Measuring {
    /// The runs over a range in degrees.
    pub fn over(&self, (from, to): (f64, f64)) -> Intended {
        let range = (Unit::Deg.to_inner(from), Unit::Deg.to_inner(to));
        Intended { samples: self.samples as usize, range, sigma: self.sigma() }
    }

    /// Standard deviation of the uniform noise, mm.
    pub fn sigma(&self) -> f64 {
        uniform_std(self.noise_um * Unit::Um.factor())
    }
}

/// `A:B` in degrees.
pub fn range(text: &str) -> Result<(f64, f64), &'static str> {
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|x| x.abs() <= 3600.0);
    let pair = text.split_once(':').and_then(|(a, b)| Some((number(a)?, number(b)?)));
    pair.filter(|(a, b)| a < b).ok_or("not a range of angles\n  expected for example -20:200, in degrees")
}

/// What all runs over one range would give, as text.
pub fn prediction(setup: &Setup, range: (f64, f64), measuring: &Measuring) -> Result<String, Refused> {
    let estimator = Estimator::from(measuring.estimator);
    let p = predict(setup, measuring.over(range), estimator)?;
    let lengths = setup.model.alphabet.constants().map(|n| format!("{n} = {} mm", setup.constant(n)));
    let mut out = format!(
        "\nPredicted with {}, {}°…{}°, {} samples a run, noise ±{} µm, {} estimate: condition {:.1}\n",
        lengths.collect::<Vec<_>>().join(", "),
        range.0,
        range.1,
        measuring.samples,
        measuring.noise_um,
        estimator,
        p.condition
    );
    for (b, std) in &p.base {
        let _ = writeln!(out, "  {:9} ± {std:<9.2e} {}", setup.derivation.base[*b].name, coefficient_unit(setup, *b));
    }
    for f in &p.functions {
        let _ = writeln!(out, "  {}", function(setup, f));
    }
    Ok(out)
}

/// `eps_xa: std 0.58 urad (95 % ± 1.14) at a = 213 deg`
pub fn function(setup: &Setup, predicted: &Predicted) -> String {
    let name = setup.function_name(predicted.function);
    let Some(largest) = predicted.largest else { return format!("{name}: {}", predicted.told.words) };
    let Some(axis) = setup.axis(predicted.function) else { return name };
    let (unit, of) = (setup.quantity(predicted.function).deviation(), coordinate(axis).coordinate());
    let (letter, at) = (&axis.coordinate, of.from_inner(largest.at));
    let (std, u95) = (unit.from_inner(largest.std), unit.from_inner(largest.u95));
    let told = &predicted.told.words;
    let located = setup.model.functions[predicted.function].is_location();
    let at = if located { String::new() } else { format!(" at {letter} = {at:.0} {of}") };
    format!("{name}: std at most {std:.3} {unit} (95 % ± {u95:.3}){at}, {told}")
}
