//! One number for a rotary axis: the largest of its location errors' valuation numbers.

use super::prediction::{Predicted, Prediction, Valuation};
use crate::study::Setup;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::{AxisId, FunctionId};
use trunnion_codegen::model::{Axis, AxisKind};
use trunnion_codegen::quantity::Quantity;

/// How well runs would tell where a rotary axis is.
#[derive(Clone, Debug, PartialEq)]
pub struct RotaryAxis {
    /// The axis.
    pub axis: AxisId,
    /// Of its linear location errors (EX0C, EY0C), µm for each µm; `None` where none is determined.
    pub linear: Option<LargestValuation>,
    /// Of its angular location errors (EA0C, EB0C), degrees for each µm; `None` where none is determined.
    pub angular: Option<LargestValuation>,
    /// Those that were asked for and have no number of their own: not seen, or only in a sum.
    pub not_determined: Vec<FunctionId>,
    /// Those that the model has and that were not asked for.
    pub without: Vec<ErrorId>,
}

/// The largest of some errors' valuation numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestValuation {
    /// The number.
    pub valuation: Valuation,
    /// Whose it is.
    pub function: FunctionId,
    /// Of which it is the largest.
    pub of: Vec<FunctionId>,
}

/// The rotary axes of which location errors are among the functions; readings have a standard deviation in mm.
pub fn rotary_axes(setup: &Setup, prediction: &Prediction, functions: &[FunctionId], sigma: f64) -> Vec<RotaryAxis> {
    let rotary = setup.model.axes().enumerate().filter(|(_, axis)| axis.kind == AxisKind::Rotary);
    rotary.filter_map(|(id, axis)| one(setup, prediction, functions, sigma, (id.into(), axis))).collect()
}

fn one(
    setup: &Setup,
    prediction: &Prediction,
    functions: &[FunctionId],
    sigma: f64,
    (id, axis): (AxisId, &Axis),
) -> Option<RotaryAxis> {
    let (mut linear, mut angular) = (None, None);
    let (mut not_determined, mut without) = (Vec::new(), Vec::new());
    let mut asked = false;
    for error in axis.location.into_iter().flatten() {
        let Some(&function) = functions.iter().find(|f| setup.model.functions[**f].error == error) else {
            without.push(error);
            continue;
        };
        asked = true;
        let own = prediction.functions.iter().find(|own| own.function == function);
        match own.and_then(|own| determined(own, setup, sigma)) {
            None => not_determined.push(function),
            Some(valuation) => {
                let place = if setup.quantity(function) == Quantity::Length { &mut linear } else { &mut angular };
                add(place, function, valuation);
            }
        }
    }
    asked.then_some(RotaryAxis { axis: id, linear, angular, not_determined, without })
}

/// The number of an error by itself, and not of a sum that it is seen in.
fn determined(own: &Predicted, setup: &Setup, sigma: f64) -> Option<Valuation> {
    own.valuation(setup, sigma).filter(|_| own.told.extent == Extent::Determined)
}

fn add(largest: &mut Option<LargestValuation>, function: FunctionId, valuation: Valuation) {
    let own = largest.get_or_insert_with(|| LargestValuation { valuation, function, of: Vec::new() });
    own.of.push(function);
    if valuation.value > own.valuation.value {
        (own.valuation, own.function) = (valuation, function);
    }
}
