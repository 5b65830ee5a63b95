//! From values to the text of a file: a header with units, then a line a sample.

use std::io::{self, Write};

use super::columns::Wanted;
use super::output::WriteProblem;
use trunnion_codegen::quantity::Unit;

/// Columns of values (mm or rad) in their units, below a header.
pub(crate) fn written(
    columns: &[(Wanted, Unit)],
    lines: impl Iterator<Item = Vec<f64>>,
) -> Result<Vec<u8>, WriteProblem> {
    let mut out = Vec::new();
    let mut table = Writing::new(&mut out, columns)?;
    lines.into_iter().try_for_each(|values| table.line(&values))?;
    table.end()?;
    Ok(out)
}

/// A table that is being written.
pub(crate) struct Writing<'a, W: Write> {
    writer: csv::Writer<W>,
    columns: &'a [(Wanted<'a>, Unit)],
    line: usize,
}

impl<'a, W: Write> Writing<'a, W> {
    /// Writes the header.
    pub fn new(out: W, columns: &'a [(Wanted<'a>, Unit)]) -> Result<Self, WriteProblem> {
        if let Some((_, unit)) = columns.iter().find(|(wanted, unit)| !wanted.units.contains(unit)) {
            return Err(WriteProblem::Unit(*unit));
        }
        let mut writer = csv::Writer::from_writer(out);
        let header = columns.iter().map(|(wanted, unit)| format!("{}_{unit}", wanted.name));
        writer.write_record(header).map_err(refused)?;
        Ok(Self { writer, columns, line: 1 })
    }

    /// Writes a line of values.
    pub fn line(&mut self, values: &[f64]) -> Result<(), WriteProblem> {
        self.line += 1;
        if values.len() != self.columns.len() {
            return Err(WriteProblem::Count { line: self.line, found: values.len(), expected: self.columns.len() });
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(WriteProblem::NotFinite { line: self.line, column: at + 1 });
        }
        let fields = self.columns.iter().zip(values).map(|((_, unit), value)| unit.decimal(*value));
        self.writer.write_record(fields).map_err(refused)
    }

    /// Ends it.
    pub fn end(mut self) -> Result<(), WriteProblem> {
        Ok(self.writer.flush()?)
    }
}

fn refused(error: csv::Error) -> WriteProblem {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error.into(),
        _ => WriteProblem::Refused(io::ErrorKind::InvalidData),
    }
}
