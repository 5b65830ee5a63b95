//! NC programs that find the centre of a sphere with a touch probe, position by position.
//!
//! At each the sphere is touched from above, from four sides at its equator, and from above again; the radius at which the probe
//! touches is that of the equator, so that what the probe is late by falls out. Each sample is where the probe should have to go,
//! by the model, less where it has to: the displacement of the tool's ball against the workpiece's.

use super::{Control, Lines, sphere};
use crate::study::Path;
use trunnion_codegen::model::AxisKind;

/// Above everything that the sphere reaches, mm.
const ABOVE: f64 = 20.0;

/// A measurement to be probed.
#[derive(Clone, Debug)]
pub struct Probing<'a> {
    /// Its name.
    pub name: &'a str,
    /// What is measured, for the first line.
    pub title: &'a str,
    /// The positions.
    pub path: &'a Path,
    /// What the sweep is called.
    pub sweep: &'a str,
    /// How far the sphere's centre is from the probe ball's where they touch, mm: half of both diameters.
    pub radius: f64,
}

impl Probing<'_> {
    /// The program for a control; `None` where X, Y and Z are not what the model moves, or an axis has a name that it does not take.
    pub fn text(&self, control: Control) -> Option<String> {
        let linear = |name: &str| {
            let own = |(other, kind): &(String, AxisKind)| other == name && *kind == AxisKind::Linear;
            self.path.axes.iter().position(own)
        };
        let [x, y, z] = [linear("X")?, linear("Y")?, linear("Z")?];
        let rotary = |at: &usize| self.path.axes[*at].1 == AxisKind::Rotary;
        // One that stands at zero all the time needs no word: the spindle of a head.
        let stands = |at: &usize| self.path.points.iter().all(|point| point[*at] == 0.0);
        let named = |at: &usize| control.takes(&self.path.axes[*at].0);
        let turned: Vec<usize> =
            (0..self.path.axes.len()).filter(|at| rotary(at) && (named(at) || !stands(at))).collect();
        if !turned.iter().all(named) {
            return None;
        }
        // However the axes stand when it begins, and turn.
        let far = |point: &Vec<f64>| [x, y, z].map(|at| point[at].powi(2)).iter().sum::<f64>().sqrt();
        let highest = self.path.points.iter().map(far).fold(0.0, f64::max);
        let mut out = Lines::new(control);
        out.begin(self.name);
        sphere::declared(control).iter().for_each(|line| out.line(line));
        out.comment(&format!("{}: run {}, {} positions", self.title, self.name, self.path.points.len()));
        out.comment(&format!("made by trunnion {}; {}", env!("CARGO_PKG_VERSION"), sphere::tried(control)));
        out.comment("axes are moved one by one, not as a tool's tip: leave the kinematics of the rotary axes off");
        out.comment("the zero point is the model's: set the work offset so that these coordinates hold");
        out.comment(
            "see that nothing is in the way, of the sphere's stem and the rotary axes neither; prove it at low override",
        );
        for (place, (name, value, what)) in [
            ("radius", self.radius, "half of the diameters of the sphere and of the probe's ball"),
            ("clear", 5.0, "how far from there a touch begins, and how far beyond it ends without one"),
            ("back", 0.3, "the way back before the second touch"),
            ("fast", 300.0, "feed of the first touch, mm/min"),
            ("slow", 30.0, "feed of the second"),
            ("safe", (highest + self.radius + ABOVE).ceil(), "height at which the rotary axes turn"),
        ]
        .into_iter()
        .enumerate()
        {
            out.line(&sphere::setting(control, place, name, value, what));
        }
        sphere::before(control).lines().for_each(|line| out.line(line));
        sphere::prepare(control).iter().for_each(|line| out.line(line));
        out.line(sphere::safe(control));
        let header = format!("{}_deg,dx_mm,dy_mm,dz_mm", self.sweep);
        out.comment(&format!("readings: {header}"));
        sphere::begin(control, self.name, &header).iter().for_each(|line| out.line(line));
        for (sweep, point) in self.path.sweeps.iter().zip(&self.path.points) {
            let word = |at: &usize| control.word(&self.path.axes[*at].0, point[*at].to_degrees());
            out.line(&control.rapid(&turned.iter().map(word).collect::<Vec<_>>().join(" ")));
            let place = [point[x], point[y], point[z], sweep.to_degrees()];
            sphere::find(control, self.name, place).iter().for_each(|line| out.line(line));
        }
        sphere::end(control).iter().for_each(|line| out.line(line));
        sphere::behind(control).lines().for_each(|line| out.line(line));
        control.close(self.name).iter().for_each(|line| out.line(line));
        Some(out.text)
    }
}
