//! The report for reading at a terminal.

use super::budget::{Budget, Instrument};
use super::curve::Curve;
use super::report::{EstimatedCoefficient, Report};
use core::fmt;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::quantity::Unit;

/// Lines of a curve, at most.
const LINES: usize = 25;
/// Effective degrees of freedom above which they change no digit.
const MANY: f64 = 1e4;
/// Second-order terms named with a curve.
const TERMS: usize = 5;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} estimate", self.model, self.estimator)?;
        let dropped = self.neglected.iter().zip(&self.neglected_usual);
        for ((name, samples, rms), (second, usual)) in self.runs.iter().zip(dropped) {
            writeln!(f, "run {name}: {samples} samples, residuals {rms:.3} µm rms")?;
            writeln!(
                f,
                "  linearisation drops up to {usual:.3} µm on 95 % of machines; second order never over {second:.3} µm"
            )?;
        }
        for (run, down) in &self.weighed_down {
            write!(
                f,
                "run {run}: {} samples weighed down (Huber, robust deviation {:.3} µm)",
                down.samples,
                Unit::Um.from_inner(down.scale)
            )?;
            let most = down.most.iter().map(|(at, w)| format!("{:.1}° to {w:.2}", at.to_degrees()));
            let most: Vec<String> = most.collect();
            writeln!(f, "{}{}", if most.is_empty() { "" } else { ", the most at " }, most.join(", "))?;
        }
        for h in &self.hysteresis {
            let [largest, mean] = [h.largest, h.mean].map(|x| Unit::Um.from_inner(x));
            let [up, down] = h.samples;
            writeln!(
                f,
                "run {}: {up} samples with the angle increasing, {down} decreasing; circular hysteresis H = {:.3} µm at {:.0}° \
                 (mean difference {mean:.3} µm)",
                h.run,
                largest.abs(),
                h.at.to_degrees()
            )?;
        }
        let round = |x: f64| (x * 1e6).round() / 1e6;
        let length = round(Unit::Um.from_inner(self.limits.length));
        let angle = round(Unit::Urad.from_inner(self.limits.angle));
        writeln!(f, "condition {:.1} (columns scaled)", self.condition)?;
        writeln!(f, "± is the expanded uncertainty of 95 % (GUM), for errors within {length} µm and {angle} µrad")?;
        if (Instrument { noise: 0.0, ..self.instrument }) == Instrument::default() {
            writeln!(f, "nothing is stated of the instrument: no ± has a part of it")?;
        }
        writeln!(f, "\nbase parameters")?;
        let width = self.coefficients.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
        for EstimatedCoefficient { name, value, u95, unit, definition, .. } in &self.coefficients {
            write!(f, "  {name:width$} {value:>14.6e} ± {u95:<8.1e} {unit:10}")?;
            writeln!(f, "{}", definition.as_ref().map_or(String::new(), |sum| format!(" = {sum}")))?;
        }
        self.functions.iter().try_for_each(|curve| curve.fmt(f))
    }
}

impl fmt::Display for Curve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\n{}: {}", self.name, self.told.words)?;
        let Some(sum) = &self.told.sum else { return Ok(()) };
        let up_to = self.told.extent == Extent::UpTo;
        if up_to {
            writeln!(f, "  S = {sum}")?;
        }
        let smallest = self.points.iter().map(|p| p.sum_u95).fold(f64::INFINITY, f64::min);
        let digits = decimals(smallest);
        let (at, unit) = (format!("{}/{}", self.coordinate, self.coordinate_unit), self.unit);
        let at = if self.is_location { String::new() } else { at };
        let head = if up_to { format!("S/{unit}") } else { format!("{}/{unit}", self.name) };
        let last = if up_to { format!("  ± as {}", self.name) } else { String::new() };
        writeln!(f, "  {at:>9} {head:>14} {:>10}{last}", "±")?;
        // The ends are always among them.
        let (step, last) = (self.points.len().div_ceil(LINES).max(1), self.points.len().saturating_sub(1));
        let shown = self.points.iter().enumerate().filter(|(i, _)| i % step == 0 || *i == last);
        for (_, p) in shown {
            let at = if self.is_location { String::new() } else { format!("{:.1}", p.at) };
            write!(f, "  {at:>9} {:>14.digits$} {:>10.digits$}", p.value, p.sum_u95)?;
            writeln!(f, "{}", if up_to { format!("  {:>10.digits$}", p.u95) } else { String::new() })?;
        }
        if let Some((at, budget)) = &self.largest {
            let at = format!(" where ± is largest, {} = {at:.1} {}", self.coordinate, self.coordinate_unit);
            let at = if self.is_location { "" } else { &at };
            writeln!(f, "  budget{at}, standard uncertainties in {unit}")?;
            table(f, budget)?;
        }
        let terms = self.neglected_terms.iter().take(TERMS).filter(|t| t.typical >= 0.005);
        let terms: Vec<String> = terms.map(|t| format!("{} {:.2}", t.name, t.typical)).collect();
        match terms.as_slice() {
            [] => Ok(()),
            terms => writeln!(f, "  linearisation: most of it from {}", terms.join(", ")),
        }
    }
}

/// The lines of a budget, then what they make together.
fn table(f: &mut fmt::Formatter<'_>, budget: &Budget) -> fmt::Result {
    let smallest = budget.lines.iter().map(|line| line.contribution.std).fold(budget.combined.std, f64::min);
    let digits = decimals(smallest);
    for line in &budget.lines {
        let dof = line.contribution.degrees_of_freedom.map_or(String::new(), |n| format!("  {n} degrees of freedom"));
        writeln!(f, "    {:14} {:>10.digits$}{dof}", line.source, line.contribution.std)?;
    }
    let combined = &budget.combined;
    let effective = match combined.degrees_of_freedom.floor() {
        many if many > MANY => String::new(),
        few => format!("  {few:.0} effective degrees of freedom"),
    };
    writeln!(f, "    {:14} {:>10.digits$}{effective}", "combined", combined.std)?;
    writeln!(f, "    {:14} {:>10.digits$}  k = {:.2}", "expanded", combined.expanded, combined.factor)
}

/// Decimals that give an uncertainty two digits.
fn decimals(uncertainty: f64) -> usize {
    if uncertainty > 0.0 { (1.0 - uncertainty.log10().floor()).clamp(0.0, 4.0) as usize } else { 3 }
}
