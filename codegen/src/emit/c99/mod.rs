//! A model with its own small streaming solver in C99: what a control without Rust takes.
//!
//! The solver is the Rust one in C (`trunnion_solver::lstsq`), for the model's number of unknowns; the tests hold them to
//! each other.

mod file;
mod functions;

pub(super) use file::Kind;
use file::{File, HEADER, PLAIN, SOURCE};
pub(super) use functions::{Push, Value};

use super::c::{self, Precision};
use super::header;
use super::layout::listed;
use super::model;
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
    Ok(printed(model, derivation, real, &PLAIN)?.sources)
}

/// The two files of a model, and what its own functions are called there.
pub(super) struct Printed {
    pub sources: Sources,
    pub pushes: Vec<Push>,
    pub values: Vec<Value>,
}

pub(super) fn printed(
    model: &Model,
    derivation: &Derivation,
    real: Precision,
    kind: &Kind,
) -> Result<Printed, Unbound> {
    let mut file = File::new(&model.name, real, kind);
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
            .replace("@LEAST@", real.pick("0x1p-800", "0x1p-100f"))
            .replace("@MOST@", real.pick("0x1p800", "0x1p90f"))
            .replace("@sqrt@", real.pick("sqrt", "sqrtf"))
            .replace("@declarations@", &printed.declarations)
            .replace("@names@", &names_line)
            .replace("@model@", &c::commented(&model.name))
    };
    let head = header("//", &model.name);
    let sources = Sources {
        header: head.clone() + &fill(HEADER),
        source: head
            + &include_line(prefix)
            + &fill(SOURCE)
            + &c::support_in(&printed.definitions, &file.dialect)
            + &printed.definitions,
        prefix: file.prefix,
    };
    Ok(Printed { sources, pushes: printed.pushes, values: printed.values })
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
