//! Machine files.

use crate::data::{TextError, read_text};
use serde::Deserialize;
use std::io;
use std::path::Path;
use toml::Spanned;
use trunnion_solver::exechon::{Dimension, Dimensions, Home, Limit, Limits, Machine, MachineError, Range};

/// The built-in machine file, `src/exechon/xt700.toml`.
pub const BUILT_IN: &str = include_str!("xt700.toml");

/// Why a file is no machine; shown without the file's name.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MachineFileError {
    /// The file cannot be read.
    #[error("{kind}\n  expected a machine file such as src/exechon/xt700.toml")]
    Unreadable {
        /// What the operating system says.
        kind: io::ErrorKind,
    },
    /// Not UTF-8 text.
    #[error(transparent)]
    Text(TextError),
    /// A number that no machine has.
    #[error("line {line}: {key} = {value:?} is out of range\n  expected {what} from -{most} to {most}")]
    Number {
        /// Its line.
        line: usize,
        /// Its key.
        key: &'static str,
        /// The number.
        value: f64,
        /// A length in mm or an angle in degrees.
        what: &'static str,
        /// The largest, without its sign.
        most: f64,
    },
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

impl MachineFileError {
    /// The line that is wrong, where it is one.
    pub fn line(&self) -> Option<u64> {
        match self {
            Self::Number { line, .. } | Self::Machine { line, .. } => Some(*line as u64),
            Self::Format { line, .. } => line.map(|line| line as u64),
            Self::Unreadable { .. } | Self::Text(_) => None,
        }
    }
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
    xu_mm: Spanned<f64>,
    ys2_mm: Spanned<f64>,
    xr_mm: Spanned<f64>,
    yr5_mm: Spanned<f64>,
    ycp_mm: Spanned<f64>,
    zc_mm: Spanned<f64>,
    yt_mm: Spanned<f64>,
    tz_mm: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileHome {
    strut_mm: Spanned<f64>,
    a_deg: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileLimits {
    strut_mm: [Spanned<f64>; 2],
    a_deg: [Spanned<f64>; 2],
    c_deg: [Spanned<f64>; 2],
}

/// The longest length of a machine, mm.
const LONGEST: f64 = 1e5;
/// The largest angle of an axis, degrees.
const TURNED: f64 = 3600.0;

/// Reads a machine file; without one, the built-in.
///
/// # Errors
/// [`MachineFileError`].
pub fn read_machine(file: Option<&Path>) -> Result<Machine<f64>, MachineFileError> {
    let Some(file) = file else { return parse(BUILT_IN) };
    parse(&read_text(file).map_err(|e| match e {
        TextError::Unreadable(kind) => MachineFileError::Unreadable { kind },
        other => MachineFileError::Text(other),
    })?)
}

fn parse(text: &str) -> Result<Machine<f64>, MachineFileError> {
    let line_at = |at: usize| 1 + text.as_bytes().iter().take(at).filter(|b| **b == b'\n').count();
    let File { dimensions: d, home, limits, .. } = toml::from_str(text).map_err(|e| MachineFileError::Format {
        line: e.span().map(|span| line_at(span.start)),
        message: e.message().to_owned(),
    })?;
    let within = |key, number: &Spanned<f64>, what, most: f64| match *number.get_ref() {
        value if value.abs() <= most => Ok(value),
        value => Err(MachineFileError::Number { line: line_at(number.span().start), key, value, what, most }),
    };
    let mm = |key, number: &Spanned<f64>| within(key, number, "a length in mm", LONGEST);
    let rad = |key, number: &Spanned<f64>| within(key, number, "an angle in degrees", TURNED).map(f64::to_radians);
    let lengths = |key, [low, high]: &[Spanned<f64>; 2]| Ok(Range { low: mm(key, low)?, high: mm(key, high)? });
    let angles = |key, [low, high]: &[Spanned<f64>; 2]| Ok(Range { low: rad(key, low)?, high: rad(key, high)? });
    let dimensions = Dimensions {
        xu: mm("xu_mm", &d.xu_mm)?,
        ys2: mm("ys2_mm", &d.ys2_mm)?,
        xr: mm("xr_mm", &d.xr_mm)?,
        yr5: mm("yr5_mm", &d.yr5_mm)?,
        ycp: mm("ycp_mm", &d.ycp_mm)?,
        zc: mm("zc_mm", &d.zc_mm)?,
        yt: mm("yt_mm", &d.yt_mm)?,
        tz: mm("tz_mm", &d.tz_mm)?,
    };
    let home = Home { strut: mm("strut_mm", &home.strut_mm)?, a: rad("a_deg", &home.a_deg)? };
    let limits = Limits {
        struts: lengths("strut_mm", &limits.strut_mm)?,
        a: angles("a_deg", &limits.a_deg)?,
        c: angles("c_deg", &limits.c_deg)?,
    };
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
