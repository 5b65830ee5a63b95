//! The document for reading at a terminal.

use super::document::Document;
use super::extent::extent;
use super::printer::{Printer, Style};
use crate::algebra::{Alphabet, Nominal, Poly, Rational, SweepId, WrappedAngle};
use crate::emit::layout::{equation, prose};
use crate::emit::model::moves;
use crate::identify::Derivation;
use crate::model::Model;
use crate::source::visible;
use core::fmt::Write;

/// Readings, model equations, functions, base parameters and what cannot be told apart, as text.
pub fn text(model: &Model, derivation: &Derivation) -> String {
    let d = Document::new(model, derivation, Style::Pretty);
    let mut out = format!("{}: {}\n", model.name, visible(&model.title));
    let mut symbols = symbols(model).into_iter();
    let _ = writeln!(out, "lengths in mm, angles in rad; {}", symbols.next().unwrap_or_default());
    symbols.for_each(|symbol| {
        let _ = writeln!(out, "{symbol}");
    });
    for assumption in &model.assumptions {
        let _ = writeln!(out, "assumed: {}", assumption.text);
    }
    for (i, run) in derivation.runs.iter_enumerated() {
        let label = d.label(i);
        let start = format!("  {label} = ");
        let _ = writeln!(out, "\nRun {}: the linear reading\n{}", run.name, equation(&start, &d.reading(run), 7));
        let _ = writeln!(out, "with its functions put in\n{}", equation(&start, &d.equation(run), 7));
    }
    let _ = writeln!(out, "\nFunctions");
    for (i, f) in d.functions() {
        let name = d.error(f.error);
        let x = d.coordinate(i);
        let _ = match d.function(i, &x) {
            Some(written) => writeln!(out, "{}", equation(&format!("  {name}({x}) = "), &written, 7)),
            None => writeln!(out, "  {name}({x}) known, from another measurement"),
        };
    }
    let _ = writeln!(out, "\nBase parameters: rank {}", derivation.rank());
    let written = || derivation.base.iter().filter(|b| !d.is_itself(b));
    let width = written().map(|b| b.name.len()).max().unwrap_or(0);
    for b in written() {
        let start = format!("  {:width$} = ", b.name);
        let _ = writeln!(out, "{}", equation(&start, &d.definition(&b.definition), start.len()));
    }
    let _ = writeln!(out, "\nWhat is estimated");
    for determination in &derivation.functions {
        let name = d.error(model.functions[determination.function].error);
        let told = extent(model, derivation, determination, Style::Pretty);
        let _ = writeln!(out, "{}", prose(&format!("  {name}: "), &told, 4));
    }
    let _ = writeln!(out, "\nWhat these runs cannot tell apart");
    for group in derivation.groups() {
        let _ = writeln!(out, "{}", prose("  ", &d.group(&group), 4));
    }
    let unseen: Vec<&str> = derivation.unseen.iter().map(|e| model.alphabet.error_name(*e)).collect();
    let _ = writeln!(out, "\n{}", prose("Not seen at first order: ", &unseen.join(", "), 2));
    out
}

/// What symbols stand for that are no lengths and no errors of the machine: sines and cosines first, then a line each.
pub fn symbols(model: &Model) -> Vec<String> {
    let printer = Printer { alphabet: &model.alphabet, style: Style::Pretty };
    let mut sweeps: Vec<_> = model.runs.iter().map(|r| r.sweep).collect();
    sweeps.sort();
    sweeps.dedup();
    let trig = |&id: &SweepId| {
        let [_, sin, cos] = model.alphabet.sweep_symbols(id).map(|id| model.alphabet.nominal_name(id));
        let sweep = model.alphabet.sweep_name(id);
        format!("{sin} = sin {sweep}, {cos} = cos {sweep}")
    };
    let mut symbols = vec![sweeps.iter().map(trig).collect::<Vec<_>>().join(", ")];
    for axis in model.axes() {
        symbols.extend(axis.references.iter().map(|r| {
            let name = axis.location[r.component.index()].map_or("", |e| model.alphabet.error_name(e));
            format!("{name}: the angle of {} to {}", axis.name, r.axis)
        }));
    }
    symbols.extend(model.alphabet.nominals().filter_map(|(id, nominal)| {
        let name = || model.alphabet.nominal_name(id);
        match nominal {
            Nominal::Wrapped { angle, .. } => Some(turned(model, &name(), angle)),
            Nominal::Root { root, .. } => {
                let of = Poly::from_terms(root.of.clone()).unwrap_or_default();
                Some(format!("{} = √({})", name(), printer.poly(&of)))
            }
            Nominal::Sense { .. } | Nominal::Arctangent { .. } => Some(format!("{}: {}", name(), moves(model, id))),
            _ => None,
        }
    }));
    symbols
}

/// What an angle less whole turns stands for.
fn turned(model: &Model, name: &str, angle: &WrappedAngle) -> String {
    let sweep = model.alphabet.sweep_name(angle.sweep);
    let printer = Printer { alphabet: &model.alphabet, style: Style::Pretty };
    let of_pi = |steps: i32| {
        let poly = Poly::nominal(Alphabet::PI).scaled(&Rational::new(steps.into(), 12));
        poly.map_or_else(|_| String::new(), |p| printer.poly(&p))
    };
    let times = match angle.multiple {
        1 => sweep.to_owned(),
        n => format!("{n}·{sweep}"),
    };
    let range = format!("[{}, {})", of_pi(angle.start), of_pi(angle.start + 24));
    if name == sweep {
        format!("{name} as a power: less whole turns, in {range}")
    } else {
        format!("{name}: {times} less whole turns, in {range}")
    }
}
