//! The calls that a component makes of its model's functions, with the pins that they take.

use super::pins::{Item, Pins};
use crate::algebra::Nominal;
use crate::emit::c99::{Push, Value};
use crate::emit::equations::{Style, extent};
use crate::emit::layout::listed;
use crate::emit::model::{known_name, moves};
use crate::graph::Symbol;
use crate::identify::Derivation;
use crate::model::{AxisKind, Model, ReadingKind};
use crate::quantity::{Quantity, Unit};

/// Declares pins as calls need them.
pub(super) struct Calls<'a> {
    model: &'a Model,
    derivation: &'a Derivation,
    prefix: &'a str,
    /// The lengths of the set-up, in C.
    lengths: Vec<String>,
    pub pins: Pins,
}

impl<'a> Calls<'a> {
    /// With a parameter for each length of the set-up.
    pub fn new(model: &'a Model, derivation: &'a Derivation, prefix: &'a str, mut pins: Pins) -> Self {
        let is_bar = |id| model.runs.iter().any(|run| run.reading == ReadingKind::BarLength(id));
        let usual = |id| model.lengths.iter().find(|(of, _)| *of == id).map(|(_, mm)| format!("{mm:?}"));
        let mut parameter = |id, name: &str| {
            let what = if is_bar(id) { "Nominal length of the bar" } else { "Length of the set-up" };
            let stem = pins.stem(name, &["_mm"]);
            let name = pins.declare(Item::Parameter, &format!("{stem}_mm"), &usual(id).unwrap_or_default(), what);
            format!("inst->{name}")
        };
        let constants = model.alphabet.nominals().filter_map(|(id, nominal)| match nominal {
            Nominal::Constant(name) => Some(parameter(id, name)),
            _ => None,
        });
        let lengths = constants.collect();
        Self { model, derivation, prefix, lengths, pins }
    }

    /// Takes a run's sample while its gate is open.
    pub fn sample(&mut self, push: &Push) -> String {
        let run = &self.derivation.runs[push.run];
        let (alphabet, pins, name) = (&self.model.alphabet, &mut self.pins, &run.name);
        let stem = pins.stem(name, &["_sample", "_at_deg", "_dr_um"]);
        let gate = pins.declare(Item::Bit, &format!("{stem}_sample"), "", &format!("Take samples of run {name}"));
        let mut arguments = vec!["&own->fit".to_owned()];
        arguments.extend(self.lengths.iter().cloned());
        for input in push.inputs.iter().skip(self.lengths.len()) {
            let Symbol::Nominal(id) = input.symbol() else { continue };
            arguments.push(match alphabet.nominal(id) {
                Nominal::Sweep(_) => {
                    let what = format!("The sweep {} of run {name}", input.name());
                    scaled(&pins.declare(Item::Input, &format!("{stem}_at_deg"), "", &what), Unit::Deg)
                }
                Nominal::Arctangent { .. } => {
                    scaled(&pins.named(&stem, input.name(), Some(Unit::Deg), &moves(self.model, id)), Unit::Deg)
                }
                _ => format!("*inst->{}", pins.named(&stem, input.name(), None, &moves(self.model, id))),
            });
        }
        let reading = pins.declare(Item::Input, &format!("{stem}_dr_um"), "", &format!("What run {name} reads"));
        arguments.push(scaled(&reading, Unit::Um));
        for (function, _) in &run.known {
            let error = self.model.functions[*function].error;
            let unit = alphabet.error_quantity(error).deviation();
            let what = format!("The known {} there", alphabet.error_name(error));
            arguments.push(scaled(&pins.named(&stem, &known_name(self.model, *function), Some(unit), &what), unit));
        }
        let (prefix, call) = (self.prefix, listed(&format!("{}(", push.called), &arguments, ")", 20));
        format!(
            "        if (*inst->{gate}) {{\n            {prefix}_answer(\n                inst,\n                {call}\n            );\n        }}\n"
        )
    }

    /// Evaluates an estimated function where its pin says; a location error is the same everywhere.
    pub fn value(&mut self, value: &Value) -> String {
        let Self { model, derivation, prefix, lengths, pins } = self;
        let function = &model.functions[value.function];
        let name = model.alphabet.error_name(function.error);
        let unit = model.alphabet.error_quantity(function.error).deviation();
        let axis = model.axis_of_function(value.function).filter(|_| !function.is_location());
        let coordinate = axis.map(|(_, axis)| match axis.kind {
            AxisKind::Rotary => Quantity::Angle.coordinate(),
            AxisKind::Linear => Quantity::Length.coordinate(),
        });
        let [at_end, end, std_end] = [("_at", coordinate), ("", Some(unit)), ("_std", Some(unit))]
            .map(|(end, unit)| format!("{end}_{}", unit.map_or("", Unit::suffix)));
        let stem = pins.stem(name, &[&at_end, &end, &std_end]);
        let mut pin = |item, end: &str, meaning: String| pins.declare(item, &format!("{stem}{end}"), "", &meaning);
        let mut arguments = vec!["&own->estimate".to_owned()];
        arguments.extend(lengths.iter().cloned());
        if let Some(unit) = coordinate {
            arguments.push(scaled(&pin(Item::Input, &at_end, format!("Where {name} is evaluated")), unit));
        }
        arguments.extend(["&value", "&std"].map(str::to_owned));
        let determination = derivation.functions.iter().find(|d| d.function == value.function);
        let told = determination.map_or(String::new(), |d| extent(model, derivation, d, Style::Plain));
        let there = if coordinate.is_some() { " there" } else { "" };
        let value_pin = pin(Item::Output, &end, format!("{name}{there}, which is {told}"));
        let std_pin = pin(Item::Output, &std_end, "Its standard deviation, from the residuals".to_owned());
        let call = listed(&format!("            status = {}(", value.called), &arguments, ");", 16);
        let (ok, unit) = (format!("{}_OK", prefix.to_uppercase()), unit.factor());
        format!(
            "    {{\n        double value = 0, std = 0;\n        if (status == {ok}) {{\n{call}\n        }}\n        \
             *inst->{value_pin} = value / {unit:?};\n        *inst->{std_pin} = std / {unit:?};\n    }}\n"
        )
    }
}

/// What stands on a pin, in mm or rad.
fn scaled(pin: &str, unit: Unit) -> String {
    format!("*inst->{pin} * {:?}", unit.factor())
}
