//! `trunnion demo`: the paper in one command.

use super::model::load;
use super::monte_carlo::{self, studies};
use super::simulated::{Measured, Simulation};
use super::{Refused, estimate, print, simulate};
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trunnion::data::{Unit, write_atomically};
use trunnion::plot::{Chart, Mark, Panel, Scale, Series, Tone};
use trunnion::study::{Estimator, Limits, Report, Setup, fit, report};
use trunnion_codegen::emit::equations;
use trunnion_codegen::ids::{FunctionId, RunId};
use trunnion_codegen::kinematics::ErrorValues;

/// The paper's machine.
const MODEL: &str = "tilting-table-a";
/// Length of the bar, mm; the paper does not give it.
const RADIUS: f64 = 150.0;
/// Largest error of the estimated function in the paper's one simulation, µrad.
const PAPER: f64 = 2.643;
const TRIALS: u64 = 1000;

/// Arguments of `demo`.
#[derive(Debug, Args)]
pub struct Demo {
    /// Directory for the figures and the simulated measurements.
    #[arg(long, value_name = "DIR", default_value = "trunnion-demo")]
    out: PathBuf,
}

impl Demo {
    /// Derives, simulates, fits, draws, compares.
    pub fn run(self) -> Result<(), Refused> {
        let model = load(MODEL)?;
        let setup = Setup::new(model.clone(), &[("R", RADIUS)]).map_err(|e| Refused::setup(&model, &e))?;
        let simulation = Simulation {
            seed: 1,
            samples: 360,
            noise_um: 0.1,
            length_um: 30.0,
            angle_urad: 100.0,
            from_deg: 0.0,
            to_deg: 360.0,
        };
        let measured = simulation.measure(&setup);
        let mut out = String::from("1. The equations, derived from the machine's description\n\n");
        out += &equations::text(&setup.model, &setup.derivation);
        let _ = write!(
            out,
            "\n2. A machine drawn within ±30 µm and ±100 µrad, both runs simulated exactly: R = {RADIUS} mm, 360 samples, ±0.1 µm\n"
        );
        let mut reports = Vec::new();
        for estimator in [Estimator::Joint, Estimator::TwoStep] {
            let name = |r: RunId| setup.model.runs[r].name.clone();
            let fitted =
                fit(&setup, &measured.observations.raw, estimator).map_err(|e| Refused::fit(&setup, &name, &e))?;
            let report = report(&setup, &measured.observations.raw, &fitted, Limits::PAPER, false)
                .map_err(|e| Refused::setup(&model, &e))?;
            reports.push((estimator, report));
        }
        out += &recovered(&setup, &measured, &reports);
        let _ = write!(
            out,
            "\n3. {TRIALS} such machines; the paper's one simulation had a largest error of {PAPER} µrad\n\n"
        );
        out +=
            &monte_carlo::text(TRIALS, &studies(&setup, &simulation, TRIALS, &[Estimator::TwoStep, Estimator::Joint])?);
        simulate::write(&setup, &simulation, &measured, RADIUS, &self.out)?;
        figures(&setup, &measured, &reports, &self.out)?;
        let _ = write!(
            out,
            "\nwritten to {}: fig3.svg, fig4.svg, tilting.csv, separation.csv, table.csv, truth.json\n",
            self.out.display()
        );
        print(&out)
    }
}

/// What was recovered against the truth.
fn recovered(setup: &Setup, measured: &Measured, reports: &[(Estimator, Report)]) -> String {
    let mut out = String::new();
    let truth = measured.machine.base(setup);
    let of = |name: &str| {
        setup.derivation.base.position(|b| b.name == name).and_then(|b| truth.get(b)).copied().unwrap_or(f64::NAN)
    };
    for (estimator, report) in reports {
        let _ = writeln!(out, "\n{}: condition {:.1}", estimate::name(*estimator), report.condition);
        for (name, samples, rms) in &report.runs {
            let _ = writeln!(out, "  run {name}: {samples} samples, residuals {rms:.3} µm rms");
        }
        let _ = writeln!(out, "  {:6} {:>14} {:>14} {:>10}", "", "estimate", "truth", "std");
        for c in &report.coefficients {
            let _ =
                writeln!(out, "  {:6} {:>14.6e} {:>14.6e} {:>10.1e} {}", c.name, c.value, of(&c.name), c.std, c.unit);
        }
        for (f, curve) in setup.estimated().zip(&report.functions) {
            let error = |p: &trunnion::study::Point| (p.value - true_value(setup, measured, f, p.at)).abs();
            let largest = curve.points.iter().map(error).fold(0.0, f64::max);
            let inside = curve.points.iter().filter(|p| error(p) <= p.u95).count();
            let _ = writeln!(
                out,
                "  {}: largest error {largest:.3} {}, truth inside the 95 % band at {inside} of {} points",
                curve.name,
                curve.unit,
                curve.points.len()
            );
        }
    }
    let dropped: Vec<String> =
        reports[0].1.runs.iter().zip(&reports[0].1.neglected).map(|((n, ..), v)| format!("{v:.3} µm ({n})")).collect();
    let _ = writeln!(
        out,
        "\nThe second-order terms that linearisation drops are at most {} on any such machine.",
        dropped.join(", ")
    );
    out
}

/// True value of an estimated angular function in µrad (of a length, µm) at degrees.
fn true_value(setup: &Setup, measured: &Measured, function: FunctionId, deg: f64) -> f64 {
    let value = measured.machine.value(setup.model.functions[function].error, deg.to_radians());
    setup.quantity(function).deviation().from_inner(value)
}

/// Fig. 3, the readings, and Fig. 4, the estimate against the truth.
fn figures(setup: &Setup, measured: &Measured, reports: &[(Estimator, Report)], out: &Path) -> Result<(), Refused> {
    let line = |name: &str, tone, points| Series { name: name.to_owned(), tone, mark: Mark::Line(points) };
    let tones = [Tone::Blue, Tone::Vermilion, Tone::Green, Tone::Purple];
    let runs = measured.observations.iter().zip(tones).enumerate().map(|(i, (o, tone))| {
        let points = o.samples.iter().map(|s| (s.sweep.to_degrees(), Unit::Um.from_inner(s.reading))).collect();
        line(&format!("ΔR_{{{}}} ({})", i + 1, setup.model.runs[o.run].name), tone, points)
    });
    let readings = Chart {
        title: "Radial deviations of both runs, simulated exactly".to_owned(),
        x: Scale::new("a", Unit::Deg),
        panels: vec![Panel { y: Scale::new("ΔR", Unit::Um), series: runs.collect() }],
    };
    write_atomically(&out.join("fig3.svg"), readings.svg()?.as_bytes())?;
    let Some((function, (estimator, curve))) =
        setup.estimated().zip(reports.first().and_then(|(e, r)| Some((*e, r.functions.first()?)))).next()
    else {
        return Err(Refused::NothingEstimated);
    };
    let truth = |at: f64| true_value(setup, measured, function, at);
    let points = &curve.points;
    let estimated = Panel {
        y: Scale::new("ε_{xa}", Unit::Urad),
        series: vec![
            Series {
                name: "95 % band".to_owned(),
                tone: Tone::Blue,
                mark: Mark::Band(points.iter().map(|p| (p.at, p.value - p.u95, p.value + p.u95)).collect()),
            },
            line("true", Tone::Black, points.iter().map(|p| (p.at, truth(p.at))).collect()),
            Series {
                name: format!("estimated ({})", estimate::name(estimator)),
                tone: Tone::Blue,
                mark: Mark::Dashed(points.iter().map(|p| (p.at, p.value)).collect()),
            },
        ],
    };
    let errors = reports.iter().zip(tones).filter_map(|((e, r), tone)| {
        let curve = r.functions.first()?;
        Some(line(estimate::name(*e), tone, curve.points.iter().map(|p| (p.at, p.value - truth(p.at))).collect()))
    });
    let chart = Chart {
        title: "Angular positioning error of the tilting table".to_owned(),
        x: Scale::new("a", Unit::Deg),
        panels: vec![estimated, Panel { y: Scale::new("estimate − truth", Unit::Urad), series: errors.collect() }],
    };
    write_atomically(&out.join("fig4.svg"), chart.svg()?.as_bytes())?;
    Ok(())
}
