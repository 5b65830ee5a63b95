//! The document for a paper or a report: equations of `amsmath`, to be included between `\begin{document}` and its end.

use super::document::Document;
use super::printer::Style;
use crate::emit::layout::equation;
use crate::identify::Derivation;
use crate::ids::FunctionId;
use crate::model::Model;
use crate::source::visible;
use core::fmt::Write;

/// Readings, model equations, functions and base parameters as LaTeX.
pub fn latex(model: &Model, derivation: &Derivation) -> String {
    let d = Document::new(model, derivation, Style::Latex);
    let mut out = format!("% {}: {}\n% lengths in mm, angles in rad\n", model.name, visible(&model.title));
    for assumption in &model.assumptions {
        let _ = writeln!(out, "% assumed: {}", visible(&assumption.text));
    }
    let mut align = |lines: Vec<String>| {
        let _ = writeln!(out, "\\begin{{align}}\n{}\n\\end{{align}}", lines.join(" \\\\\n"));
    };
    for (i, run) in derivation.runs.iter_enumerated() {
        let left = format!("{}_{{\\mathrm{{{}}}}}", d.label(i), run.name.replace('_', "\\_"));
        let start = format!("{left} &= ");
        align([d.reading(run), d.equation(run)].map(|right| equation(&start, &right, 2)).into());
    }
    let function = |(i, f): (FunctionId, &crate::model::ErrorFunction)| {
        let x = d.printer.name(&d.coordinate(i));
        Some(equation(&format!("{}({x}) &= ", d.error(f.error)), &d.function(i, &x)?, 2))
    };
    align(d.functions().filter_map(function).collect());
    align(
        derivation
            .base
            .iter()
            .map(|b| equation(&format!("{} &= ", d.printer.name(&b.name)), &d.definition(&b.definition), 2))
            .collect(),
    );
    out
}
