//! Which names may be given.

use super::resolver::Resolver;
use crate::limits::NAME;
use crate::model::ProblemKind;
use crate::source::Text;

/// Words of expressions, coordinates, conditions and assumptions.
pub(super) const WORDS: &[&str] = &["pi", "sin", "cos", "sqrt", "rest", "f", "at"];

impl Resolver {
    pub fn is_name(&mut self, text: &Text) -> bool {
        let mut chars = text.value.chars();
        let first = chars.next().is_some_and(|c| c.is_ascii_alphabetic());
        let good =
            first && text.value.len() <= NAME && chars.all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
        if !good {
            self.problem::<()>(&text.span, ProblemKind::NotAName(text.value.clone()));
        }
        good
    }

    /// Whether files may be called so on every system.
    pub fn is_file_name(&mut self, text: &Text) -> bool {
        let device = is_device(&text.value);
        if device {
            self.problem::<()>(&text.span, ProblemKind::Device(text.value.clone()));
        }
        self.is_name(text) && !device
    }

    /// Whether a name may stand in formulas: no other has it, and it is not read as a difference.
    pub fn is_free(&mut self, text: &Text) -> bool {
        let name = text.value.as_str();
        if name.contains('-') {
            self.problem::<()>(&text.span, ProblemKind::NotAName(text.value.clone()));
            return false;
        }
        let free = !self.alphabet.has_name(name) && !WORDS.contains(&name);
        if !free {
            self.problem::<()>(&text.span, ProblemKind::Taken(text.value.clone()));
        }
        free
    }
}

/// Names that Windows keeps for devices, whatever stands behind a point.
fn is_device(name: &str) -> bool {
    let name = name.to_lowercase();
    let numbered = name.strip_prefix("com").or_else(|| name.strip_prefix("lpt"));
    ["con", "prn", "aux", "nul"].contains(&name.as_str())
        || numbered.is_some_and(|number| number.len() == 1 && number.chars().all(|c| c.is_ascii_digit()))
}

/// What a name is among those of files, whatever its case.
pub(super) fn item(name: &str) -> String {
    name.to_lowercase().replace('-', "_")
}
