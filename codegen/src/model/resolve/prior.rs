//! Usual lengths, limits and the instrument.

use super::resolver::Resolver;
use crate::algebra::{NominalId, Quantity};
use crate::model::{Draft, Limits, Number, ProblemKind, StatedInstrument};
use crate::quantity::Unit;

impl Resolver {
    pub fn lengths(&mut self, draft: &Draft) -> Vec<(NominalId, f64)> {
        let mut lengths: Vec<(NominalId, f64)> = Vec::new();
        for Number { name, value } in &draft.lengths {
            let constant = name.value.strip_suffix("_mm").and_then(|of| self.alphabet.find_constant(of));
            match constant.filter(|_| value.is_finite() && *value > 0.0) {
                None => {
                    self.problem::<()>(&name.span, ProblemKind::NotALength(name.value.clone()));
                }
                Some(id) if lengths.iter().any(|(other, _)| *other == id) => {
                    self.problem::<()>(&name.span, ProblemKind::Taken(name.value.clone()));
                }
                Some(id) => lengths.push((id, *value)),
            }
        }
        lengths
    }

    pub fn limits(&mut self, draft: &Draft) -> Limits {
        let (mut limits, mut given) = (Limits::default(), Vec::new());
        for Number { name, value } in &draft.limits {
            let unit = |suffix: &str| [Unit::Um, Unit::Urad, Unit::Mm].into_iter().find(|u| u.suffix() == suffix);
            let named = name.value.rsplit_once('_').and_then(|(of, suffix)| Some((of, unit(suffix)?)));
            let Some((of, unit)) = named.filter(|_| value.is_finite() && *value >= 0.0) else {
                let kind =
                    if named.is_some() { ProblemKind::NotASize } else { ProblemKind::NotALimit(name.value.clone()) };
                self.problem::<()>(&name.span, kind);
                continue;
            };
            if given.contains(&of) {
                self.problem::<()>(&name.span, ProblemKind::Taken(name.value.clone()));
            }
            given.push(of);
            let size = unit.to_inner(*value);
            let measured = if unit == Unit::Urad { Quantity::Angle } else { Quantity::Length };
            let quantity = |id| self.alphabet.errors().find(|(e, ..)| *e == id).map(|(.., quantity)| quantity);
            match (of, measured, self.error(of), self.alphabet.find_constant(of)) {
                ("length", Quantity::Length, ..) => limits.length = Some(size),
                ("angle", Quantity::Angle, ..) => limits.angle = Some(size),
                (_, measured, Some(error), _) if quantity(error) == Some(measured) => limits.errors.push((error, size)),
                (_, Quantity::Length, None, Some(constant)) => limits.constants.push((constant, size)),
                _ => self.problem(&name.span, ProblemKind::NotALimit(name.value.clone())).unwrap_or(()),
            }
        }
        limits
    }

    pub fn instrument(&mut self, draft: &Draft) -> Option<StatedInstrument> {
        let written = draft.instrument.as_ref()?;
        let mut instrument = match &written.preset {
            None => StatedInstrument::default(),
            Some(name) => StatedInstrument::preset(&name.value).or_else(|| {
                self.problem(&name.span, ProblemKind::OneOf(name.value.clone(), StatedInstrument::PRESETS))
            })?,
        };
        for Number { name, value } in &written.values {
            if !(value.is_finite() && *value >= 0.0) {
                self.problem::<()>(&name.span, ProblemKind::NotASize);
            }
            let (place, value) = match name.value.as_str() {
                "constant_um" => (&mut instrument.constant, Unit::Um.to_inner(*value)),
                "noise_um" => (&mut instrument.noise, Unit::Um.to_inner(*value)),
                "proportional" => (&mut instrument.proportional, *value),
                "bar_length_um" => (&mut instrument.bar_length, Unit::Um.to_inner(*value)),
                "temperature_k" => (&mut instrument.temperature, *value),
                "expansion_per_k" => (&mut instrument.expansion, *value),
                _ => continue,
            };
            *place = value;
        }
        Some(instrument)
    }
}
