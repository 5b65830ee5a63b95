//! Where rotary axes are, as one JSON object.

use crate::export::{Added, Chained, Estimate, Located, Pin, Pins};
use serde_json::{Value, json};

/// The file, the location errors, and what a control takes: the pins of LinuxCNC's kinematics, or what is added to a kinematic chain; each
/// value with its standard uncertainty and its expanded one of 95 %, in its unit.
pub fn pivots(file: &str, located: &Located, pins: Option<&Pins>, chain: &[Chained]) -> Value {
    let errors = located.each().map(|(name, own)| named(name, &own));
    let mut object = json!({ "file": file, "location_errors": errors.collect::<Vec<_>>() });
    if let Some(own) = pins {
        object["kinematics"] = json!(own.module);
        object["pins"] = own.pins.iter().map(pin).collect();
    } else if !chain.is_empty() {
        object["chain"] = chain.iter().map(chained).collect();
    }
    object
}

fn named(name: &str, own: &Estimate) -> Value {
    let unit = own.quantity.deviation();
    let [value, std, u95] = [own.value, own.std, own.u95].map(|x| unit.from_inner(x));
    json!({ "name": name, "unit": unit.suffix(), "value": value, "std": std, "u95": u95 })
}

/// What it is and is to be in mm, null if it was not said what it is, and what is added to it.
fn pin(pin: &Pin) -> Value {
    let mut object = named(pin.name, &pin.change);
    object["value_mm"] = json!(pin.value());
    object["now_mm"] = json!(pin.now);
    object["sum"] = pin.sum.iter().map(|(name, factor)| json!({ "name": name, "factor": factor })).collect();
    object
}

fn chained(own: &Chained) -> Value {
    let three = |values: &[Added; 3]| -> Value {
        let each = ["x", "y", "z"].iter().zip(values);
        let found =
            |(along, own): (&&str, &Added)| if let Added::Found(own) = own { Some(named(along, own)) } else { None };
        each.filter_map(found).collect()
    };
    json!({
        "axis": own.axis,
        "offset": three(&own.offset),
        "direction": three(&own.direction),
        "not_determined": own.unknown(),
    })
}
