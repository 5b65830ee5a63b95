//! The document for reading at a terminal.

use super::document::Document;
use super::printer::Style;
use crate::identify::Derivation;
use crate::model::Model;
use core::fmt::Write;

/// Readings, model equations, functions, base parameters and what cannot be told apart, as text.
pub fn text(model: &Model, derivation: &Derivation) -> String {
    let d = Document::new(model, derivation, Style::Pretty);
    let mut out = format!("{}: {}\n", model.name, model.title);
    let sweep = model.runs.first().map_or("a", |r| model.alphabet.sweep_name(r.sweep));
    let [_, sin, cos] = model.runs.first().map_or(["a", "s", "c"].map(str::to_owned), |r| {
        model.alphabet.sweep_symbols(r.sweep).map(|id| model.alphabet.nominal_name(id))
    });
    let _ = writeln!(out, "lengths in mm, angles in rad; {sin} = sin {sweep}, {cos} = cos {sweep}");
    for run in &derivation.runs {
        let _ = write!(out, "\nRun {}: the linear reading\n  ΔR = {}\n", run.name, d.reading(run));
        let _ = write!(out, "with its functions put in\n  ΔR = {}\n", d.equation(run));
    }
    let _ = writeln!(out, "\nFunctions");
    for (i, f) in model.functions.iter().enumerate() {
        let name = d.error(f.error);
        let x = d.coordinate(i);
        let _ = match d.function(i, &x) {
            Some(written) => writeln!(out, "  {name}({x}) = {written}"),
            None => writeln!(out, "  {name}({x}) known, from another measurement"),
        };
    }
    let _ = writeln!(out, "\nBase parameters: rank {}", derivation.rank());
    let width = derivation.base.iter().map(|b| b.name.len()).max().unwrap_or(0);
    for b in &derivation.base {
        let _ = writeln!(out, "  {:width$} = {}", b.name, d.definition(&b.definition));
    }
    let _ = writeln!(out, "\nKernel: changing the parameters along any of these changes no reading");
    for vector in &derivation.kernel {
        let part = |(j, f): &(usize, crate::algebra::Fraction)| {
            format!("{}: {}", derivation.parameters[*j].name, d.printer.fraction(f))
        };
        let _ = writeln!(out, "  {}", vector.iter().map(part).collect::<Vec<_>>().join(", "));
    }
    let unseen: Vec<&str> = derivation.unseen.iter().map(|e| model.alphabet.error_name(*e)).collect();
    let _ = writeln!(out, "\nNot seen at first order: {}", unseen.join(", "));
    out
}
