//! Runs of a table of angles and readings.

use std::ops::Range;

use super::error::{FEWEST, ImportProblem, Wrong};
use super::feed::feed_arcs;
use super::passes::passes;
use super::trace::{AnglesFrom, Cut, Stated, Trace, TraceSample, UnitFrom};
use crate::circular::Direction;
use trunnion_codegen::quantity::Unit;

/// Divides samples in the order of time into passes along the circle, each trimmed to the arc that is stated; samples in no
/// order are one of their own. `unit` is that of the readings in the file.
///
/// # Errors
/// [`ImportProblem`] where a pass has too few samples, or none within the arc.
pub fn by_passes(samples: &[TraceSample], unit: Unit, stated: &Stated) -> Result<Vec<Trace>, ImportProblem> {
    let angles: Vec<f64> = samples.iter().map(|sample| sample.angle_rad).collect();
    let ordered = passes(&angles);
    let direction = |grows: bool| Some(if grows { Direction::Counterclockwise } else { Direction::Clockwise });
    let parts = match ordered {
        Some(passes) => passes.into_iter().map(|(range, grows)| (range, direction(grows))).collect(),
        None => vec![(0..samples.len(), None)],
    };
    let trace = |(range, direction): (Range<usize>, Option<Direction>)| {
        let samples = samples.get(range).unwrap_or_default().to_vec();
        if samples.len() < FEWEST {
            return Err(Wrong::FewReadings(samples.len()).at(samples.first().map_or(1, |sample| sample.line)));
        }
        let readings: Vec<f64> = samples.iter().map(|sample| sample.reading_mm).collect();
        let feed = if direction.is_some() { feed_arcs(&readings) } else { [0, 0] };
        let mut trace = Trace {
            samples,
            cut: Cut { feed, ..Cut::default() },
            direction,
            unit,
            unit_from: UnitFrom::Header,
            angles_from: AnglesFrom::Column,
            features: Vec::new(),
        };
        trace.trim(stated.ends_deg)?;
        Ok(trace)
    };
    parts.into_iter().map(trace).collect()
}
