//! The names of one C file.

use crate::emit::c::{self, C99, Precision};
use crate::emit::names::Scope;

pub(super) const HEADER: &str = include_str!("solver.h.in");
pub(super) const SOURCE: &str = include_str!("solver.c.in");

/// Stems of the standard headers: a file beside them may not be called so.
#[rustfmt::skip]
const HEADERS: &[&str] = &[
    "assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits", "locale", "math",
    "setjmp", "signal", "stdalign", "stdarg", "stdatomic", "stdbit", "stdbool", "stdckdint", "stddef", "stdint",
    "stdio", "stdlib", "stdnoreturn", "string", "tgmath", "threads", "time", "uchar", "wchar", "wctype",
];

/// The names of one file: all begin with its prefix, so that several files can be in one program.
pub(super) struct File {
    pub prefix: String,
    pub scope: Scope,
    pub dialect: C99,
}

impl File {
    pub fn new(model: &str, real: Precision) -> Self {
        let plain = c::RULES.sanitised(&model.to_lowercase());
        let plain = plain.trim_end_matches('_');
        let mut prefix = plain.to_owned();
        let mut number = 2;
        let own =
            |prefix: &str| [HEADER, SOURCE].into_iter().flat_map(|text| own_names(text, prefix)).collect::<Vec<_>>();
        while HEADERS.contains(&prefix.as_str()) || own(&prefix).iter().any(|name| c::RULES.is_word(name)) {
            prefix = format!("{plain}_{number}");
            number += 1;
        }
        let mut scope = Scope::new(c::RULES, &own(&prefix));
        let whole_turns = scope.claim(&format!("{prefix}_whole_turns"));
        Self { prefix, scope, dialect: C99 { real, whole_turns } }
    }

    /// `tilting_table_a_row_of_tilting`
    pub fn claim(&mut self, what: &str, of: &str) -> String {
        self.scope.claim(&format!("{}_{what}_{of}", self.prefix))
    }

    pub fn upper(&self) -> String {
        self.prefix.to_uppercase()
    }
}

/// The names that a template gives.
fn own_names(template: &str, prefix: &str) -> Vec<String> {
    let end = |rest: &str| rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    let names = |place: &str, prefix: &str| -> Vec<String> {
        template.split(place).skip(1).map(|rest| format!("{prefix}{}", &rest[..end(rest)])).collect()
    };
    [names("@prefix@", prefix), names("@PREFIX@", &prefix.to_uppercase())].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_of_the_template_has_the_prefix() {
        for text in [HEADER, SOURCE] {
            for line in text.lines().filter(|line| {
                line.starts_with("#define") || line.starts_with("static") || line.contains("extern const")
            }) {
                assert!(line.contains("@prefix@_") || line.contains("@PREFIX@_"), "{line}");
            }
        }
    }

    #[test]
    fn a_prefix_leaves_the_headers_their_names() {
        let prefix = |model: &str| File::new(model, Precision::Double).prefix;
        assert_eq!(["Table-1", "math", "fe", "a__b-"].map(prefix), ["table_1", "math_2", "fe_2", "a_b"]);
    }
}
