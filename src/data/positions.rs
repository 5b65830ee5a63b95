//! Positions of runs that stop, as `trunnion plan` proposes them and `trunnion new` takes them: in a file of their own, or in the
//! project's.
//!
//! ```toml
//! [positions_deg]
//! a = [-90, -85, 30]
//! ```

use super::limits::POSITIONS;
use crate::study::{Measurement, OutOfRange, Setup, in_unit};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use thiserror::Error;
use toml::Spanned;
use trunnion_codegen::model::key;
use trunnion_codegen::quantity::Unit;

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

/// The table as it stands: of each run the angles.
pub(super) type Stated = BTreeMap<String, Spanned<Vec<Spanned<f64>>>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    positions_deg: Stated,
}

/// Positions of runs that a file has, not yet held to a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Positions {
    /// Of each run the line, and the angles, degrees, with theirs.
    runs: BTreeMap<String, (usize, Vec<(usize, f64)>)>,
}

impl Positions {
    /// Reads the text of a file that has nothing else.
    ///
    /// # Errors
    /// [`PositionsProblem::Format`]
    pub fn read(text: &str) -> Result<Self, PositionsProblem> {
        let file: File = toml::from_str(text).map_err(|e| {
            let line = lines(text)(e.span().map_or(0, |span| span.start));
            PositionsProblem::Format { line, message: e.message().lines().collect::<Vec<_>>().join(", ") }
        })?;
        Ok(Self::of(file.positions_deg, text))
    }

    /// Those of a table of a text.
    pub(super) fn of(stated: Stated, text: &str) -> Self {
        let line = lines(text);
        let angle = |given: Spanned<f64>| (line(given.span().start), given.into_inner());
        let run = |(name, own): (String, Spanned<Vec<Spanned<f64>>>)| {
            let at = line(own.span().start);
            (name, (at, own.into_inner().into_iter().map(angle).collect()))
        };
        Self { runs: stated.into_iter().map(run).collect() }
    }

    /// Of each measurement of a model the sweeps, rad, in the file's order.
    ///
    /// # Errors
    /// [`PositionsProblem`]
    pub fn sweeps(&self, setup: &Setup, measurements: &[Measurement]) -> Result<Vec<Vec<f64>>, PositionsProblem> {
        let mut positions = Vec::new();
        for measurement in measurements {
            let missing = || PositionsProblem::Missing(measurement.name.clone());
            let (line, own) = self.runs.get(&measurement.name).ok_or_else(missing)?;
            let least = setup.least(&measurement.runs);
            if !(least..=POSITIONS).contains(&own.len()) {
                return Err(PositionsProblem::Count { line: *line, least, count: own.len() });
            }
            let mut sweeps: Vec<f64> = Vec::new();
            for &(line, given) in own {
                let sweep = given.to_radians();
                // NaN is within nothing.
                let is_new = given.abs() <= MOST_DEG && !sweeps.contains(&sweep);
                if !is_new {
                    return Err(PositionsProblem::Angle { line, given });
                }
                let reached = measurement.first().map_or(Ok(()), |run| setup.reaches(run, (sweep, sweep)));
                reached.map_err(|what| PositionsProblem::OutOfRange { line, what })?;
                sweeps.push(sweep);
            }
            positions.push(sweeps);
        }
        let is_none = |run: &str| measurements.iter().all(|own| own.name != run);
        if let Some((run, (line, _))) = self.runs.iter().find(|(run, _)| is_none(run)) {
            let runs = measurements.iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", ");
            return Err(PositionsProblem::NoRun { line: *line, run: run.clone(), runs });
        }
        Ok(positions)
    }
}

/// The line of each place in a text, counted from 1.
pub(super) fn lines(text: &str) -> impl Fn(usize) -> usize {
    let ends: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
    move |at| 1 + ends.partition_point(|end| *end < at)
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
    in_unit(Unit::Deg, sweep)
}
