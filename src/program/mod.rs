//! NC programs of runs: the path in short straight blocks, there and back, each with its feed-in and feed-out.
//!
//! [`Probing`] are programs that stop at each position and touch a sphere there.
//!
//! Every block takes as long as every other, so that the sweep goes at a constant rate, which is what an angle is inferred from
//! where an instrument records none. Coordinates are the model's own: a person sets the zero point where the model has it.

mod control;
mod probing;
mod sphere;

pub use control::Control;
pub use probing::Probing;

use crate::study::{FEED_IN, Path};
use std::fmt::Write;
use trunnion_codegen::model::AxisKind;
use trunnion_codegen::problems::visible;

/// The feed by which a bar is shortened into the path, mm/min.
const FEED: f64 = 100.0;
/// Before each way, s.
const DWELL: f64 = 2.0;

/// A run to be driven.
#[derive(Clone, Debug)]
pub struct Program<'a> {
    /// Its name.
    pub name: &'a str,
    /// What is measured, for the first line.
    pub title: &'a str,
    /// The path.
    pub path: &'a Path,
    /// Degrees of the sweep a minute.
    pub rate: f64,
}

impl Program<'_> {
    /// The program for a control; `None` where an axis has a name that it does not take.
    pub fn text(&self, control: Control) -> Option<String> {
        let path = self.path;
        if !path.axes.iter().all(|(name, _)| control.takes(name)) {
            return None;
        }
        let [from, to] = path.measured.map(f64::to_degrees);
        let mut out = Lines::new(control);
        out.begin(self.name);
        out.comment(&format!("{}: run {}", self.title, self.name));
        out.comment(&format!("made by trunnion {}; {}", env!("CARGO_PKG_VERSION"), control.verified()));
        out.comment(&format!(
            "sweep {from:.3} to {to:.3} degrees at {} a minute, {:.3} degrees beyond both ends",
            self.rate,
            path.overshoot.to_degrees()
        ));
        if path.overshoot > 0.0 {
            out.comment("that sweep is measured; beyond it the axes come to speed and to rest");
        }
        out.comment(&format!(
            "coordinates have {} decimals{}: that leaves the bar up to {:.2} um off its length",
            control.decimals(),
            control.needs(),
            1e3 * self.rounding(control)
        ));
        out.comment("the zero point is the model's: set the work offset so that these coordinates hold");
        out.comment(
            "check the kinematics' limits and that nothing collides; prove it without the bar, at low override",
        );
        control.prepare().iter().for_each(|line| out.line(line));
        let there: Vec<usize> = (0..path.points.len()).collect();
        let back: Vec<usize> = there.iter().rev().copied().collect();
        self.way("there", &there, 0, &mut out);
        self.way("and back", &back, 1, &mut out);
        out.end(self.name);
        Some(out.text)
    }

    /// How far rounded coordinates take the bar off its length at most, mm: half a last digit of each linear axis together, and of
    /// each rotary one at the farther ball.
    fn rounding(&self, control: Control) -> f64 {
        let half = 0.5 * 10f64.powi(-(control.decimals() as i32));
        let of = |kind| self.path.axes.iter().filter(|(_, own)| *own == kind).count() as f64;
        let away = |ball: &[f64; 3]| ball.iter().map(|x| x * x).sum::<f64>().sqrt();
        let lever = self.path.balls.iter().map(away).fold(0.0, f64::max);
        half * (of(AxisKind::Linear).sqrt() + of(AxisKind::Rotary) * lever.to_radians())
    }

    /// One way along the path, that begins at one of its ends.
    fn way(&self, name: &str, order: &[usize], begins: usize, out: &mut Lines) {
        let (path, control) = (self.path, out.control);
        let (Some(&first), Some(&last)) = (order.first(), order.last()) else { return };
        let beside = |at: usize, end: usize| {
            let outward = path.outward.as_ref().map(|outward| &outward[end]);
            let by = |axis: usize| outward.map_or(0.0, |outward| FEED_IN * outward[axis]);
            path.points[at].iter().enumerate().map(|(axis, x)| x + by(axis)).collect::<Vec<f64>>()
        };
        out.comment(&format!("{name}: mount the bar, begin to record"));
        out.line(&control.rapid(&self.words(&beside(first, begins), control)));
        out.line(control.pause());
        control.dwell(DWELL).iter().for_each(|line| out.line(line));
        control.timed().iter().for_each(|line| out.line(line));
        let step = path.sweeps.windows(2).next().map_or(0.0, |two| (two[1] - two[0]).to_degrees());
        let minutes = step / self.rate;
        let mut at = beside(first, begins);
        let mut to = |point: Vec<f64>, minutes: f64| {
            let block = control.block(&self.words(&point, control), minutes, self.length(&at, &point));
            at = point;
            block
        };
        if path.outward.is_some() {
            out.line(&to(path.points[first].clone(), FEED_IN / FEED));
        }
        for &point in order.iter().skip(1) {
            out.line(&to(path.points[point].clone(), minutes));
        }
        if path.outward.is_some() {
            out.line(&to(beside(last, 1 - begins), FEED_IN / FEED));
        }
        control.untimed().iter().for_each(|line| out.line(line));
    }

    /// A word for each axis, in mm and degrees.
    fn words(&self, point: &[f64], control: Control) -> String {
        let axes = self.path.axes.iter().zip(point);
        let word = |((name, kind), x): (&(String, AxisKind), &f64)| {
            control.word(name, if *kind == AxisKind::Rotary { x.to_degrees() } else { *x })
        };
        axes.map(word).collect::<Vec<_>>().join(" ")
    }

    /// How far the linear axes go, mm, or the rotary ones, degrees, where none does.
    fn length(&self, from: &[f64], to: &[f64]) -> f64 {
        let of = |kind: AxisKind| {
            let axes = self.path.axes.iter().zip(from.iter().zip(to)).filter(|((_, own), _)| *own == kind);
            axes.map(|(_, (a, b))| (b - a).powi(2)).sum::<f64>().sqrt()
        };
        match of(AxisKind::Linear) {
            0.0 => of(AxisKind::Rotary).to_degrees(),
            length => length,
        }
    }
}

/// A program as it grows.
struct Lines {
    control: Control,
    text: String,
    count: usize,
}

impl Lines {
    fn new(control: Control) -> Self {
        Self { control, text: String::new(), count: 0 }
    }

    fn line(&mut self, line: &str) {
        if self.control.counts_lines() {
            let _ = write!(self.text, "{} ", self.count);
            self.count += 1;
        }
        self.text += line;
        self.text.push('\n');
    }

    fn comment(&mut self, text: &str) {
        self.line(&self.control.comment(&visible(text)));
    }

    fn begin(&mut self, name: &str) {
        self.control.begin(name).iter().for_each(|line| self.line(line));
    }

    fn end(&mut self, name: &str) {
        self.control.end(name).iter().for_each(|line| self.line(line));
    }
}
