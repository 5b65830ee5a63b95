//! What was kept of a run, and what was trimmed.

use super::trace::{Trace, TraceSample};
use crate::plot::{Mark, PlotError, PolarChart, Rim, Scale, Series, Tone};
use trunnion_codegen::quantity::Unit;

/// Points of a line: more are not seen.
const POINTS: usize = 3600;

/// The deviations of a run around the circle, what was trimmed in another tone.
///
/// Feed-in and feed-out would dwarf the circle: they are drawn up to the span of what was kept beyond it.
///
/// # Errors
/// [`PlotError`]
pub fn trace_picture(title: &str, trace: &Trace) -> Result<String, PlotError> {
    let um = |sample: &TraceSample| Unit::Um.from_inner(sample.reading_mm);
    let kept = trace.kept().iter().map(um);
    let (low, high) = kept.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| (low.min(r), high.max(r)));
    let span = (high - low).max(f64::MIN_POSITIVE);
    let point =
        |sample: &TraceSample| (Unit::Deg.from_inner(sample.angle_rad), um(sample).clamp(low - span, high + span));
    let line = |name: &str, tone, samples: &[TraceSample]| {
        let step = samples.len().div_ceil(POINTS).max(1);
        Series { name: name.to_owned(), tone, mark: Mark::Line(samples.iter().step_by(step).map(point).collect()) }
    };
    let range = trace.range();
    let of = |range| trace.samples.get(range).unwrap_or_default();
    // Each joined to what was kept.
    let trimmed = [of(0..(range.start + 1).min(range.end)), of(range.end.saturating_sub(1)..trace.samples.len())];
    let trimmed = trimmed.into_iter().filter(|samples| samples.len() > 1);
    let mut series: Vec<Series> =
        trimmed.enumerate().map(|(at, s)| line(if at == 0 { "trimmed" } else { "" }, Tone::Vermilion, s)).collect();
    series.push(line("kept", Tone::Blue, trace.kept()));
    PolarChart { title: title.to_owned(), deviation: Scale::new("ΔR", Unit::Um), rim: Rim::Degrees, series }.svg()
}
