//! The whole description.

use super::names::item;
use super::resolver::Resolver;
use crate::identify::settle;
use crate::ids::RunId;
use crate::iso::Notation;
use crate::model::size::excess;
use crate::model::{Axis, Draft, Model, Problem, ProblemKind, Run, reference};
use typed_index_collections::TiVec;

impl Draft {
    /// Checks everything and resolves every symbol; all problems are reported together.
    pub fn build(&self) -> Result<Model, Vec<Problem>> {
        let excess = excess(self);
        if !excess.is_empty() {
            return Err(excess);
        }
        let mut resolver = Resolver::default();
        let model = resolver.model(self);
        if !resolver.problems.is_empty() {
            return Err(resolver.problems);
        }
        let mut model = model.ok_or_else(Vec::new)?;
        // A run without a reading is told of where it is derived.
        let _ = settle(&mut model);
        Ok(model)
    }
}

impl Resolver {
    fn model(&mut self, draft: &Draft) -> Option<Model> {
        if draft.name.value.is_empty() {
            self.problem::<()>(&draft.name.span, ProblemKind::Missing("name"));
        } else {
            self.is_file_name(&draft.name);
        }
        let notation = match draft.notation.as_ref().map(|t| (t, t.value.as_str())) {
            None | Some((_, "iso230")) => Notation::Iso230,
            Some((_, "paper")) => Notation::Paper,
            Some((t, other)) => {
                self.problem::<()>(&t.span, ProblemKind::OneOf(other.to_owned(), &["paper", "iso230"]));
                Notation::Iso230
            }
        };
        for text in &draft.constants {
            if self.is_name(text) && self.is_free(text) {
                let made = self.alphabet.constant(&text.value);
                self.exact(&text.span, made);
            }
        }
        let mut names = draft.names.clone();
        let workpiece = self.side(draft, &draft.workpiece, notation, &mut names);
        let tool = self.side(draft, &draft.tool, notation, &mut names);
        let mut unplaced = Vec::new();
        for axis in &draft.axes {
            if !draft.workpiece.iter().chain(&draft.tool).any(|t| t.value == axis.name.value) {
                self.problem::<()>(&axis.name.span, ProblemKind::Unplaced(axis.name.value.clone()));
                unplaced.extend(self.axis(axis, notation, &mut names));
            }
        }
        for (iso, _) in names {
            self.problem::<()>(&iso.span, ProblemKind::UnknownError(iso.value));
        }
        let axes: Vec<&Axis> = workpiece.iter().chain(&tool).collect();
        let known: Vec<&Axis> = axes.iter().copied().chain(&unplaced).collect();
        let runs: TiVec<RunId, Run> =
            draft.runs.iter().filter_map(|run| self.run(run, &axes, draft)).flatten().collect();
        if draft.runs.is_empty() {
            self.problem::<()>(&draft.name.span, ProblemKind::NoRuns);
        }
        for (i, run) in runs.iter().enumerate() {
            // Files are named after runs, and some systems tell no case.
            if runs.iter().take(i).any(|r| item(&r.name) == item(&run.name)) {
                self.problem::<()>(&run.places[0], ProblemKind::Taken(run.name.clone()));
            }
        }
        let functions = self.functions(draft, &known);
        for function in functions.iter().filter(|f| !f.is_location()) {
            // A coefficient is called after its error; nothing else may be.
            for (term, described) in function.basis.functions().iter_enumerated() {
                let name = format!("{}{}", self.alphabet.error_name(function.error), described.suffix(term));
                if self.alphabet.has_name(&name) {
                    self.problem::<()>(&function.place, ProblemKind::Taken(name));
                } else {
                    self.alphabet.reserve(name);
                }
            }
        }
        self.turns(&axes, &runs, &functions);
        let assumptions = self.assumptions(draft, &known, &functions);
        let lengths = self.lengths(draft);
        let limits = self.limits(draft);
        let instrument = self.instrument(draft);
        let [workpiece, tool] = [workpiece, tool].map(|side| side.into_iter().map(|axis| self.named(axis)).collect());
        let model = Model {
            name: draft.name.value.clone(),
            title: draft.title.value.clone(),
            notation,
            alphabet: self.alphabet.clone(),
            lengths,
            workpiece,
            tool,
            runs,
            functions,
            order: draft.order.clone(),
            assumptions,
            limits,
            instrument,
        };
        self.problems.extend(reference::problems(&model));
        Some(model)
    }
}
