//! The names of one C file.

use crate::emit::c::{self, C99, Precision};
use crate::emit::names::{HEADERS, Rules, Scope, Words, abbreviated};

pub(super) const HEADER: &str = include_str!("solver.h.in");
pub(super) const SOURCE: &str = include_str!("solver.c.in");

/// What a file is for: what its names keep clear of.
pub(in crate::emit) struct Kind {
    pub rules: Rules,
    /// What it may not be called.
    pub stems: &'static Words,
    /// The longest that its prefix may be.
    pub longest: usize,
    /// A template whose names it has beside those of the solver.
    pub template: &'static str,
}

/// A header and a source of their own.
pub(super) const PLAIN: Kind = Kind { rules: c::RULES, stems: &HEADERS, longest: usize::MAX, template: "" };

/// The names of one file: all begin with its prefix, so that several files can be in one program.
pub(in crate::emit) struct File {
    pub prefix: String,
    pub scope: Scope,
    pub dialect: C99,
}

impl File {
    pub fn new(model: &str, real: Precision, kind: &Kind) -> Self {
        let plain = kind.rules.sanitised(&model.to_lowercase());
        let plain = abbreviated(plain.trim_end_matches('_'), kind.longest);
        let templates = [HEADER, SOURCE, kind.template];
        let own = |prefix: &str| templates.iter().flat_map(|text| own_names(text, prefix)).collect::<Vec<_>>();
        let taken =
            |prefix: &str| kind.stems.contains(prefix) || own(prefix).iter().any(|name| kind.rules.is_word(name));
        let mut prefix = plain.clone();
        let mut number = 2;
        while taken(&prefix) {
            let end = format!("_{number}");
            prefix = abbreviated(&plain, kind.longest - end.len()) + &end;
            number += 1;
        }
        let mut scope = Scope::new(kind.rules, &own(&prefix));
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
        let prefix = |model: &str| File::new(model, Precision::Double, &PLAIN).prefix;
        assert_eq!(["Table-1", "math", "fe", "a__b-"].map(prefix), ["table_1", "math_2", "fe_2", "a_b"]);
    }
}
