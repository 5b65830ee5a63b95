//! Ranges of axes in place of the model's.

use super::setup::coordinate;
use super::visited::in_unit;
use trunnion_codegen::model::{Draft, Model};

/// Gives an axis its range, degrees or mm, lowest first; false where the machine has no axis of that name.
pub fn set_range(model: &mut Model, axis: &str, ends: [f64; 2]) -> bool {
    let axis = model.workpiece.iter_mut().chain(&mut model.tool).find(|own| own.name == axis);
    axis.map(|axis| axis.range = Some(ends.map(|end| coordinate(axis).coordinate().to_inner(end)))).is_some()
}

/// Writes a model's ranges into its draft.
pub fn write_ranges(model: &Model, draft: &mut Draft) {
    for axis in model.axes() {
        let unit = coordinate(axis).coordinate();
        let own = draft.axes.iter_mut().filter(|own| own.name.value == axis.name);
        own.for_each(|own| own.range = axis.range.map(|range| range.map(|end| in_unit(unit, end))));
    }
}
