//! Pictures: the machine, the dependent rotation over the workspace, the quintic, the ring.

use super::{ALONG, Compensation, OffsetReport, PointError, RingReport, rotation_at};
use crate::plot::{Chart, HeatMap, Label, Mark, Panel, PlotError, PolarChart, Rim, Scale, Series, Sketch, Tone};
use std::f64::consts::TAU;
use trunnion_codegen::quantity::Unit;
use trunnion_solver::exechon::{Machine, Pose};

/// Cells of a map along each axis.
const CELLS: usize = 41;

fn line(name: &str, tone: Tone, points: Vec<(f64, f64)>) -> Series {
    Series { name: name.to_owned(), tone, mark: Mark::Line(points) }
}

/// Struts, platform and tool seen from +y of the base, at home (dashed) and in a pose.
///
/// # Errors
/// [`PlotError`].
pub fn machine_picture(machine: &Machine<f64>, pose: &Pose<f64>, title: &str) -> Result<String, PlotError> {
    let mut series = Vec::new();
    for (part, tone, points) in parts(machine, machine.home()) {
        let name = if part == "struts" { "at home" } else { "" };
        series.push(Series { name: name.to_owned(), tone, mark: Mark::Dashed(points) });
    }
    series.extend(parts(machine, pose).into_iter().map(|(part, tone, points)| line(part, tone, points)));
    let d = machine.dimensions();
    let label = |text: &str, at| Label { text: text.to_owned(), at };
    let labels = vec![label("U1", (-d.xu, 0.0)), label("U3", (d.xu, 0.0)), label("S2", (0.0, 0.0))];
    Sketch { title: title.to_owned(), series, labels }.svg()
}

type Part = (&'static str, Tone, Vec<(f64, f64)>);

/// Lines of a pose: (x, −z), the base above and the tool below.
fn parts(machine: &Machine<f64>, pose: &Pose<f64>) -> Vec<Part> {
    let d = machine.dimensions();
    let on = |x: f64, y: f64, z: f64| {
        [0, 1, 2].map(|k| pose.platform[k] + pose.axes.iter().zip([x, y, z]).map(|(axis, v)| axis[k] * v).sum::<f64>())
    };
    let flat = |v: [f64; 3]| (v[0], -v[2]);
    let (r4, r5, r6) = (on(-d.xr, 0.0, 0.0), on(0.0, d.yr5, 0.0), on(d.xr, 0.0, 0.0));
    let crossing = on(0.0, d.ycp, d.zc);
    let y_a = pose.spindle[1];
    let spindle = [0, 1, 2].map(|k| crossing[k] + d.yt * y_a[k]);
    let strut = |base: [f64; 3], end: [f64; 3]| vec![flat(base), flat(end)];
    vec![
        ("", Tone::Black, vec![(-d.xu, 0.0), (d.xu, 0.0)]),
        ("struts", Tone::Blue, strut([-d.xu, 0.0, 0.0], r4)),
        ("", Tone::Blue, strut([0.0, d.ys2, 0.0], r5)),
        ("", Tone::Blue, strut([d.xu, 0.0, 0.0], r6)),
        ("platform", Tone::Black, [r4, r5, r6, r4].map(flat).to_vec()),
        ("", Tone::Green, [on(0.0, d.ycp, 0.0), crossing, spindle].map(flat).to_vec()),
        ("tool", Tone::Vermilion, strut(spindle, pose.point)),
    ]
}

/// φ in degrees over x and y of the machine at a height z, with marked points.
///
/// # Errors
/// [`PlotError`] where the machine reaches nothing.
pub fn drm_map(
    machine: &Machine<f64>,
    z: f64,
    x: (f64, f64),
    y: (f64, f64),
    marks: &[(&str, (f64, f64))],
) -> Result<String, PlotError> {
    let middles = |(low, high): (f64, f64)| -> Vec<f64> {
        (0..CELLS).map(|k| low + (high - low) * k as f64 / (CELLS - 1) as f64).collect()
    };
    let (columns, rows) = (middles(x), middles(y));
    let cell = |x: f64, y: f64| rotation_at(machine, [x, y, z], ALONG).ok().map(f64::to_degrees);
    let cells = rows.iter().map(|&y| columns.iter().map(|&x| cell(x, y)).collect()).collect();
    HeatMap {
        title: format!("Dependent rotation, tool as at home, z = {z} mm"),
        x: Scale::new("x", Unit::Mm),
        y: Scale::new("y", Unit::Mm),
        value: Scale::new("φ", Unit::Deg),
        columns,
        rows,
        cells,
        marks: marks.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect(),
    }
    .svg()
}

/// φ around a ring with its quintic, and their difference (Fig. 8).
///
/// # Errors
/// [`PictureError`].
pub fn quintic_picture(machine: &Machine<f64>, quintic: &Compensation) -> Result<String, PictureError> {
    let (mut exact, mut fitted, mut difference) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..360 {
        let degrees = f64::from(k);
        let theta = TAU * degrees / 360.0;
        let [x, y, z] = quintic.centre;
        let at = [x + quintic.radius * theta.cos(), y + quintic.radius * theta.sin(), z];
        let (phi, polynomial) = (rotation_at(machine, at, ALONG)?.to_degrees(), quintic.at(theta).to_degrees());
        exact.push((degrees, phi));
        fitted.push((degrees, polynomial));
        difference.push((degrees, polynomial - phi));
    }
    let dashed = Series { name: "quintic (10)".to_owned(), tone: Tone::Vermilion, mark: Mark::Dashed(fitted) };
    let chart = Chart {
        title: "Dependent rotation around the ring".to_owned(),
        x: Scale::new("θ", Unit::Deg),
        panels: vec![
            Panel {
                y: Scale::new("φ", Unit::Deg),
                series: vec![line("inverse kinematics", Tone::Blue, exact), dashed],
            },
            Panel { y: Scale::new("difference", Unit::Deg), series: vec![line("", Tone::Black, difference)] },
        ],
    };
    Ok(chart.svg()?)
}

/// Radial deviations of ring tests, µm (Fig. 9).
///
/// # Errors
/// [`PlotError`].
pub fn ring_picture(reports: &[(&str, &RingReport)], title: &str) -> Result<String, PlotError> {
    let series = reports.iter().zip([Tone::Vermilion, Tone::Blue, Tone::Green]);
    around(series.map(|((name, report), tone)| (*name, tone, report.deviations.as_slice())), title)
}

/// Radial deviations of the touches that an offset was found from, µm: with the dependent rotation, and with the spindle angle alone.
///
/// # Errors
/// [`PlotError`].
pub fn offset_picture(report: &OffsetReport, title: &str) -> Result<String, PlotError> {
    let [with, alone] = [0, 1].map(|k| report.touches.iter().map(|t| (t.angle, t.deviation[k])).collect::<Vec<_>>());
    let both =
        [("with the rotation", Tone::Blue, with.as_slice()), ("spindle angle as it is", Tone::Vermilion, &alone)];
    around(both.into_iter(), title)
}

/// Deviations (mm) at angles (rad) around a circle.
fn around<'a>(
    series: impl Iterator<Item = (&'a str, Tone, &'a [(f64, f64)])>,
    title: &str,
) -> Result<String, PlotError> {
    let series = series.map(|(name, tone, deviations)| {
        let mut points: Vec<_> = deviations.iter().map(|(a, d)| (a.to_degrees(), Unit::Um.from_inner(*d))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        line(name, tone, points)
    });
    let deviation = Scale::new("deviation", Unit::Um);
    PolarChart { title: title.to_owned(), deviation, rim: Rim::Degrees, series: series.collect() }.svg()
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// Out of reach.
    #[error(transparent)]
    Point(#[from] PointError),
    /// Nothing to draw.
    #[error(transparent)]
    Plot(#[from] PlotError),
}
