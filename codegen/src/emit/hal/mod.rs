//! A model as a realtime component of LinuxCNC: the C99 solver in a file that `halcompile` builds as it is.
//!
//! Runs are sampled in the servo thread; the solution is a function of its own for a slower one, on a copy that the servo
//! thread makes when it is asked for one, so that no thread waits for the other and none sees half a sample.

mod calls;
mod error;
mod pins;

use calls::Calls;
pub use error::ComponentError;
use pins::{Item, Pins, quoted};

use super::c::{self, Precision};
use super::c99;
use super::header;
use super::names::{HAL, MODULES, Rules};
use crate::identify::Derivation;
use crate::model::Model;

const TEMPLATE: &str = include_str!("component.in");

const KIND: c99::Kind = c99::Kind {
    rules: Rules { words: &HAL, ..c::RULES },
    stems: &MODULES,
    // Of the 47 characters of a pin, the rest is for its run and what it is.
    longest: 20,
    template: TEMPLATE,
};

/// Bytes of HAL's memory, 340 KiB for all components of a session, that an instance may take: a triangle, its copy and a
/// covariance.
const MEMORY: usize = 128 * 1024;

/// A component's name and its source, to be saved as `{name}.comp`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// As LinuxCNC loads it: `tilting_table_a`, whose pins begin with `tilting-table-a.0.`
    pub name: String,
    /// What `halcompile` takes.
    pub source: String,
}

/// Prints the component: pins and parameters, the solver in `double`, and what calls it.
///
/// # Errors
/// The model has more base parameters than HAL has memory for.
pub fn component(model: &Model, derivation: &Derivation) -> Result<Component, ComponentError> {
    let (unknowns, most) = (derivation.base.len(), (MEMORY / (3 * size_of::<f64>())).isqrt());
    if unknowns > most {
        return Err(ComponentError::TooManyUnknowns { unknowns, most });
    }
    let printed = c99::printed(model, derivation, Precision::Double, &KIND)?;
    let prefix = &printed.sources.prefix;
    let mut pins = Pins::new(prefix);
    for (item, name, value, meaning) in OWN {
        pins.declare(item, name, value, meaning);
    }
    let mut calls = Calls::new(model, derivation, prefix, pins);
    let samples: String = printed.pushes.iter().map(|push| calls.sample(push)).collect();
    let values: String = printed.values.iter().map(|value| calls.value(value)).collect();
    let source = TEMPLATE
        .replace("@head@", &header("//", &quoted(&model.name)))
        .replace("@prefix@", prefix)
        .replace("@PREFIX@", &prefix.to_uppercase())
        .replace("@hal@", &prefix.replace('_', "-"))
        .replace("@samples@", &samples)
        .replace("@values@", &values)
        .replace("@pins@", &calls.pins.lines)
        .replace("@model@", &quoted(&model.name))
        .replace("@sources@", &printed.sources.single());
    Ok(Component { name: printed.sources.prefix, source })
}

/// What every component has.
#[rustfmt::skip]
const OWN: [(Item, &str, &str, &str); 8] = [
    (Item::Bit, "reset", "", "While true the fit has no samples"),
    (Item::Count, "samples", "", "Samples taken since the last reset"),
    (Item::Count, "refused", "", "Samples refused since then"),
    (Item::Status, "status", "", "Why the last of these was refused; 0 without any"),
    (Item::Status, "solve_status", NOT_INITIALISED, "Whether there is a solution: 0"),
    (Item::Count, "solutions", "", "How often it was asked"),
    (Item::Count, "solve_samples", "", "Samples that the solution is made of"),
    (Item::Output, "residual_um", "", "Standard deviation of the residuals"),
];

/// The status of what was never solved for.
const NOT_INITIALISED: &str = "3";
