//! A description's texts, by the names that people know them by.

use super::{Colour, derivation, render};
use crate::identify::Derivation;
use crate::model::{Draft, Model, Problem, read_draft_stated, read_stated};

/// A text and its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// A file's path, a name of the catalogue.
    pub name: String,
    /// The text.
    pub text: String,
}

/// A model file, and what a file beside it states [over it](crate::model::STATED).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Described {
    /// The model file.
    pub model: Named,
    /// What is stated over it.
    pub stated: Option<Named>,
}

impl Described {
    fn stated(&self) -> Option<&str> {
        self.stated.as_ref().map(|stated| stated.text.as_str())
    }

    /// Reads without resolving.
    ///
    /// # Errors
    /// Problems of the form.
    pub fn draft(&self) -> Result<Draft, Vec<Problem>> {
        read_draft_stated(&self.model.text, self.stated())
    }

    /// Reads and derives.
    ///
    /// # Errors
    /// All problems of the texts; or, where they read, what keeps the runs from being derived.
    pub fn derive(&self) -> Result<(Model, Derivation), Vec<Problem>> {
        let model = read_stated(&self.model.text, self.stated())?;
        let derivation = derivation(&model)?;
        Ok((model, derivation))
    }

    /// Where a problem is: the name of its text, and the line and the column in it, counted from 1.
    pub fn place(&self, problem: &Problem) -> (&str, usize, usize) {
        let start = problem.span.start;
        let (Named { name, text }, at) = match (&self.stated, start.checked_sub(self.model.text.len() + 1)) {
            (Some(stated), Some(at)) => (stated, at),
            _ => (&self.model, start),
        };
        let before = text.get(..at).unwrap_or(text);
        let line = before.rsplit('\n').next().unwrap_or_default();
        (name, before.matches('\n').count() + 1, line.chars().count() + 1)
    }

    /// The problems, those of each text under its name.
    pub fn render(&self, problems: &[Problem], colour: Colour) -> String {
        let Named { name, text } = &self.model;
        let Some(stated) = &self.stated else { return render(name, text, problems, colour) };
        let behind = text.len() + 1;
        let (mut of_model, mut of_stated) = (Vec::new(), Vec::new());
        for Problem { span, kind } in problems.iter().cloned() {
            match span.start.checked_sub(behind) {
                None => of_model.push(Problem { span, kind }),
                Some(start) => of_stated.push(Problem { span: start..span.end - behind, kind }),
            }
        }
        let of = |Named { name, text }: &Named, problems: Vec<Problem>| match problems.as_slice() {
            [] => None,
            problems => Some(render(name, text, problems, colour)),
        };
        [of(&self.model, of_model), of(stated, of_stated)].into_iter().flatten().collect::<Vec<_>>().join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    fn described(stated: &str) -> Described {
        let text = catalogue::source("tilting-table-a").unwrap_or_default().to_owned();
        let named = |name: &str, text: String| Named { name: name.to_owned(), text };
        Described { model: named("model", text), stated: Some(named("project", stated.to_owned())) }
    }

    #[test]
    fn what_is_stated_is_put_over_the_model_s() {
        let stated = "[lengths]\nR_mm = 100\n[instrument]\npreset = \"QC20-W\"\n[axis.A]\nrange = [-30, 120]\n[assume]\ns_xy = \"0\"\n";
        let draft = described(stated).draft().unwrap();
        assert_eq!(
            draft.lengths.iter().map(|l| (l.name.value.as_str(), l.value)).collect::<Vec<_>>(),
            [("R_mm", 100.0)]
        );
        assert_eq!(draft.axes.iter().find(|a| a.name.value == "A").and_then(|a| a.range), Some([-30.0, 120.0]));
        let (model, _) = described(stated).derive().unwrap();
        assert_eq!(model.assumptions.iter().map(|a| a.text.as_str()).collect::<Vec<_>>(), ["s_xy = 0"]);
        assert!(model.instrument.is_some_and(|i| i.preset.as_deref() == Some("QC20-W")));
    }

    #[test]
    fn problems_are_told_where_they_are() {
        let described = described("[axis.Q]\nrange = [0, 1]\n\n[limits]\nnone_um = -1\n");
        let told = described.render(&described.derive().unwrap_err(), Colour::Off);
        assert!(told.contains("project:1:7") && told.contains("project:5:1"), "{told}");
        assert!(!told.contains("model:"), "{told}");
        let problems = described.derive().unwrap_err();
        let places: Vec<_> = problems.iter().map(|problem| described.place(problem)).collect();
        assert_eq!(places, [("project", 1, 7), ("project", 5, 1)]);
    }
}
