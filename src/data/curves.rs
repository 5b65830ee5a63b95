//! Estimated functions as files, one each.

use super::columns::{SWEEP, Wanted, deviation};
use super::output::{Files, WriteError, WriteProblem};
use super::written::written;
use crate::plot::MADE;
use crate::study::{Curve, CurvePoint, Report};
use std::path::Path;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::problems::visible;
use trunnion_codegen::quantity::{Quantity, Unit};

/// A file of each estimated function that is seen, named after it: its coordinate and its value with standard and expanded
/// uncertainty; but for the last column as a table of known functions has them. Where it is seen in a sum, that is S, with its
/// expanded uncertainty and that of the function.
///
/// # Errors
/// [`WriteError`] for values that are not finite; `directory` is where they will stand.
pub fn curve_files(report: &Report, directory: &Path) -> Result<Files<'static>, WriteError> {
    let mut files = Files::default();
    for curve in report.functions.iter().filter(|curve| !curve.points.is_empty()) {
        let name = format!("{}.csv", curve.name);
        let lines = contents(curve).map_err(|problem| WriteError { file: directory.join(&name), problem })?;
        let sum = curve.told.sum.as_ref().filter(|_| curve.told.extent == Extent::UpTo);
        let sum = sum.map_or(String::new(), |sum| format!("; S = {sum}"));
        let head = format!("# {}: {} {MADE}; u: standard, u95: expanded uncertainty{sum}", report.model, curve.name);
        files.add(name, [format!("{}\n", visible(&head)).as_bytes(), &lines].concat());
    }
    Ok(files)
}

/// A column's name without its unit, and what is in it.
type Column = (String, fn(&CurvePoint) -> f64);

fn contents(curve: &Curve) -> Result<Vec<u8>, WriteProblem> {
    let quantity = if curve.unit == Unit::Urad { Quantity::Angle } else { Quantity::Length };
    let name = &curve.name;
    let (value, std) = (|p: &CurvePoint| p.value, |p: &CurvePoint| p.std);
    let (u95, sum_u95) = (|p: &CurvePoint| p.u95, |p: &CurvePoint| p.sum_u95);
    let columns: [Column; 3] = match curve.told.extent {
        Extent::UpTo => [("S".to_owned(), value), ("u95_S".to_owned(), sum_u95), (format!("u95_{name}"), u95)],
        _ => [(name.clone(), value), (format!("u_{name}"), std), (format!("u95_{name}"), u95)],
    };
    let along = if curve.coordinate_unit == Unit::Deg { SWEEP } else { deviation(Quantity::Length) };
    let first = Wanted::new(&curve.coordinate, along);
    let wanted: Vec<(Wanted, Unit)> = std::iter::once((first, curve.coordinate_unit))
        .chain(columns.iter().map(|(name, _)| (Wanted::new(name, deviation(quantity)), curve.unit)))
        .collect();
    let line = |p: &CurvePoint| {
        let values = columns.iter().map(|(_, of)| curve.unit.to_inner(of(p)));
        std::iter::once(curve.coordinate_unit.to_inner(p.at)).chain(values).collect()
    };
    written(&wanted, curve.points.iter().map(line))
}
