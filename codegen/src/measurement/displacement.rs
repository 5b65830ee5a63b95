//! The displacement of the tool ball against the workpiece ball along one direction: an R-test's channel, a probed sphere.

use super::error::{ReadingError, length};
use crate::algebra::{Order, Poly, PolyVector, difference, dot};
use crate::kinematics::ball_positions;
use crate::model::{Model, Run};

/// `n · (TB − WB)` up to `order` errors.
///
/// Nominally the balls must coincide: then the instrument's own orientation enters only with a second error.
pub(super) fn displacement(
    model: &Model,
    run: &Run,
    direction: &PolyVector,
    order: Order,
) -> Result<Poly, ReadingError> {
    let alphabet = &model.alphabet;
    let [workpiece, tool] = ball_positions(model, run, order)?;
    let v = difference(&tool, &workpiece)?;
    let nominal = v.each_ref().map(|p| p.of_order(0));
    let square = dot(&nominal, &nominal, Order::NOMINAL)?.normal(alphabet)?;
    if !square.vanishes(alphabet)? {
        return Err(ReadingError::NotTogether(length(&square)?));
    }
    Ok(dot(direction, &v, order)?.normal(alphabet)?)
}
