//! Offsets and directions for the kinematic chain of a SINUMERIK, as comments for a person to enter.

use super::located::{Estimate, Located};
use crate::export::digits::{comments, decimal};
use trunnion_codegen::algebra::at;
use trunnion_codegen::model::{Axis, AxisKind, Component, Model, iso_location};

/// What is to be added for a rotary axis; none where no location error that was found has a part in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Chained {
    /// The axis.
    pub axis: String,
    /// To the offset before it, along X, Y and Z, mm.
    pub offset: [Option<Estimate>; 3],
    /// To its direction, whose length stays 1 to first order; rad.
    pub direction: [Option<Estimate>; 3],
}

/// What is to be added for each rotary axis of a model.
pub fn chain(model: &Model, located: &Located) -> Vec<Chained> {
    let rotary = model.axes().filter(|axis| axis.kind == AxisKind::Rotary);
    let one = |axis: &Axis| {
        let names = Component::ALL.map(|component| iso_location(component, &axis.name));
        let [x, y, z, a, b, c] = names.each_ref().map(String::as_str);
        let n: [f64; 3] = axis.direction.each_ref().map(|p| at(p, &model.alphabet, 0.0, |_| 0.0));
        // A direction turned by small angles: n + (a, b, c) × n.
        let turned = [[(b, n[2]), (c, -n[1])], [(c, n[0]), (a, -n[2])], [(a, n[1]), (b, -n[0])]];
        Chained {
            axis: axis.name.clone(),
            offset: [x, y, z].map(|name| located.sum([(name, 1.0)])),
            direction: turned.map(|sum| located.sum(sum.into_iter().filter(|(_, factor)| *factor != 0.0))),
        }
    };
    rotary.map(one).collect()
}

/// The same as comments.
pub fn text(chain: &[Chained], notes: &[String]) -> String {
    let mut text = comments(";", notes);
    text += "; NOT VERIFIED ON A CONTROL. The control has the elements of the chain under indices of its own: what is to be added\n\
             ; to the offset before each axis, mm, and what to the vector of its direction, whose length stays 1 to first order;\n\
             ; behind each its expanded uncertainty (95 %), with what the errors in it have in common\n";
    let three = |own: &[Option<Estimate>; 3], digits: usize, of: fn(&Estimate) -> f64| {
        own.each_ref().map(|own| decimal(own.as_ref().map_or(0.0, of), digits)).join(", ")
    };
    for own in chain {
        for (what, values, digits) in [("offset before", &own.offset, 6), ("direction of", &own.direction, 9)] {
            let [values, u95] =
                [(|e: &Estimate| e.value) as fn(&Estimate) -> f64, |e| e.u95].map(|of| three(values, digits, of));
            text += &format!("; {what} {}: $NK_OFF_DIR += ({values})  +- ({u95})\n", own.axis);
        }
    }
    text
}
