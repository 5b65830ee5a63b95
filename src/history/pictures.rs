//! Pictures of a history.

use super::{Change, Compared, Measured, Outcome, Reported};
use crate::plot::{Chart, Mark, Panel, PlotError, Scale, Series, Tone};
use trunnion_codegen::quantity::Unit;

const TONES: [Tone; 4] = [Tone::Blue, Tone::Vermilion, Tone::Green, Tone::Purple];

fn unit(of: &str) -> Unit {
    if of == "um" { Unit::Um } else { Unit::Urad }
}

/// The function in every report with its 95 % band, and below it what differs from the first.
///
/// # Errors
/// [`PlotError`]
pub fn changes(reports: &[Reported], changes: &[Change], function: &str) -> Result<String, PlotError> {
    let of = |report: &Reported| report.functions.iter().find(|f| f.name == function).cloned();
    let own: Vec<(usize, &Reported, Measured)> =
        reports.iter().enumerate().filter_map(|(at, report)| Some((at, report, of(report)?))).collect();
    let Some((_, _, first)) = own.first() else { return Err(PlotError::NoPoints { panel: 1 }) };
    let (x, suffix) = first.axis();
    let across = if suffix == "deg" { Unit::Deg } else { Unit::Mm };
    let both = |name: String, at: usize, points: &[[f64; 3]]| {
        let tone = TONES[at % TONES.len()];
        let band = points.iter().map(|[x, y, u]| (*x, y - u, y + u)).collect();
        let line = points.iter().map(|[x, y, _]| (*x, *y)).collect();
        [Series { name: String::new(), tone, mark: Mark::Band(band) }, Series { name, tone, mark: Mark::Line(line) }]
    };
    let above = own.iter().flat_map(|(at, report, f)| {
        let points: Vec<[f64; 3]> = f.points.iter().map(|p| [p.at, p.value, p.u95]).collect();
        both(report.name.clone(), *at, &points)
    });
    let compared = |change: &Change| match &change.outcome {
        Outcome::Compared(Compared { points, .. }) if change.function == function => {
            Some(both(String::new(), change.report, points))
        }
        _ => None,
    };
    let below: Vec<Series> = changes.iter().filter_map(compared).flatten().collect();
    let y = |label: &str| Scale::new(label, unit(&first.unit));
    let mut panels = vec![Panel { y: y(function), series: above.collect() }];
    if !below.is_empty() {
        panels.push(Panel { y: y("change"), series: below });
    }
    Chart { title: String::new(), x: Scale::new(x, across), panels }.svg()
}

/// The function at a coordinate over the days since the first report, or over the reports where one has no date; with its 95 %
/// band.
///
/// # Errors
/// [`PlotError`] where fewer than two reports have the coordinate.
pub fn over_time(reports: &[Reported], function: &str, at: f64) -> Result<String, PlotError> {
    let first = reports.first().and_then(|report| report.day);
    let dated = reports.iter().all(|report| report.day.is_some());
    let when = |(number, report): (usize, &Reported)| match (report.day, first) {
        (Some(day), Some(first)) if dated => (day - first) as f64,
        _ => number as f64 + 1.0,
    };
    let values = reports.iter().enumerate().filter_map(|(number, report)| {
        let own = report.functions.iter().find(|f| f.name == function)?;
        let point = own.at(at)?;
        Some((when((number, report)), own, *point))
    });
    let mut points: Vec<_> = values.collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, own, _)) = points.get(1) else { return Err(PlotError::NoPoints { panel: 1 }) };
    let (name, suffix) = own.axis();
    let title = format!("{function} at {name} = {at}{}", if suffix == "deg" { "°" } else { " mm" });
    let band = points.iter().map(|(t, _, p)| (*t, p.value - p.u95, p.value + p.u95)).collect();
    let line = points.iter().map(|(t, _, p)| (*t, p.value)).collect();
    let series = vec![
        Series { name: "± U (95 %)".to_owned(), tone: Tone::Blue, mark: Mark::Band(band) },
        Series { name: function.to_owned(), tone: Tone::Blue, mark: Mark::Line(line) },
    ];
    let x = Scale::plain(if dated { "days since the first report" } else { "report" });
    Chart { title, x, panels: vec![Panel { y: Scale::new(function, unit(&own.unit)), series }] }.svg()
}
