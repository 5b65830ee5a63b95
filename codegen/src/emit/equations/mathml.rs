//! The document for a page that a browser typesets: MathML Core, nothing of which is fetched from anywhere.

use super::document::Document;
use super::printer::{Style, indexed};
use crate::identify::{BaseParameter, Derivation, DerivedRun};
use crate::ids::{FunctionId, RunId};
use crate::model::{ErrorFunction, Model};

/// Equations under one heading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// The heading, a text.
    pub title: String,
    /// What stands below it.
    pub equations: Vec<Equation>,
}

/// An equation in pieces between which a line may end; each is the inside of a `<math>`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Up to the sign of equality, with it.
    pub left: String,
    /// The terms of the right side, each with its sign.
    pub terms: Vec<String>,
}

/// Readings, model equations, functions and base parameters.
pub fn mathml(model: &Model, derivation: &Derivation) -> Vec<Section> {
    let d = Document::new(model, derivation, Style::MathMl);
    let run = |(i, run): (RunId, &DerivedRun)| {
        let left = indexed(&d.label(i), &run.name);
        [d.reading(run), d.equation(run)].map(|right| equation(&left, &right))
    };
    let (readings, equations): (Vec<_>, Vec<_>) =
        derivation.runs.iter_enumerated().map(run).map(|[reading, equation]| (reading, equation)).unzip();
    let function = |(i, f): (FunctionId, &ErrorFunction)| {
        let x = d.printer.name(&d.coordinate(i));
        let left = format!("{}{}", d.error(f.error), d.printer.parenthesised(&x));
        Some(equation(&left, &d.function(i, &x)?))
    };
    let base = |b: &BaseParameter| equation(&d.printer.name(&b.name), &d.definition(&b.definition));
    let section = |title: &str, equations| Section { title: title.to_owned(), equations };
    vec![
        section("Readings, linear in the errors", readings),
        section("The same with the functions put in", equations),
        section("Functions", d.functions().filter_map(function).collect()),
        section(
            "Coefficients in physical errors",
            derivation.base.iter().filter(|b| !d.is_itself(b)).map(base).collect(),
        ),
    ]
}

fn equation(left: &str, right: &str) -> Equation {
    let between = |sign: &str| format!("<mo form=\"infix\">{sign}</mo>");
    let mut terms = terms(right);
    for term in terms.iter_mut().skip(1) {
        // A sign at the beginning of an element would be the sign of what follows it.
        for sign in ["+", "−"] {
            if let Some(rest) = term.strip_prefix(&format!("<mo>{sign}</mo>")) {
                *term = between(sign) + rest;
                break;
            }
        }
    }
    Equation { left: left.to_owned() + &between("="), terms }
}

/// Cuts a sum before the signs that stand in no element.
fn terms(sum: &str) -> Vec<String> {
    let (mut depth, mut start, mut terms) = (0_i32, 0, Vec::new());
    for (at, c) in sum.char_indices() {
        match c {
            '<' if sum[at..].starts_with("</") => depth -= 1,
            '<' => depth += 1,
            ' ' if depth == 0 && sum[at..].starts_with(" <mo>") => {
                terms.push(sum[start..at].to_owned());
                start = at + 1;
            }
            _ => {}
        }
    }
    terms.push(sum[start..].to_owned());
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_between_terms_alone() {
        let bracket = "<mrow><mo>(</mo><mi>b</mi> <mo>−</mo> <mi>c</mi><mo>)</mo></mrow>";
        let sum = format!("<mo>−</mo><mi>a</mi> <mo>+</mo> {bracket} <mo>−</mo> <mn>1</mn>");
        let second = format!("<mo>+</mo> {bracket}");
        assert_eq!(terms(&sum), ["<mo>−</mo><mi>a</mi>", &second, "<mo>−</mo> <mn>1</mn>"]);
    }
}
