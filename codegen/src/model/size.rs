//! Descriptions of a size that no machine has.

use super::{Draft, Problem, ProblemKind};
use crate::limits::{AXES, LIST, RUNS};
use crate::source::{Span, Text};

/// What there is too much of, at the first that is too many.
pub(super) fn excess(draft: &Draft) -> Vec<Problem> {
    let mut size = Size::default();
    size.check("axes", AXES, draft.axes.iter().map(|axis| &axis.name));
    size.check("runs", RUNS, draft.runs.iter().map(|run| &run.name));
    size.check("own names", LIST, draft.names.iter().map(|(iso, _)| iso));
    size.check("functions", LIST, draft.functions.iter().map(|function| &function.error));
    size.check("assumptions", LIST, draft.assume.iter().map(|(parameter, _)| parameter));
    size.check("lengths", LIST, draft.lengths.iter().map(|length| &length.name));
    size.check("limits", LIST, draft.limits.iter().map(|limit| &limit.name));
    let lists = [&draft.constants, &draft.workpiece, &draft.tool, &draft.estimate, &draft.order];
    lists.into_iter().for_each(|list| size.check("entries", LIST, list));
    for axis in &draft.axes {
        size.check("location errors", LIST, &axis.location);
    }
    for run in &draft.runs {
        size.check("definitions", LIST, run.define.iter().map(|(name, _)| name));
        size.check("coordinates", LIST, run.at.iter().map(|(axis, _)| axis));
        size.check("terms besides the geometry", LIST, &run.nuisance);
    }
    for function in &draft.functions {
        size.check("conditions", LIST, function.basis.conditions());
    }
    size.0
}

#[derive(Default)]
struct Size(Vec<Problem>);

impl Size {
    fn check<'a>(&mut self, what: &'static str, most: usize, items: impl IntoIterator<Item = &'a Text>) {
        let first: Option<Span> = items.into_iter().nth(most).map(|text| text.span.clone());
        self.0.extend(first.map(|span| Problem { span, kind: ProblemKind::TooMany(what, most) }));
    }
}
