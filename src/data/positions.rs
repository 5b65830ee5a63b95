//! Positions of runs that stop, as `trunnion plan` proposes them and `trunnion new` takes them.
//!
//! ```toml
//! [positions_deg]
//! a = [-90, -85, 30]
//! ```

use super::limits::POSITIONS;
use crate::study::{Measurement, OutOfRange, Setup, decimal};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use thiserror::Error;
use toml::Spanned;
use trunnion_codegen::model::key;

/// Angles beyond this are none of a run, degrees.
const MOST_DEG: f64 = 3600.0;

/// What is wrong with a file of positions, without its name.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PositionsProblem {
    /// Not TOML, or not these keys.
    #[error(
        "line {line}: {message}\n  expected [positions_deg] with a list for each run, as `trunnion plan --positions` writes it"
    )]
    Format {
        /// Counted from 1.
        line: usize,
        /// What the reader says.
        message: String,
    },
    /// A run that the model does not have.
    #[error("line {line}: no run `{run}` of the model\n  expected {runs}")]
    NoRun {
        /// Counted from 1.
        line: usize,
        /// The name.
        run: String,
        /// Those there are.
        runs: String,
    },
    /// A run without positions.
    #[error("no positions of run {0}\n  expected some of each run")]
    Missing(String),
    /// So few, or so many, that they are no run.
    #[error("line {line}: {count} positions\n  expected {least} to {POSITIONS}")]
    Count {
        /// Counted from 1.
        line: usize,
        /// How many a fit asks for.
        least: usize,
        /// How many.
        count: usize,
    },
    /// No angle that a run goes to.
    #[error("line {line}: {given} is no position\n  expected an angle within ten turns, degrees, once")]
    Angle {
        /// Counted from 1.
        line: usize,
        /// As it stands.
        given: f64,
    },
    /// An angle that takes an axis out of its range.
    #[error("line {line}: {what}")]
    OutOfRange {
        /// Counted from 1.
        line: usize,
        /// Which axis, and where.
        what: OutOfRange,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    positions_deg: BTreeMap<String, Spanned<Vec<Spanned<f64>>>>,
}

/// Reads positions: of each run the sweeps, rad, in the file's order.
///
/// # Errors
/// [`PositionsProblem`]
pub fn read_positions(
    text: &str,
    setup: &Setup,
    measurements: &[Measurement],
) -> Result<Vec<Vec<f64>>, PositionsProblem> {
    let line = |at: usize| 1 + text.get(..at).unwrap_or(text).matches('\n').count();
    let mut file: File = toml::from_str(text).map_err(|e| {
        let line = line(e.span().map_or(0, |span| span.start));
        PositionsProblem::Format { line, message: e.message().lines().collect::<Vec<_>>().join(", ") }
    })?;
    let mut positions = Vec::new();
    for measurement in measurements {
        let missing = || PositionsProblem::Missing(measurement.name.clone());
        let own = file.positions_deg.remove(&measurement.name).ok_or_else(missing)?;
        let (at, own) = (line(own.span().start), own.into_inner());
        let least = setup.least(&measurement.runs);
        if !(least..=POSITIONS).contains(&own.len()) {
            return Err(PositionsProblem::Count { line: at, least, count: own.len() });
        }
        let mut sweeps: Vec<f64> = Vec::new();
        for given in own {
            let (at, given) = (line(given.span().start), given.into_inner());
            let sweep = given.to_radians();
            // NaN is within nothing.
            let is_new = given.abs() <= MOST_DEG && !sweeps.contains(&sweep);
            if !is_new {
                return Err(PositionsProblem::Angle { line: at, given });
            }
            let reached = measurement.first().map_or(Ok(()), |run| setup.reaches(run, (sweep, sweep)));
            reached.map_err(|what| PositionsProblem::OutOfRange { line: at, what })?;
            sweeps.push(sweep);
        }
        positions.push(sweeps);
    }
    if let Some((run, own)) = file.positions_deg.into_iter().next() {
        let runs = measurements.iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", ");
        return Err(PositionsProblem::NoRun { line: line(own.span().start), run, runs });
    }
    Ok(positions)
}

/// The text of a file of positions, rad.
pub fn positions_text(comment: &str, measurements: &[Measurement], positions: &[Vec<f64>]) -> String {
    let mut out = format!("# {comment}\n[positions_deg]\n");
    for (measurement, own) in measurements.iter().zip(positions) {
        let own: Vec<String> = own.iter().map(|sweep| degrees(*sweep).to_string()).collect();
        let _ = writeln!(out, "{} = [{}]", key(&measurement.name), own.join(", "));
    }
    out
}

/// As it was chosen, without what the conversions have added.
pub fn degrees(sweep: f64) -> f64 {
    decimal(sweep.to_degrees())
}
