//! A model with its own small streaming solver in C99: what a control without Rust takes.
//!
//! The solver is the Rust one in C (`trunnion_solver::lstsq`), for the model's number of unknowns; the tests hold them to
//! each other.

mod functions;

use super::c::{self, C99, Precision};
use super::header;
use super::layout::listed;
use super::model;
use super::names::Scope;
use crate::graph::Unbound;
use crate::identify::Derivation;
use crate::model::Model;

/// The two files of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// Stem of both file names and prefix of every name in them, as `tilting_table_a`.
    pub prefix: String,
    /// `{prefix}.h`
    pub header: String,
    /// `{prefix}.c`, which includes the header.
    pub source: String,
}

impl Sources {
    /// Both in one file, for a program that wants no more than one.
    #[must_use]
    pub fn single(&self) -> String {
        format!("{}\n{}", self.header, self.source.replace(&include_line(&self.prefix), ""))
    }
}

/// Prints the runs' regressors, the estimated functions and a solver for them all, in `double` or `float`.
///
/// # Errors
/// An expression depends on a symbol that is neither a constant nor the run's sweep.
pub fn sources(model: &Model, derivation: &Derivation, real: Precision) -> Result<Sources, Unbound> {
    let mut file = File::new(&model.name, real);
    let printed = functions::functions(model, derivation, &mut file)?;
    let (prefix, upper) = (file.prefix.as_str(), file.upper());
    let names: Vec<String> = derivation.base.iter().map(|base| literal(&base.name)).collect();
    let names_line = listed(&format!("const char *const {prefix}_names[{upper}_UNKNOWNS] = {{"), &names, "};", 4);
    let fill = |template: &str| {
        // What comes from the model goes in last: it may look like a place.
        template
            .replace("@prefix@", prefix)
            .replace("@PREFIX@", &upper)
            .replace("@real@", real.name())
            .replace("@N@", &names.len().to_string())
            .replace("@EPSILON@", real.pick("DBL_EPSILON", "FLT_EPSILON"))
            .replace("@MIN@", real.pick("DBL_MIN", "FLT_MIN"))
            .replace("@sqrt@", real.pick("sqrt", "sqrtf"))
            .replace("@declarations@", &printed.declarations)
            .replace("@names@", &names_line)
            .replace("@model@", &c::commented(&model.name))
    };
    let head = header("//", &model.name);
    Ok(Sources {
        header: head.clone() + &fill(HEADER),
        source: head
            + &include_line(prefix)
            + &fill(SOURCE)
            + &c::support_in(&printed.definitions, &file.dialect)
            + &printed.definitions,
        prefix: file.prefix,
    })
}

const HEADER: &str = include_str!("solver.h.in");
const SOURCE: &str = include_str!("solver.c.in");

/// Stems of the standard headers: a file beside them may not be called so.
const HEADERS: &[&str] = &[
    "assert",
    "complex",
    "ctype",
    "errno",
    "fenv",
    "float",
    "inttypes",
    "iso646",
    "limits",
    "locale",
    "math",
    "setjmp",
    "signal",
    "stdalign",
    "stdarg",
    "stdatomic",
    "stdbit",
    "stdbool",
    "stdckdint",
    "stddef",
    "stdint",
    "stdio",
    "stdlib",
    "stdnoreturn",
    "string",
    "tgmath",
    "threads",
    "time",
    "uchar",
    "wchar",
    "wctype",
];

/// The names of one file: all begin with its prefix, so that several files can be in one program.
struct File {
    prefix: String,
    scope: Scope,
    dialect: C99,
}

impl File {
    fn new(model: &str, real: Precision) -> Self {
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
    fn claim(&mut self, what: &str, of: &str) -> String {
        self.scope.claim(&format!("{}_{what}_{of}", self.prefix))
    }

    fn upper(&self) -> String {
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

fn include_line(prefix: &str) -> String {
    format!("#include \"{prefix}.h\"\n\n")
}

/// A C string literal.
fn literal(text: &str) -> String {
    let escaped = text.chars().filter(|c| !c.is_control()).flat_map(|c| match c {
        '"' | '\\' => vec!['\\', c],
        // No trigraphs.
        '?' => vec!['\\', '?'],
        _ => vec![c],
    });
    format!("\"{}\"", escaped.collect::<String>())
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
