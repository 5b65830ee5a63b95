//! The report for reading at a terminal.

use super::curve::Curve;
use super::report::Report;
use core::fmt;
use trunnion_codegen::quantity::Unit;

/// Lines of a curve, at most.
const LINES: usize = 25;
/// Second-order terms named with a curve.
const TERMS: usize = 5;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} estimate", self.model, self.estimator)?;
        for (name, samples, rms) in &self.runs {
            writeln!(f, "run {name}: {samples} samples, residuals {rms:.3} µm rms")?;
        }
        writeln!(f, "condition {:.1} (columns scaled)", self.condition)?;
        let round = |x: f64| (x * 1e6).round() / 1e6;
        let length = round(Unit::Um.from_inner(self.limits.length));
        let angle = round(Unit::Urad.from_inner(self.limits.angle));
        let dropped = self.runs.iter().zip(&self.neglected).map(|((name, ..), n)| format!("{n:.3} µm ({name})"));
        let dropped: Vec<String> = dropped.collect();
        writeln!(
            f,
            "linearisation drops at most {} with errors within {length} µm and {angle} µrad",
            dropped.join(", ")
        )?;
        writeln!(f, "\nbase parameters")?;
        let width = self.coefficients.iter().map(|c| c.name.len()).max().unwrap_or(0);
        for c in &self.coefficients {
            writeln!(f, "  {:width$} {:>14.6e} ± {:<10.2e} {}", c.name, c.value, c.std, c.unit)?;
        }
        for curve in &self.functions {
            curve.fmt(f)?;
        }
        writeln!(f, "\nThe band holds the noise of these readings; the uncertainty of the instrument is not in it.")
    }
}

impl fmt::Display for Curve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "\n{} ({}), 95 % band of the fit; linearisation adds typically {:.2} (rms), at most {:.1}",
            self.name, self.unit, self.neglected_typical, self.neglected
        )?;
        let terms = self.neglected_terms.iter().take(TERMS).map(|t| format!("{} {:.2}", t.name, t.typical));
        let terms: Vec<String> = terms.collect();
        if !terms.is_empty() {
            writeln!(f, "  most of it from {}", terms.join(", "))?;
        }
        for p in self.points.iter().step_by(self.points.len().div_ceil(LINES).max(1)) {
            writeln!(
                f,
                "  {} = {:>6.1} {}  {:>9.3} ± {:.3}",
                self.coordinate, p.at, self.coordinate_unit, p.value, p.u95
            )?;
        }
        Ok(())
    }
}
