//! Machine files.

use serde::Deserialize;
use std::{fs, io, path::Path};
use trunnion_solver::exechon::{Dimension, Dimensions, Home, Limit, Limits, Machine, MachineError, Range};

/// The built-in machine file, `src/exechon/xt700.toml`.
pub const BUILT_IN: &str = include_str!("xt700.toml");

/// Why a file is no machine; shown without the file's name.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MachineFileError {
    /// The file cannot be read.
    #[error("{0}\n  expected a machine file such as src/exechon/xt700.toml")]
    Unreadable(io::ErrorKind),
    /// Not TOML, or not these keys.
    #[error("{}: {message}\n  expected the keys of src/exechon/xt700.toml", .line.map_or(String::new(), |line| format!("line {line}")))]
    Format {
        /// Where, if it is in one place.
        line: Option<usize>,
        /// What the reader says.
        message: String,
    },
    /// Dimensions that make no machine.
    #[error("line {line}: {problem}\n  expected dimensions in mm and angles in degrees, as in src/exechon/xt700.toml")]
    Machine {
        /// The line of the key.
        line: usize,
        /// What is wrong.
        problem: MachineError,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "name")]
    _name: String,
    dimensions: FileDimensions,
    home: FileHome,
    limits: FileLimits,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileDimensions {
    xu_mm: f64,
    ys2_mm: f64,
    xr_mm: f64,
    yr5_mm: f64,
    ycp_mm: f64,
    zc_mm: f64,
    yt_mm: f64,
    tz_mm: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileHome {
    strut_mm: f64,
    a_deg: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileLimits {
    strut_mm: [f64; 2],
    a_deg: [f64; 2],
    c_deg: [f64; 2],
}

/// Reads a machine file; without one, the built-in.
///
/// # Errors
/// [`MachineFileError`].
pub fn read_machine(file: Option<&Path>) -> Result<Machine<f64>, MachineFileError> {
    match file {
        None => parse(BUILT_IN),
        Some(file) => parse(&fs::read_to_string(file).map_err(|e| MachineFileError::Unreadable(e.kind()))?),
    }
}

fn parse(text: &str) -> Result<Machine<f64>, MachineFileError> {
    let File { dimensions: d, home, limits, .. } = toml::from_str(text).map_err(|e| {
        let line = e.span().map(|span| 1 + text.as_bytes().iter().take(span.start).filter(|b| **b == b'\n').count());
        MachineFileError::Format { line, message: e.message().to_owned() }
    })?;
    let range = |[low, high]: [f64; 2]| Range { low, high };
    let angles = |range: [f64; 2]| Range { low: range[0].to_radians(), high: range[1].to_radians() };
    let dimensions = Dimensions {
        xu: d.xu_mm,
        ys2: d.ys2_mm,
        xr: d.xr_mm,
        yr5: d.yr5_mm,
        ycp: d.ycp_mm,
        zc: d.zc_mm,
        yt: d.yt_mm,
        tz: d.tz_mm,
    };
    let home = Home { strut: home.strut_mm, a: home.a_deg.to_radians() };
    let limits = Limits { struts: range(limits.strut_mm), a: angles(limits.a_deg), c: angles(limits.c_deg) };
    Machine::new(dimensions, home, limits)
        .map_err(|problem| MachineFileError::Machine { line: line_of(text, &problem), problem })
}

/// The line of the key that a problem is about.
fn line_of(text: &str, problem: &MachineError) -> usize {
    let (section, key) = match problem {
        MachineError::NotFinite(d) | MachineError::NotPositive(d) | MachineError::TooLarge(d) => match d {
            Dimension::HomeStrut | Dimension::HomeA => ("[home]", d.name()),
            _ => ("[dimensions]", d.name()),
        },
        MachineError::HomeUnreachable => ("[home]", Dimension::HomeStrut.name()),
        MachineError::HomeSingular => ("[home]", Dimension::HomeA.name()),
        MachineError::EmptyRange(Limit::A) => ("[limits]", "a_deg"),
        MachineError::EmptyRange(Limit::C) => ("[limits]", "c_deg"),
        _ => ("[limits]", "strut_mm"),
    };
    let from = text.lines().position(|line| line.trim() == section).unwrap_or(0);
    let key = text.lines().skip(from).position(|line| line.trim_start().starts_with(key)).unwrap_or(0);
    from + key + 1
}
