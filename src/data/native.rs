//! Imported runs as files of one's own: a table with comments that say what it was made from, and a picture.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::imported::ImportedFile;
use super::output::{Files, WriteProblem, sealed};
use super::sweep::Sweep;
use crate::import::{Trace, trace_picture};
use crate::plot::PlotError;
use trunnion_codegen::quantity::Unit;

/// Why imported runs cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NativeError {
    /// Two files would have one name.
    #[error("{}: another file of this name is imported\n  expected files of different names, or one import for each", .0.display())]
    OneName(PathBuf),
    /// A run cannot be written.
    #[error("{}: {problem}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why not.
        problem: WriteProblem,
    },
    /// A run cannot be drawn.
    #[error("{}: {problem}", file.display())]
    Picture {
        /// The file.
        file: PathBuf,
        /// Why not.
        problem: PlotError,
    },
}

/// The files of imported runs: for each a table, `NAME-ccw.csv` or `NAME-cw.csv` and numbered where there are several, and a
/// picture of the same name; in the order of the runs, the names of the tables beside.
///
/// # Errors
/// [`NativeError`]
pub fn native_files(
    imported: &[(&Path, &ImportedFile)],
    angle: &str,
) -> Result<(Files<'static>, Vec<Vec<String>>), NativeError> {
    let (mut files, mut names, mut all) = (Files::default(), Vec::new(), BTreeSet::new());
    for (path, file) in imported {
        let own = run_names(path, &file.imported.traces);
        for (trace, name) in file.imported.traces.iter().zip(&own) {
            if !all.insert(name.to_lowercase()) {
                return Err(NativeError::OneName((*path).to_owned()));
            }
            let path_of = |ending| PathBuf::from(format!("{name}.{ending}"));
            let contents = contents(path, file, trace, angle);
            let contents = contents.map_err(|problem| NativeError::Write { file: path_of("csv"), problem })?;
            files.add(format!("{name}.csv"), contents);
            let picture = trace_picture(name, trace);
            let picture = picture.map_err(|problem| NativeError::Picture { file: path_of("svg"), problem })?;
            files.add(format!("{name}.svg"), picture);
        }
        names.push(own.into_iter().map(|name| format!("{name}.csv")).collect());
    }
    Ok((files, names))
}

/// What the files of a file's runs are called, without their ending.
fn run_names(path: &Path, traces: &[Trace]) -> Vec<String> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let stem = if stem == "-" { "run".into() } else { stem };
    let way =
        |trace: &Trace| trace.direction.map_or_else(String::new, |way| format!("-{}", way.short()).to_lowercase());
    let name = |(at, trace): (usize, &Trace)| {
        let alike = |others: &[Trace]| others.iter().filter(|other| other.direction == trace.direction).count();
        let number = if alike(traces) > 1 { format!("-{}", 1 + alike(&traces[..at])) } else { String::new() };
        format!("{stem}{}{number}", way(trace))
    };
    traces.iter().enumerate().map(name).collect()
}

/// A run's table, below what it was made from.
fn contents(path: &Path, file: &ImportedFile, trace: &Trace, angle: &str) -> Result<Vec<u8>, WriteProblem> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    // Nothing that somebody else has written ends a comment.
    let name: String = name.chars().filter(|letter| !letter.is_control()).collect();
    let from = [("from", name), ("sha-256", file.sha256.clone())];
    let mut text = String::new();
    for (what, words) in from.into_iter().chain(file.imported.about.lines()).chain(trace.told()) {
        let _ = writeln!(text, "# {what}: {words}");
    }
    for feature in &trace.features {
        let _ = writeln!(text, "# found: {} {} {}", feature.name, feature.value, feature.unit);
    }
    let samples = trace.kept().iter().map(|sample| (sample.angle_rad, sample.reading_mm));
    // In the file's own unit each number keeps its digits.
    let table = Sweep::new(path, samples).contents(angle, Unit::Deg, trace.unit)?;
    Ok(sealed(&[text.into_bytes(), table].concat()))
}
