//! What is stated beside a model file, in a file of its own: put over what the model file states itself.

use super::draft::{Draft, Number};
use super::file::{Reader, text_of};
use super::problem::ProblemKind;
use crate::source::Text;
use toml::de::DeTable;

/// The keys whose contents are put over those of the model.
pub const STATED: &[&str] = &["lengths", "limits", "instrument", "assume", "axis"];

impl Reader {
    /// Puts what a table states over a draft: single lengths, limits, assumptions and ranges, the instrument as a whole. Other keys
    /// are whose the file is.
    pub(super) fn state(&mut self, draft: &mut Draft, table: &DeTable) {
        over(&mut draft.lengths, self.numbers(table, "lengths"), name);
        over(&mut draft.limits, self.numbers(table, "limits"), name);
        over(&mut draft.assume, self.texts(table, "assume"), parameter);
        if let Some(instrument) = self.table_at(table, "instrument") {
            draft.instrument = Some(self.instrument(instrument));
        }
        for (axis, value) in self.tables(table, "axis") {
            let Some(stated) = self.table(value) else { continue };
            self.known_keys(stated, &["range"]);
            let range = stated.get("range").and_then(|value| self.range(value));
            match draft.axes.iter_mut().find(|own| own.name.value == axis.get_ref().as_ref()) {
                Some(own) => own.range = range.or(own.range),
                None => self.problem(axis.span(), ProblemKind::UnknownAxis(text_of(axis).value)),
            }
        }
    }
}

/// Puts each of `stated` where the one of its name is, or behind all.
fn over<T>(own: &mut Vec<T>, stated: Vec<T>, name: impl Fn(&T) -> &str) {
    for one in stated {
        match own.iter_mut().find(|own| name(own) == name(&one)) {
            Some(own) => *own = one,
            None => own.push(one),
        }
    }
}

fn name(number: &Number) -> &str {
    &number.name.value
}

fn parameter((parameter, _): &(Text, Text)) -> &str {
    &parameter.value
}
