//! The picture of a circular test.

use super::direction::Direction;
use super::figures::{Circular, Test};
use super::plane::Axis;
use super::trace::Trace;
use crate::plot::{Mark, PolarChart, Rim, Scale, Series, Tone};
use std::f64::consts::TAU;
use trunnion_codegen::quantity::Unit;
use trunnion_solver::circle::Circle;

/// The arrow at a path's beginning is this long, rad.
const ARROW: f64 = TAU / 18.0;
/// A path of more samples is drawn with fewer: the eye sees no more of them.
const DRAWN: usize = 7200;
/// From a point of a circle to the next one, degrees.
const STEP: usize = 2;

/// The paths magnified about the nominal circle, each with its beginning and the way it goes, and the least-squares circle of
/// all samples.
pub fn picture(test: &Test, figures: &Circular, title: &str) -> PolarChart {
    let mut series = Vec::new();
    let circles = figures.both.as_ref().map(|both| &both.circles);
    let circles = circles.or(figures.paths.first().map(|path| &path.circles));
    for (direction, trace) in test.traces.each() {
        let tone = if direction == Direction::Clockwise { Tone::Vermilion } else { Tone::Blue };
        let path = trace.path(direction);
        // Samples in no order say where they are, not where the path began.
        let begins = figures.paths.iter().any(|path| path.direction == direction && path.start.is_some());
        let arrow = if begins { beginning(&path) } else { Vec::new() };
        series.push(Series { name: direction.to_string(), tone, mark: Mark::Line(drawn(thinned(path))) });
        if !arrow.is_empty() {
            series.push(Series { name: String::new(), tone, mark: Mark::Arrow(drawn(arrow)) });
        }
    }
    if let (Some(circles), Some((_, trace))) = (circles, test.traces.each().next()) {
        let circle = outline(&circles.least_squares.circle, trace, test.radius.mm());
        let name = "least-squares circle".to_owned();
        series.push(Series { name, tone: Tone::Black, mark: Mark::Dashed(drawn(circle)) });
    }
    PolarChart {
        title: title.to_owned(),
        deviation: Scale::new("radial deviation", Unit::Um),
        rim: Rim::Axes(Axis::ALL.map(|axis| test.plane.axis(axis).to_string())),
        series,
    }
}

/// In degrees and µm.
fn drawn(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.into_iter().map(|(angle, deviation)| (angle.to_degrees(), Unit::Um.from_inner(deviation))).collect()
}

/// The smallest and the largest deviation of each few samples, in their order.
fn thinned(path: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if path.len() <= DRAWN {
        return path;
    }
    let ends = |few: &[(f64, f64)]| {
        let by = |a: &&(usize, &(f64, f64)), b: &&(usize, &(f64, f64))| a.1.1.total_cmp(&b.1.1);
        let numbered: Vec<_> = few.iter().enumerate().collect();
        let mut ends: Vec<_> = [numbered.iter().min_by(by), numbered.iter().max_by(by)].into_iter().flatten().collect();
        ends.sort_by_key(|(at, _)| *at);
        ends.into_iter().map(|(_, sample)| **sample).collect::<Vec<_>>()
    };
    path.chunks((2 * path.len()).div_ceil(DRAWN)).flat_map(ends).collect()
}

/// The first part of a path.
fn beginning(path: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let first = path.first().map_or(0.0, |(angle, _)| *angle);
    let near = path.iter().take_while(|(angle, _)| (angle - first).abs() <= ARROW);
    near.copied().collect()
}

/// How far a circle is from the nominal one, over the angles of a trace.
fn outline(circle: &Circle<f64>, trace: &Trace, radius: f64) -> Vec<(f64, f64)> {
    let ([x, y], profile) = (circle.centre, trace.profile());
    let first = profile.points().first().map_or(0.0, |(angle, _)| *angle);
    let (from, arc) = if profile.is_whole() { (0.0, TAU) } else { (first, profile.arc()) };
    let steps = (arc.to_degrees() / STEP as f64).ceil().max(1.0) as usize;
    let at = |k: usize| {
        let angle = from + arc * k as f64 / steps as f64;
        let (s, c) = angle.sin_cos();
        let aside = x * s - y * c;
        (angle, x * c + y * s + (circle.radius * circle.radius - aside * aside).max(0.0).sqrt() - radius)
    };
    (0..=steps).map(at).collect()
}
