//! Where the rotary axes are, as a control's kinematics take it: from location errors that were estimated.

use super::digits::{comments, decimal};
use crate::study::{Curve, Setup};
use thiserror::Error;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::model::{AxisKind, Component, Model, iso_location};
use trunnion_codegen::quantity::Quantity;

/// A location error that was estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// Its ISO 230-1 name.
    pub iso: String,
    /// A length or an angle.
    pub quantity: Quantity,
    /// mm or rad.
    pub value: f64,
    /// Its expanded uncertainty, 95 %.
    pub u95: f64,
}

/// Why there are no pivots for a control.
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
}

/// The location errors among estimated functions that are determined.
pub fn located(setup: &Setup, curves: &[Curve]) -> Vec<Located> {
    let one = |curve: &Curve| {
        let function = &setup.model.functions[curve.function];
        let iso = setup.model.iso_location(function.error)?;
        let point = curve.points.first().filter(|_| curve.told.extent == Extent::Determined)?;
        let [value, u95] = [point.value, point.u95].map(|x| curve.unit.to_inner(x));
        Some(Located { iso, quantity: setup.quantity(curve.function), value, u95 })
    };
    curves.iter().filter_map(one).collect()
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

/// HAL commands that set the pins of LinuxCNC's kinematics, from what they are now (mm; 0 of those not given) and what was found.
///
/// # Errors
/// [`NoPivots`]
pub fn linuxcnc(
    model: &Model,
    located: &[Located],
    now: &[(String, f64)],
    notes: &[String],
) -> Result<String, NoPivots> {
    let turning = |side: &[trunnion_codegen::model::Axis]| {
        let rotary = side.iter().filter(|axis| axis.kind == AxisKind::Rotary);
        rotary.map(|axis| axis.name.clone()).collect::<Vec<_>>()
    };
    let (table, head) = (turning(&model.workpiece), turning(&model.tool));
    let own = |k: &&Kinematics| head.is_empty() && table == [k.tilting, "C"];
    let machine = || format!("rotary axes {} in the table, {} in the head", listed(&table), listed(&head));
    let kinematics = KINEMATICS.iter().find(own).ok_or_else(|| NoPivots::NoKinematics(machine()))?;
    let (module, pins) = (kinematics.module, kinematics.pins);
    if let Some((pin, _)) = now.iter().find(|(name, _)| pins.iter().all(|(own, _)| own != name)) {
        let pins = pins.iter().map(|(own, _)| *own).collect::<Vec<_>>().join(", ");
        return Err(NoPivots::NoPin { pin: pin.clone(), module, pins });
    }
    let found = |name: &str| located.iter().find(|own| own.iso == name);
    let mut missing: Vec<String> = Vec::new();
    for (name, _) in pins.iter().flat_map(|(_, sum)| sum.iter()).filter(|(name, _)| found(name).is_none()) {
        if missing.iter().all(|other| other != name) {
            missing.push((*name).to_owned());
        }
    }
    if !missing.is_empty() {
        return Err(NoPivots::Missing(missing));
    }
    let mut text = comments("#", notes);
    for (pin, sum) in pins {
        let before = now.iter().find(|(name, _)| name == pin).map_or(0.0, |(_, value)| *value);
        let change: f64 = sum.iter().filter_map(|(name, factor)| Some(found(name)?.value * factor)).sum();
        let term = |(name, factor): &(&str, f64)| format!("{} {name}", if *factor < 0.0 { "-" } else { "+" });
        let terms: Vec<String> = sum.iter().map(term).collect();
        text += &format!("# {} {}\n", decimal(before, 6), terms.join(" "));
        text += &format!("setp {module}.{pin} {}\n", decimal(before + change, 6));
    }
    let used = |own: &&Located| pins.iter().any(|(_, sum)| sum.iter().any(|(name, _)| *name == own.iso));
    let left = located.iter().filter(|own| !used(own)).map(|own| format!("no pin for {}", words(own)));
    Ok(text + &comments("#", &left.collect::<Vec<_>>()))
}

/// Offsets and directions for the kinematic chain of a SINUMERIK, as comments for a person to enter.
pub fn sinumerik(model: &Model, located: &[Located], notes: &[String]) -> String {
    let mut text = comments(";", notes);
    text += "; NOT VERIFIED ON A CONTROL. The control has the elements of the chain under indices of its own: what is to be added\n\
             ; to the offset before each axis, mm, and what to the vector of its direction, whose length stays 1 to first order\n";
    for axis in model.axes().filter(|axis| axis.kind == AxisKind::Rotary) {
        let of = |component: Component| {
            let name = iso_location(component, &axis.name);
            located.iter().find(|own| own.iso == name).map_or(0.0, |own| own.value)
        };
        let all = Component::ALL.map(of);
        let number = |p| trunnion_codegen::algebra::at(p, &model.alphabet, 0.0, |_| 0.0);
        let n: [f64; 3] = axis.direction.each_ref().map(number);
        let [x, y, z, a, b, c] = all;
        // A direction turned by small angles: n + (a, b, c) × n.
        let turned = [b * n[2] - c * n[1], c * n[0] - a * n[2], a * n[1] - b * n[0]];
        let three = |v: [f64; 3], digits| v.map(|x| decimal(x, digits)).join(", ");
        text += &format!("; offset before {}: $NK_OFF_DIR += ({})\n", axis.name, three([x, y, z], 6));
        text += &format!("; direction of {}: $NK_OFF_DIR += ({})\n", axis.name, three(turned, 9));
    }
    text
}

/// `EB0A = -80.60 ± 1.49 µrad`
pub fn words(own: &Located) -> String {
    let unit = own.quantity.deviation();
    let [value, u95] = [own.value, own.u95].map(|x| unit.from_inner(x));
    format!("{} = {value:.2} +- {u95:.2} {unit}", own.iso)
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named_once() {
        let setup = Setup::from_catalogue("ac-trunnion-probe", &[]).unwrap();
        let missing = ["EX0C", "EY0A", "EY0C", "EZ0A"].map(str::to_owned).to_vec();
        assert_eq!(linuxcnc(&setup.model, &[], &[], &[]), Err(NoPivots::Missing(missing)));
    }
}
