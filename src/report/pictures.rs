//! The pictures of a fit.

use crate::data::Files;
use crate::exechon::RingReport;
use crate::plot::{Chart, Mark, Panel, PlotError, PolarChart, Rim, Scale, Series, Tone};
use crate::study::{Curve, Histogram, Report, Trace, TracePoint};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::quantity::Unit;

/// Points of a normal curve.
const STEPS: usize = 120;

/// The pictures of a run.
struct OfRun {
    polar: String,
    residuals: String,
    /// None of residuals that are all zero.
    histogram: Option<String>,
}

/// Pictures of each run and each function for a page, which has captions; none of a function that is not seen.
pub(super) fn fit(report: &Report) -> Result<Value, PlotError> {
    let run = |index| {
        let OfRun { polar, residuals, histogram } = of_run(report, index, ["", "", ""])?;
        Ok(json!({ "polar": polar, "residuals": residuals, "histogram": histogram }))
    };
    let functions = report.functions.iter().map(|c| Some(c).filter(drawn).map(|c| curve(c, "")).transpose());
    Ok(json!({
        "runs": (0..report.runs.len()).map(run).collect::<Result<Vec<_>, PlotError>>()?,
        "functions": functions.collect::<Result<Vec<_>, PlotError>>()?,
    }))
}

/// The same pictures as files with titles: of each run `RUN-readings.svg`, `RUN-residuals.svg` and `RUN-histogram.svg`, of each
/// function that is seen `FUNCTION.svg`. A run that was measured several times is `RUN-1`, `RUN-2`, …. Of a factor's report those of
/// the functions alone.
///
/// # Errors
/// [`PlotError`]
pub fn picture_files(report: &Report) -> Result<Files<'static>, PlotError> {
    let mut files = Files::default();
    for (index, (name, ..)) in report.runs.iter().take(report.traces.len()).enumerate() {
        let titles = ["readings", "residuals", "residuals"].map(|what| format!("{name}: {what}"));
        let drawn = of_run(report, index, titles.each_ref().map(String::as_str))?;
        // `RUN/2` where it was measured several times.
        let name = name.replace('/', "-");
        files.add(format!("{name}-readings.svg"), drawn.polar);
        files.add(format!("{name}-residuals.svg"), drawn.residuals);
        drawn.histogram.into_iter().for_each(|svg| files.add(format!("{name}-histogram.svg"), svg));
    }
    for own in report.functions.iter().filter(drawn) {
        files.add(format!("{}.svg", own.name), curve(own, &format!("{} of {}", own.name, report.model))?);
    }
    Ok(files)
}

/// The radial deviations of a ring counted; none where they leave no scatter.
pub(super) fn ring(report: &RingReport) -> Result<Option<String>, PlotError> {
    let histogram = report.histogram().filter(|histogram| !histogram.counts.is_empty());
    histogram.map(|own| counts(&own, report.deviations.len(), Unit::Um.from_inner(report.rms()), "")).transpose()
}

fn of_run(report: &Report, index: usize, titles: [&str; 3]) -> Result<OfRun, PlotError> {
    let (_, samples, rms_um) = report.runs[index];
    let (trace, histogram) = (&report.traces[index], &report.histograms[index]);
    let counted = (!histogram.counts.is_empty()).then(|| counts(histogram, samples, rms_um, titles[2]));
    Ok(OfRun {
        polar: polar(trace, titles[0])?,
        residuals: residuals(trace, titles[1])?,
        histogram: counted.transpose()?,
    })
}

/// Whether a function is seen, and is one.
fn drawn(curve: &&Curve) -> bool {
    !curve.points.is_empty() && !curve.is_location
}

fn line(name: &str, tone: Tone, points: Vec<(f64, f64)>) -> Series {
    Series { name: name.to_owned(), tone, mark: Mark::Line(points) }
}

fn um(mm: f64) -> f64 {
    Unit::Um.from_inner(mm)
}

/// Both directions, those that there are, each named where both are.
fn directions(trace: &Trace) -> impl Iterator<Item = (&'static str, Tone, &[TracePoint])> {
    let both = !trace.increasing.is_empty() && !trace.decreasing.is_empty();
    let all = [("increasing", Tone::Blue, &trace.increasing), ("decreasing", Tone::Vermilion, &trace.decreasing)];
    all.into_iter()
        .filter(|(.., points)| !points.is_empty())
        .map(move |(name, tone, points)| (if both { name } else { "" }, tone, points.as_slice()))
}

/// The readings of a run around the turn.
fn polar(trace: &Trace, title: &str) -> Result<String, PlotError> {
    let series = directions(trace).map(|(name, tone, points)| {
        let points = points.iter().map(|p| (Unit::Deg.from_inner(p.sweep), um(p.reading)));
        line(name, tone, points.collect())
    });
    PolarChart {
        title: title.to_owned(),
        deviation: Scale::new("reading", Unit::Um),
        rim: Rim::Degrees,
        series: series.collect(),
    }
    .svg()
}

/// Its residuals over the sweep: their means, and how far they go.
fn residuals(trace: &Trace, title: &str) -> Result<String, PlotError> {
    let series = directions(trace).flat_map(|(name, tone, points)| {
        let at = |p: &TracePoint| Unit::Deg.from_inner(p.sweep);
        let several = points.iter().any(|p| p.samples > 1);
        let range = points.iter().map(|p| (at(p), um(p.residuals[0]), um(p.residuals[1])));
        let band = Series { name: String::new(), tone, mark: Mark::Band(range.collect()) };
        let mean = line(name, tone, points.iter().map(|p| (at(p), um(p.residual))).collect());
        several.then_some(band).into_iter().chain([mean])
    });
    let (x, y) = (Scale::new("swept angle", Unit::Deg), Scale::new("residual", Unit::Um));
    chart(title, x, y, series.collect()).small_svg()
}

/// Its residuals counted, beside the normal distribution of their root mean square.
fn counts(histogram: &Histogram, samples: usize, rms_um: f64, title: &str) -> Result<String, PlotError> {
    let Histogram { from, width, counts, .. } = histogram;
    let rms = Unit::Um.to_inner(rms_um);
    let ends = |bin: usize| [from + bin as f64 * width, from + (bin + 1) as f64 * width].map(um);
    let share = |count: usize| 100.0 * count as f64 / samples.max(1) as f64;
    let bars = counts.iter().enumerate().flat_map(|(bin, &count)| ends(bin).map(|x| (x, 0.0, share(count))));
    let (low, high) = (*from, from + counts.len() as f64 * width);
    let normal = (0..=STEPS).map(|k| {
        let x = low + (high - low) * k as f64 / STEPS as f64;
        let density = (-0.5 * (x / rms).powi(2)).exp() / (rms * TAU.sqrt());
        (um(x), 100.0 * density * width)
    });
    let mut series = vec![Series { name: String::new(), tone: Tone::Blue, mark: Mark::Band(bars.collect()) }];
    if rms > 0.0 {
        let mark = Mark::Dashed(normal.collect());
        series.push(Series { name: "normal with the same rms".to_owned(), tone: Tone::Black, mark });
    }
    chart(title, Scale::new("residual", Unit::Um), Scale::percent("samples"), series).small_svg()
}

/// A function, or the sum it is seen in, with its band; where that is not the function, the function's band around it.
fn curve(curve: &Curve, title: &str) -> Result<String, PlotError> {
    let band = |name: &str, tone, of: &dyn Fn(&crate::study::CurvePoint) -> f64| Series {
        name: name.to_owned(),
        tone,
        mark: Mark::Band(curve.points.iter().map(|p| (p.at, p.value - of(p), p.value + of(p))).collect()),
    };
    let up_to = curve.told.extent == Extent::UpTo;
    let label = if up_to { "S".to_owned() } else { subscripted(&curve.name) };
    let mut series = Vec::new();
    if up_to {
        series.push(band(&format!("{} within, 95 %", subscripted(&curve.name)), Tone::Vermilion, &|p| p.u95));
    }
    series.push(band(&format!("{label}, 95 %"), Tone::Blue, &|p| p.sum_u95));
    series.push(line(
        &format!("{label} estimated"),
        Tone::Blue,
        curve.points.iter().map(|p| (p.at, p.value)).collect(),
    ));
    chart(title, Scale::new(&curve.coordinate, curve.coordinate_unit), Scale::new(&label, curve.unit), series).svg()
}

fn chart(title: &str, x: Scale, y: Scale, series: Vec<Series>) -> Chart {
    Chart { title: title.to_owned(), x, panels: vec![Panel { y, series }] }
}

/// `eps_xa` as ε with an index, `EAA` as E with one.
fn subscripted(name: &str) -> String {
    match (name.strip_prefix("eps_"), name.strip_prefix('E')) {
        (Some(index), _) => format!("ε_{{{index}}}"),
        (_, Some(index)) if index.len() == 2 => format!("E_{{{index}}}"),
        _ => name.to_owned(),
    }
}
