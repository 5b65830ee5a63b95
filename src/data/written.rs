//! From values to the text of a file: a header with units, then a line a sample.

use std::io;

use super::columns::Wanted;
use super::output::WriteProblem;
use trunnion_codegen::quantity::Unit;

/// Columns of values (mm or rad) in their units, below a header.
pub(crate) fn written(
    columns: &[(Wanted, Unit)],
    lines: impl Iterator<Item = Vec<f64>>,
) -> Result<Vec<u8>, WriteProblem> {
    if let Some((_, unit)) = columns.iter().find(|(wanted, unit)| !wanted.units.contains(unit)) {
        return Err(WriteProblem::Unit(*unit));
    }
    let refused = |_| WriteProblem::Refused(io::ErrorKind::InvalidData);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|(wanted, unit)| format!("{}_{unit}", wanted.name))).map_err(refused)?;
    for (line, values) in (2..).zip(lines) {
        if values.len() != columns.len() {
            return Err(WriteProblem::Count { line, found: values.len(), expected: columns.len() });
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(WriteProblem::NotFinite { line, column: at + 1 });
        }
        let fields = columns.iter().zip(values).map(|((_, unit), value)| unit.decimal(value));
        writer.write_record(fields).map_err(refused)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
