//! The pins of LinuxCNC's kinematics.

use super::located::{Estimate, Located};
use crate::export::digits::{comments, decimal};
use thiserror::Error;
use trunnion_codegen::model::{Axis, AxisKind, Model};

/// Why there are no pivots for LinuxCNC.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NoPivots {
    /// No kinematics of LinuxCNC for such a machine.
    #[error("{0}: no kinematics of LinuxCNC that is known here\n  expected a table with C on A or B")]
    NoKinematics(String),
    /// Location errors that the kinematics need and that were not determined.
    #[error("{} not determined\n  expected a model that estimates them, and runs that determine them", .0.join(", "))]
    Missing(Vec<String>),
    /// A pin that the kinematics do not have.
    #[error("{pin}: no pin of {module}\n  expected {pins}")]
    NoPin {
        /// The pin.
        pin: String,
        /// The kinematics.
        module: &'static str,
        /// Its pins.
        pins: String,
    },
    /// A pin that is given twice.
    #[error("{0}: given twice\n  expected once what a pin is now")]
    Twice(String),
}

/// Kinematics of LinuxCNC: a table that turns about C on one that tilts.
struct Kinematics {
    module: &'static str,
    /// The tilting axis.
    tilting: &'static str,
    /// Each pin as a sum of location errors, each with its factor.
    pins: &'static [(&'static str, &'static [(&'static str, f64)])],
}

/// C is at x-rot-point and y-rot-point, the tilting axis beside it by the offsets (their own documentation, and tried for A).
const KINEMATICS: [Kinematics; 2] = [
    Kinematics {
        module: "xyzac-trt-kins",
        tilting: "A",
        pins: &[
            ("x-rot-point", &[("EX0C", 1.0)]),
            ("y-rot-point", &[("EY0A", 1.0), ("EY0C", 1.0)]),
            ("z-rot-point", &[("EZ0A", 1.0)]),
            ("y-offset", &[("EY0C", -1.0)]),
        ],
    },
    Kinematics {
        module: "xyzbc-trt-kins",
        tilting: "B",
        pins: &[
            ("x-rot-point", &[("EX0B", 1.0), ("EX0C", 1.0)]),
            ("y-rot-point", &[("EY0C", 1.0)]),
            ("z-rot-point", &[("EZ0B", 1.0)]),
            ("x-offset", &[("EX0C", -1.0)]),
        ],
    },
];

/// A pin of the kinematics.
#[derive(Clone, Debug, PartialEq)]
pub struct Pin {
    /// Its name.
    pub name: &'static str,
    /// What it is now, mm, if that was said.
    pub now: Option<f64>,
    /// What is added to it, mm, as certain as all the errors in it are together.
    pub change: Estimate,
    /// The location errors in that, with their factors.
    pub sum: &'static [(&'static str, f64)],
}

/// The pins of one of LinuxCNC's kinematics.
#[derive(Clone, Debug, PartialEq)]
pub struct Pins {
    /// The kinematics.
    pub module: &'static str,
    /// The pins.
    pub pins: Vec<Pin>,
    /// What was found and has no pin.
    pub left: Vec<(String, Estimate)>,
}

/// The pins for a model, from what is known of what they are now (mm) and what was found.
///
/// # Errors
/// [`NoPivots`]
pub fn pins(model: &Model, located: &Located, now: &[(String, f64)]) -> Result<Pins, NoPivots> {
    let Kinematics { module, pins, .. } = kinematics(model)?;
    if let Some((pin, _)) = now.iter().find(|(name, _)| pins.iter().all(|(own, _)| own != name)) {
        let pins = pins.iter().map(|(own, _)| *own).collect::<Vec<_>>().join(", ");
        return Err(NoPivots::NoPin { pin: pin.clone(), module, pins });
    }
    if let Some((_, (pin, _))) =
        now.iter().enumerate().find(|(k, (pin, _))| now[..*k].iter().any(|(own, _)| own == pin))
    {
        return Err(NoPivots::Twice(pin.clone()));
    }
    let missing = missing(pins, |name| located.has(name));
    if !missing.is_empty() {
        return Err(NoPivots::Missing(missing));
    }
    let pin = |&(name, sum): &(&'static str, &'static [(&'static str, f64)])| {
        let now = now.iter().find(|(own, _)| own == name).map(|(_, value)| *value);
        located.sum(sum.iter().copied()).map(|change| Pin { name, now, change, sum })
    };
    let used = |name: &str| pins.iter().any(|(_, sum)| sum.iter().any(|(own, _)| *own == name));
    let left = located.each().filter(|(name, _)| !used(name)).map(|(name, own)| (name.to_owned(), own));
    Ok(Pins { module, pins: pins.iter().filter_map(pin).collect(), left: left.collect() })
}

impl Pin {
    /// What it is to be, mm, if it is known what it is now.
    pub fn value(&self) -> Option<f64> {
        self.now.map(|now| now + self.change.value)
    }

    /// `- EY0C = -215.81 +- 0.36 um`
    pub fn words(&self) -> String {
        let term = |(name, factor): &(&str, f64)| format!("{} {name}", if *factor < 0.0 { "-" } else { "+" });
        let terms: Vec<String> = self.sum.iter().map(term).collect();
        format!("{} = {}", terms.join(" "), self.change.words())
    }
}

impl Pins {
    /// HAL commands that set them.
    pub fn text(&self, notes: &[String]) -> String {
        let mut text = comments("#", notes);
        for pin in &self.pins {
            text += &match (pin.now, pin.value()) {
                (Some(now), Some(value)) => format!(
                    "# {} {} (95 %)\nsetp {}.{} {}\n",
                    decimal(now, 6),
                    pin.words(),
                    self.module,
                    pin.name,
                    decimal(value, 6)
                ),
                _ => format!(
                    "# to be added to {}.{}, which was not given: {}, {} (95 %)\n",
                    self.module,
                    pin.name,
                    decimal(pin.change.value, 6),
                    pin.words()
                ),
            };
        }
        let left = self.left.iter().map(|(name, own)| format!("no pin for {name} = {}", own.words()));
        text + &comments("#", &left.collect::<Vec<_>>())
    }
}

/// The kinematics of a model's rotary axes.
fn kinematics(model: &Model) -> Result<&'static Kinematics, NoPivots> {
    let turning = |side: &[Axis]| {
        let rotary = side.iter().filter(|axis| axis.kind == AxisKind::Rotary);
        rotary.map(|axis| axis.name.clone()).collect::<Vec<_>>()
    };
    let (table, head) = (turning(&model.workpiece), turning(&model.tool));
    let own = |k: &&Kinematics| head.is_empty() && table == [k.tilting, "C"];
    let machine = || format!("rotary axes {} in the table, {} in the head", listed(&table), listed(&head));
    KINEMATICS.iter().find(own).ok_or_else(|| NoPivots::NoKinematics(machine()))
}

/// What pins need and was not found, each once.
fn missing(pins: &[(&str, &[(&str, f64)])], found: impl Fn(&str) -> bool) -> Vec<String> {
    let mut missing: Vec<String> = Vec::new();
    for (name, _) in pins.iter().flat_map(|(_, sum)| sum.iter()).filter(|(name, _)| !found(name)) {
        if missing.iter().all(|other| other != name) {
            missing.push((*name).to_owned());
        }
    }
    missing
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named_once() {
        assert_eq!(missing(KINEMATICS[0].pins, |name| name == "EX0C"), ["EY0A", "EY0C", "EZ0A"]);
    }
}
