//! Everything that can be wrong with a description, in one form: with its place, and as a message for people.
//!
//! A description is refused either by itself ([`Draft::build`](crate::model::Draft::build)) or by what follows from it,
//! when a run has no reading or sees an error of which nothing is assumed ([`derivation`]).

mod described;
mod render;

pub use crate::source::{shown, visible};
pub use described::{Described, Named};
pub use render::{Colour, render};

use crate::algebra::Alphabet;
use crate::emit::equations::{Printer, Style};
use crate::expression::Meaning;
use crate::identify::{Derivation, DeriveError, derive};
use crate::measurement::{Length, ReadingError};
use crate::model::{Assumption, Model, Problem, ProblemKind, ReadingKind, Run, read};

/// Reads and derives a model file.
///
/// # Errors
/// All problems of the file; or, where it reads, what keeps its runs from being derived.
pub fn read_and_derive(source: &str) -> Result<(Model, Derivation), Vec<Problem>> {
    let model = read(source)?;
    let derivation = derivation(&model)?;
    Ok((model, derivation))
}

/// Derives a model.
///
/// # Errors
/// What keeps its runs from being derived, with its place in the description.
pub fn derivation(model: &Model) -> Result<Derivation, Vec<Problem>> {
    derive(model).map_err(|e| of_derivation(model, &e))
}

/// A failed derivation as problems of the description.
pub fn of_derivation(model: &Model, error: &DeriveError) -> Vec<Problem> {
    let alphabet = &model.alphabet;
    match error {
        DeriveError::Reading(run, e) => {
            model.runs.get(*run).map(|run| of_reading(run, e, alphabet)).into_iter().collect()
        }
        DeriveError::NoBasis(seen) => {
            let mut errors = Vec::new();
            let mut problems = Vec::new();
            for (run, error, factor) in seen {
                let Some(run) = model.runs.get(*run).filter(|_| !errors.contains(error)) else { continue };
                errors.push(*error);
                let factor = Printer { alphabet, style: Style::Pretty }.poly(factor);
                let name = alphabet.error_name(*error).to_owned();
                let kind = ProblemKind::NothingAssumed(run.name.clone(), name, factor);
                problems.push(Problem { span: run.places[0].clone(), kind });
            }
            problems
        }
        DeriveError::AssumptionDivides(texts) => {
            let of = |a: &&Assumption| texts.contains(&a.text);
            let problem =
                |a: &Assumption| Problem { span: a.place.clone(), kind: ProblemKind::Meaning(Meaning::Divisor) };
            model.assumptions.iter().filter(of).map(problem).collect()
        }
        DeriveError::UnknownParameter(text) => {
            vec![Problem { span: text.span.clone(), kind: ProblemKind::UnknownParameter(text.value.clone()) }]
        }
        DeriveError::Algebra(e) => vec![Problem { span: 0..0, kind: ProblemKind::Derivation(*e) }],
    }
}

fn of_reading(run: &Run, error: &ReadingError, alphabet: &Alphabet) -> Problem {
    let length = |length: &Length| {
        let printer = Printer { alphabet, style: Style::Pretty };
        match length {
            Length::Exactly(p) => printer.poly(p),
            Length::RootOf(p) => format!("√({})", printer.poly(p)),
        }
    };
    let kind = match (error, &run.reading) {
        (ReadingError::NotTheBar(l), ReadingKind::BarLength(bar)) => {
            ProblemKind::NotTheBar(alphabet.nominal_name(*bar), length(l))
        }
        (ReadingError::NotTheBar(l) | ReadingError::NotTogether(l), _) => ProblemKind::NotTogether(length(l)),
        (ReadingError::Algebra(e), _) => ProblemKind::Derivation(*e),
    };
    Problem { span: run.places[1].clone(), kind }
}
