//! The document for a paper or a report: equations of `amsmath`, to be included between `\begin{document}` and its end.

use super::document::Document;
use super::printer::Style;
use crate::identify::Derivation;
use crate::ids::FunctionId;
use crate::model::Model;
use core::fmt::Write;

/// Readings, model equations, functions and base parameters as LaTeX.
pub fn latex(model: &Model, derivation: &Derivation) -> String {
    let d = Document::new(model, derivation, Style::Latex);
    let mut out = format!("% {}: {}\n% lengths in mm, angles in rad\n", model.name, model.title);
    let mut align = |lines: Vec<String>| {
        let _ = writeln!(out, "\\begin{{align}}\n{}\n\\end{{align}}", lines.join(" \\\\\n"));
    };
    for (i, run) in derivation.runs.iter_enumerated() {
        let left = format!("{}_{{\\mathrm{{{}}}}}", d.label(i), run.name);
        align(vec![format!("{left} &= {}", d.reading(run)), format!("{left} &= {}", d.equation(run))]);
    }
    let function = |(i, f): (FunctionId, &crate::model::Function)| {
        let x = d.coordinate(i);
        Some(format!("{}({x}) &= {}", d.error(f.error), d.function(i, &x)?))
    };
    align(model.functions.iter_enumerated().filter_map(function).collect());
    align(
        derivation
            .base
            .iter()
            .map(|b| format!("{} &= {}", d.printer.name(&b.name), d.definition(&b.definition)))
            .collect(),
    );
    out
}
