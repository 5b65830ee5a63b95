//! Offsets and directions for the kinematic chain of a SINUMERIK, as comments for a person to enter.

use super::located::{Estimate, Located};
use crate::export::digits::{comments, decimal};
use trunnion_codegen::algebra::at;
use trunnion_codegen::model::{Axis, AxisKind, Component, Model, iso_location};

/// What is to be added for a rotary axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Chained {
    /// The axis.
    pub axis: String,
    /// To the offset before it, along X, Y and Z, mm.
    pub offset: [Added; 3],
    /// To its direction, whose length stays 1 to first order; rad.
    pub direction: [Added; 3],
}

/// What is to be added to a coordinate.
#[derive(Clone, Debug, PartialEq)]
pub enum Added {
    /// Nothing: it has no part in where the axis is.
    Nothing,
    /// What was found.
    Found(Estimate),
    /// These location errors are in it, and not all of them were determined.
    Unknown(Vec<String>),
}

impl Added {
    /// The sum of location errors, each with its factor.
    fn of(located: &Located, sum: &[(&str, f64)]) -> Self {
        let parts: Vec<_> = sum.iter().copied().filter(|(_, factor)| *factor != 0.0).collect();
        let unknown = parts.iter().filter(|(name, _)| !located.has(name)).map(|(name, _)| (*name).to_owned());
        match located.sum(parts.iter().copied()) {
            Some(found) => Self::Found(found),
            None if parts.is_empty() => Self::Nothing,
            None => Self::Unknown(unknown.collect()),
        }
    }
}

impl Chained {
    /// The location errors that would be needed and were not determined, each once.
    pub fn unknown(&self) -> Vec<&str> {
        let unknown = self.offset.iter().chain(&self.direction).filter_map(|added| match added {
            Added::Unknown(names) => Some(names),
            Added::Nothing | Added::Found(_) => None,
        });
        let mut names: Vec<&str> = unknown.flatten().map(String::as_str).collect();
        names.sort_unstable();
        names.dedup();
        names
    }
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
            // Along itself it is anywhere.
            offset: [(x, n[0]), (y, n[1]), (z, n[2])]
                .map(|(name, along)| Added::of(located, &[(name, if along.abs() == 1.0 { 0.0 } else { 1.0 })])),
            direction: turned.map(|sum| Added::of(located, &sum)),
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
    let three = |own: &[Added; 3], digits: usize, of: fn(&Estimate) -> f64| {
        let each = own.each_ref().map(|own| match own {
            Added::Nothing => decimal(0.0, digits),
            Added::Found(found) => decimal(of(found), digits),
            Added::Unknown(_) => String::from("?"),
        });
        each.join(", ")
    };
    for own in chain {
        for (what, values, digits) in [("offset before", &own.offset, 6), ("direction of", &own.direction, 9)] {
            let [values, u95] =
                [(|e: &Estimate| e.value) as fn(&Estimate) -> f64, |e| e.u95].map(|of| three(values, digits, of));
            text += &format!("; {what} {}: $NK_OFF_DIR += ({values})  +- ({u95})\n", own.axis);
        }
        let unknown = own.unknown();
        if !unknown.is_empty() {
            text += &format!("; ?: {} not determined; what the control has stays as it is\n", unknown.join(", "));
        }
    }
    text
}
