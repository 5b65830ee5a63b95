//! `trunnion demo`: the paper in one command.

use super::output::print;
use super::{Refused, monte_carlo};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use trunnion::data::{Files, Guard, Unit, simulation_files};
use trunnion::plot::{Chart, Mark, Panel, Scale, Series, Tone};
use trunnion::study::{
    Drawn, ErrorLimits, Estimator, Instrument, Observation, RecoveredFunction, Recovery, Report, Sample, Setup,
    Simulation, StudyError, fit, recovery, report,
};
use trunnion_codegen::emit::equations;

/// The paper's machine.
const MODEL: &str = "tilting-table-a";
/// Length of the bar, mm; the paper does not give it.
const RADIUS: f64 = 150.0;
/// Largest error of the estimated function in the paper's one simulation, µrad.
const PAPER: f64 = 2.643;
const TRIALS: u64 = 1000;

/// Arguments of `demo`.
#[derive(Debug, Args)]
pub struct DemoArguments {
    /// Directory for the figures and the simulated measurements.
    #[arg(long, value_name = "DIR", default_value = "trunnion-demo")]
    out: PathBuf,
    /// Replaces files of their names even if they are none of an earlier demo.
    #[arg(long)]
    force: bool,
}

impl DemoArguments {
    /// Derives, simulates, fits, draws, compares.
    pub fn run(self) -> Result<(), Refused> {
        let setup = Setup::from_catalogue(MODEL, &[("R", RADIUS)])?;
        let simulation = Simulation {
            seed: 1,
            samples: 360,
            noise_um: 0.1,
            limits: ErrorLimits::scaled(30.0, 100.0),
            range_deg: (0.0, 360.0),
        };
        let drawn = simulation.draw(&setup);
        let observations = &drawn.observations().raw;
        let mut out = String::from("1. The equations, derived from the machine's description\n\n");
        out += &equations::text(&setup.model, &setup.derivation);
        let _ = write!(
            out,
            "\n2. A machine drawn within ±30 µm and ±100 µrad, both runs simulated exactly: R = {RADIUS} mm, 360 samples, ±0.1 µm\n"
        );
        let mut reports = Vec::new();
        for estimator in [Estimator::Joint, Estimator::TwoStep] {
            let fitted = fit(&setup, observations, estimator)?;
            let report = report(&setup, observations, &fitted, ErrorLimits::PAPER, &Instrument::default(), false)?;
            let recovery = recovery(&setup, &drawn.machine, &fitted, &report);
            reports.push((report, recovery));
        }
        out += &recovered(&reports);
        let _ = write!(
            out,
            "\n3. {TRIALS} such machines; the paper's one simulation had a largest error of {PAPER} µrad\n\n"
        );
        let estimators = [Estimator::TwoStep, Estimator::Joint];
        let studies = monte_carlo::watched(&setup, simulation.draws(TRIALS), Drawn::Machines, &estimators)?;
        out += &monte_carlo::text(&setup, TRIALS, Drawn::Machines, &studies);
        let figures = figures(&setup, observations, &reports)?;
        let files = simulation_files(&setup, &drawn, &self.out, figures)?;
        files.write(&self.out, &Guard { inputs: Vec::new(), force: self.force })?;
        let _ = write!(
            out,
            "\nwritten to {}: fig3.svg, fig4.svg, tilting.csv, separation.csv, table.csv, truth.json\n",
            self.out.display()
        );
        Ok(print(&out)?)
    }
}

/// What was recovered against the truth.
fn recovered(reports: &[(Report, Recovery)]) -> String {
    let mut out = String::from("± is the expanded uncertainty of 95 %\n");
    for (report, recovery) in reports {
        let _ = writeln!(out, "\n{}: condition {:.1}", report.estimator, report.condition);
        for (name, samples, rms) in &report.runs {
            let _ = writeln!(out, "  run {name}: {samples} samples, residuals {rms:.3} µm rms");
        }
        let _ = writeln!(out, "  {:6} {:>14} {:>14} {:>10}", "", "estimate", "truth", "±");
        for (c, truth) in report.coefficients.iter().zip(&recovery.coefficients) {
            let _ = writeln!(out, "  {:6} {:>14.6e} {truth:>14.6e} {:>10.1e} {}", c.name, c.value, c.u95, c.unit);
        }
        for (curve, RecoveredFunction { largest, inside, .. }) in report.functions.iter().zip(&recovery.functions) {
            let _ = writeln!(
                out,
                "  {}: largest error {largest:.3} {}, truth inside the 95 % band at {inside} of {} points",
                curve.name,
                curve.unit,
                curve.points.len()
            );
        }
    }
    let first = reports.first().map(|(report, _)| report);
    let dropped = first.into_iter().flat_map(|r| r.runs.iter().zip(&r.neglected_usual).zip(&r.neglected));
    for (((name, ..), usual), second) in dropped {
        let _ = write!(out, "\nLinearisation drops up to {usual:.3} µm of {name} on 95 % of such machines");
        let _ = write!(out, "; the second order is never over {second:.3} µm");
    }
    let _ = writeln!(out);
    out
}

/// Fig. 3, the readings, and Fig. 4, the estimate against the truth.
fn figures(
    setup: &Setup,
    observations: &[Observation],
    reports: &[(Report, Recovery)],
) -> Result<Files<'static>, Refused> {
    let line = |name: &str, tone, points| Series { name: name.to_owned(), tone, mark: Mark::Line(points) };
    let tones = [Tone::Blue, Tone::Vermilion, Tone::Green, Tone::Purple];
    let runs = observations.iter().zip(tones).enumerate().map(|(i, (o, tone))| {
        let point = |s: &Sample| (Unit::Deg.from_inner(s.sweep), Unit::Um.from_inner(s.reading));
        let name = format!("ΔR_{{{}}} ({})", i + 1, setup.model.runs[o.run].name);
        line(&name, tone, o.samples.iter().map(point).collect())
    });
    let readings = Chart {
        title: "Radial deviations of both runs, simulated exactly".to_owned(),
        x: Scale::new("a", Unit::Deg),
        panels: vec![Panel { y: Scale::new("ΔR", Unit::Um), series: runs.collect() }],
    };
    let mut files = Files::default();
    files.add("fig3.svg", readings.svg()?);
    let mut curves = reports.iter().filter_map(|(report, recovery)| {
        Some((report.estimator, report.functions.first()?, &recovery.functions.first()?.truth))
    });
    let Some((estimator, curve, truth)) = curves.clone().next() else {
        return Err(StudyError::NothingEstimated.into());
    };
    let points = &curve.points;
    let estimated = Panel {
        y: Scale::new("ε_{xa}", curve.unit),
        series: vec![
            Series {
                name: "95 % band".to_owned(),
                tone: Tone::Blue,
                mark: Mark::Band(points.iter().map(|p| (p.at, p.value - p.u95, p.value + p.u95)).collect()),
            },
            line("true", Tone::Black, points.iter().zip(truth).map(|(p, truth)| (p.at, *truth)).collect()),
            Series {
                name: format!("estimated ({estimator})"),
                tone: Tone::Blue,
                mark: Mark::Dashed(points.iter().map(|p| (p.at, p.value)).collect()),
            },
        ],
    };
    let errors = curves.by_ref().zip(tones).map(|((estimator, curve, truth), tone)| {
        let points = curve.points.iter().zip(truth).map(|(p, truth)| (p.at, p.value - truth)).collect();
        line(&estimator.to_string(), tone, points)
    });
    let chart = Chart {
        title: "Angular positioning error of the tilting table".to_owned(),
        x: Scale::new("a", curve.coordinate_unit),
        panels: vec![estimated, Panel { y: Scale::new("estimate − truth", curve.unit), series: errors.collect() }],
    };
    files.add("fig4.svg", chart.svg()?);
    Ok(files)
}
